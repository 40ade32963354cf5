// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMMeshPreparation
 * @brief Makes a clean mesh in millimetres of a CAD file's triangles.
 *
 * The first step of training. The mesh is scaled and moved; vertices at the same place, or within a millionth
 * of the mesh's extent, become one, which sews open seams; faces without area and faces that are there twice
 * are left out, neighbouring faces are wound the same way and turned outwards where that can be told. The mesh
 * need not be closed, and may cross itself. STL files repeat each vertex for each face and their normals are
 * unreliable: this step makes both right. On request only the largest component is kept, small holes are
 * closed, the mesh is simplified within an error bound (OpenMesh) and then remade of even triangles (CGAL).
 *
 * Input port 0: vtkPolyData, the mesh; polygons and triangle strips are cut into triangles.
 *
 * Output port 0: vtkPolyData, the triangles. Field data: `Report`, what was wrong and what was done in words;
 * and one number each, lengths in mm: `InputVertices`, `InputTriangles`, `Vertices`, `Triangles`,
 * `MergedVertices`, `NearVertices` (merged though not at exactly the same place), `IsolatedVertices`,
 * `DegenerateTriangles`, `DuplicateTriangles`, `FlippedComponents`, `DroppedComponents`, `Components`,
 * `ClosedHoles`, `Intersections` (pairs of triangles of the output, counted up to 10000), `BorderEdges`,
 * `Closed`, `Area`, `Volume` (0 when the mesh is not closed), `Diameter` (d_max, the longest distance between
 * two points).
 */
#ifndef vtkMEAMMeshPreparation_h
#define vtkMEAMMeshPreparation_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>

namespace meam
{
struct MeshPreparationSettings;
}

class PPFMEAMTRAINING_EXPORT vtkMEAMMeshPreparation : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMMeshPreparation* New();
  vtkTypeMacro(vtkMEAMMeshPreparation, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Factor on the coordinates that brings them to mm: 1000 for a mesh in metres. Default: 1. */
  vtkMEAMDeclareSettingMacro(Scale, double);

  /** Added to the coordinates after the scale, in mm. Default: 0, 0, 0. */
  vtkMEAMVectorMemberMacro(Offset, double, 3);

  /** What is kept of a mesh of several connected components. */
  enum Components
  {
    All,
    Largest ///< by area
  };

  ///@{
  /** Which connected components are kept. Default: All. */
  vtkMEAMDeclareSettingMacro(KeptComponents, int);
  void SetKeptComponentsToAll() { this->SetKeptComponents(All); }
  void SetKeptComponentsToLargest() { this->SetKeptComponents(Largest); }
  ///@}

  /**
   * Holes are closed whose border, all the way round, is at most this long, in mm; 0: none. The outer border of a
   * sheet is not a hole. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(HoleSize, double);

  /** The mesh is simplified as far as its surface moves by no more than this, in mm; 0: not at all. Default: 0. */
  vtkMEAMDeclareSettingMacro(MaximumError, double);

  /**
   * The mesh is remade of even triangles with edges of this length in mm, after it is simplified; sharp edges and
   * borders stay where they are. 0: not at all. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(EdgeLength, double);

protected:
  vtkMEAMMeshPreparation();
  ~vtkMEAMMeshPreparation() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::MeshPreparationSettings> Settings;
  double Offset[3] = { 0.0, 0.0, 0.0 };
};

#endif
