// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMMeshPreparation
 * @brief Makes a clean mesh in millimetres of a CAD file's triangles.
 *
 * The first step of training. The mesh is scaled and moved; vertices at the same place become one, faces
 * without area and faces that are there twice are left out, neighbouring faces are wound the same way and
 * turned outwards where that can be told. The mesh need not be closed. STL files repeat each vertex for each
 * face and their normals are unreliable: this step makes both right.
 *
 * Input port 0: vtkPolyData, the mesh; polygons and triangle strips are cut into triangles.
 *
 * Output port 0: vtkPolyData, the triangles. Field data, one number each, lengths in mm: `InputVertices`,
 * `InputTriangles`, `Vertices`, `Triangles`, `MergedVertices`, `IsolatedVertices`, `DegenerateTriangles`,
 * `DuplicateTriangles`, `FlippedComponents`, `Components`, `BorderEdges`, `Closed`, `Area`, `Volume` (0 when
 * the mesh is not closed), `Diameter` (d_max, the longest distance between two points).
 */
#ifndef vtkMEAMMeshPreparation_h
#define vtkMEAMMeshPreparation_h

#include "ppfmeamFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMFILTERS_EXPORT vtkMEAMMeshPreparation : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMMeshPreparation* New();
  vtkTypeMacro(vtkMEAMMeshPreparation, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Factor on the coordinates that brings them to mm: 1000 for a mesh in metres. Default: 1. */
  vtkSetMacro(Scale, double);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /** Added to the coordinates after the scale, in mm. Default: 0, 0, 0. */
  vtkSetVector3Macro(Offset, double);
  vtkGetVector3Macro(Offset, double);
  ///@}

protected:
  vtkMEAMMeshPreparation();
  ~vtkMEAMMeshPreparation() override = default;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMMeshPreparation(const vtkMEAMMeshPreparation&) = delete;
  void operator=(const vtkMEAMMeshPreparation&) = delete;

  double Scale;
  double Offset[3];
};

#endif
