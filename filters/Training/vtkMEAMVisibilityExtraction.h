// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMVisibilityExtraction
 * @brief Makes the appearance models: what is seen of the part from each of several viewpoints.
 *
 * Section 4 of the paper. The viewpoints stand around the part, or inside a cone for a part that is seen
 * from some side only. The points that are visible from each are found by one of two methods:
 * - hidden point removal (Katz, Tal and Basri 2007): the points are inverted in a sphere around the
 *   viewpoint, and those on the convex hull of the result are visible;
 * - mesh visibility: the line of sight from each point is tested against the mesh, exactly. Of an open
 *   mesh both sides can be seen; the normals are turned towards the viewpoint.
 * With no viewpoints at all the whole part is one model in which nothing is hidden: what the paper compares
 * with as "without MEAM" (Table 6).
 *
 * Input port 0: vtkPolyData, samples of the part's surface in mm (vtkMEAMSurfaceSampling); `Normals` and
 * `PointId` are passed on.
 * Input port 1 (optional): the prepared mesh that was sampled, a vtkPolyData; mesh visibility needs it.
 *
 * Output port 0: vtkPartitionedDataSetCollection, one named vtkPolyData for each viewpoint that sees
 * anything: its visible points with `Normals` and `PointId`; field data of each `ViewDirection` (unit,
 * from the part to the viewpoint), `Viewpoint` (mm) and `ViewIndex`; a viewpoint that sees nothing has no
 * partition. Without viewpoints one partition `Whole part` with all points as they are, the `ViewDirection`
 * +z, no `Viewpoint`, and the field data `WholePart` (1). The input's field data (`Diameter`) is on the
 * collection.
 */
#ifndef vtkMEAMVisibilityExtraction_h
#define vtkMEAMVisibilityExtraction_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

#include <memory>

namespace meam
{
struct VisibilityExtractionSettings;
}

class PPFMEAMTRAINING_EXPORT vtkMEAMVisibilityExtraction : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkMEAMVisibilityExtraction* New();
  vtkTypeMacro(vtkMEAMVisibilityExtraction, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The prepared mesh. */
  void SetMeshConnection(vtkAlgorithmOutput* mesh) { this->SetInputConnection(1, mesh); }

  enum Methods
  {
    HiddenPointRemoval = 0,
    MeshVisibility = 1
  };

  ///@{
  /** HiddenPointRemoval (0, the paper's) or MeshVisibility (1). Default: HiddenPointRemoval. */
  vtkMEAMDeclareSettingMacro(Method, int);
  void SetMethodToHiddenPointRemoval() { this->SetMethod(HiddenPointRemoval); }
  void SetMethodToMeshVisibility() { this->SetMethod(MeshVisibility); }
  ///@}

  /**
   * Number of viewpoints. 1: above (+z); 2: above and below; 6: along the axes, as in the paper; 14: and
   * the cube's corners; 26: and the middles of its edges; any other number is spread over the sphere.
   * 0: the whole part, nothing hidden; method and cone play no part. A trained model takes up to 32.
   * Default: 6.
   */
  vtkMEAMDeclareSettingMacro(NumberOfViewpoints, int);

  /** The middle of the viewpoints: a direction of any length, from the part. Default: 0, 0, 1. */
  vtkMEAMVectorMemberMacro(ConeDirection, double, 3);

  /**
   * Viewpoints that are farther from the cone's direction, in degrees, are left out; a number other than
   * 1, 2, 6, 14 and 26 is spread inside. 180: all around. Default: 180.
   */
  vtkMEAMDeclareSettingMacro(ConeAngle, double);

  /**
   * Hidden point removal: radius of the inversion sphere over the distance of the farthest point. Smaller loses the
   * rims of holes, larger lets the back side through. Default: 1000.
   */
  vtkMEAMDeclareSettingMacro(RadiusFactor, double);

  /** Distance of the viewpoints from the middle of the part, in part diameters. Default: 10. */
  vtkMEAMDeclareSettingMacro(ViewpointDistance, double);

protected:
  vtkMEAMVisibilityExtraction();
  ~vtkMEAMVisibilityExtraction() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::VisibilityExtractionSettings> Settings;
  double ConeDirection[3] = { 0.0, 0.0, 1.0 };
};

#endif
