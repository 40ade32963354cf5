// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMBoundaryExtraction
 * @brief Reduces each appearance model to its edge points.
 *
 * Section 4 of the paper, by one of two methods:
 * - point boundary: a point is on the boundary when the directions to its neighbours, on its tangent
 *   plane, leave a gap that is wider than an angle (PCL's boundary estimation). What hides behind other
 *   faces is gone from the appearance models, so silhouettes are boundaries there;
 * - mesh edges: the mesh's sharp edges, borders and occluding contours, as far as the viewpoint sees them,
 *   as dense as the points of the appearance models.
 *
 * Input port 0: vtkPartitionedDataSetCollection of appearance models (vtkMEAMVisibilityExtraction); the
 * points need `Normals`. Without the field data `Viewpoint` (mm) a model is taken as seen from far away.
 * Input port 1 (optional): the prepared mesh of the part, a vtkPolyData; mesh edges need it.
 *
 * Output port 0: vtkPartitionedDataSetCollection with the same partitions, their edge points alone, with
 * `Normals`, `PointId` (for mesh edges that of the nearest visible sample) and, from mesh edges, `Tangent`
 * (unit, exact). The active scalars `EdgeType` are categories of what is seen there:
 * - 0, contour: the visible surface ends there, in front of the background or of another surface;
 * - 1, crease: the visible surface goes on on both sides;
 * - 2, hole border: the visible surface ends there, in front of background that the part encloses.
 * Of a model of the whole part (field data `WholePart`) point boundary gives creases, mesh edges give all sharp
 * edges as creases and borders of an open mesh as hole borders.
 * Field data is passed on.
 */
#ifndef vtkMEAMBoundaryExtraction_h
#define vtkMEAMBoundaryExtraction_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

#include <memory>

namespace meam
{
struct BoundaryExtractionSettings;
}

class PPFMEAMTRAINING_EXPORT vtkMEAMBoundaryExtraction : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkMEAMBoundaryExtraction* New();
  vtkTypeMacro(vtkMEAMBoundaryExtraction, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The prepared mesh. */
  void SetMeshConnection(vtkAlgorithmOutput* mesh) { this->SetInputConnection(1, mesh); }

  enum Methods
  {
    PointBoundary = 0,
    MeshEdges = 1
  };

  ///@{
  /** PointBoundary (0, the paper's) or MeshEdges (1). Default: PointBoundary. */
  vtkMEAMDeclareSettingMacro(Method, int);
  void SetMethodToPointBoundary() { this->SetMethod(PointBoundary); }
  void SetMethodToMeshEdges() { this->SetMethod(MeshEdges); }
  ///@}

  /** Point boundary: neighbourhood of a point in mm; 0: 2.5 times the distance between neighbouring points. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(Radius, double);

  /** Point boundary: a point with a wider gap between its neighbours is on it, in degrees. Default: 90. */
  vtkMEAMDeclareSettingMacro(Angle, double);

  /** Mesh edges: faces that meet at more than this, in degrees, make a sharp edge. Default: 30. */
  vtkMEAMDeclareSettingMacro(SharpAngle, double);

protected:
  vtkMEAMBoundaryExtraction();
  ~vtkMEAMBoundaryExtraction() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::BoundaryExtractionSettings> Settings;
};

#endif
