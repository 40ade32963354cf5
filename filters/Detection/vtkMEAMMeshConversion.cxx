// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMMeshConversion.h"

#include "base/Error.h"
#include "vtkMEAMArrays.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <string>

namespace vtkMEAMConversion
{
namespace
{
using meam::Error;

/// Appends the triangles of `cells`; false when there is a polygon of another kind.
bool appendTriangles(vtkCellArray* cells, vtkIdType numberOfPoints, std::vector<Eigen::Vector3i>& triangles)
{
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  bool onlyTriangles = true;
  triangles.reserve(triangles.size() + cells->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, size, ids);
    for (vtkIdType k = 0; k < size; ++k)
    {
      if (ids[k] < 0 || ids[k] >= numberOfPoints)
      {
        throw Error("Face " + std::to_string(cell) + " of the mesh uses point " + std::to_string(ids[k]) +
                    ", which does not exist: the file is damaged.");
      }
    }
    if (size == 3)
    {
      triangles.emplace_back(static_cast<int>(ids[0]), static_cast<int>(ids[1]), static_cast<int>(ids[2]));
    }
    onlyTriangles = onlyTriangles && size == 3;
  }
  return onlyTriangles;
}
}

meam::TriangleMesh toMesh(vtkPolyData* input)
{
  meam::TriangleMesh mesh;
  const vtkIdType count = input->GetNumberOfPoints();
  if (count > 0)
  {
    mesh.vertices = toVectors<float>(input->GetPoints()->GetData());
  }
  if (input->GetNumberOfStrips() == 0 && appendTriangles(input->GetPolys(), count, mesh.triangles))
  {
    return mesh;
  }
  // What cannot be cut into triangles has to be told before.
  appendTriangles(input->GetStrips(), count, mesh.triangles);
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const auto& p) { return p.allFinite(); }))
  {
    throw Error("The mesh has a vertex that is not a number: repair the CAD file.");
  }
  vtkNew<vtkPolyData> faces;
  faces->SetPoints(input->GetPoints());
  faces->SetPolys(input->GetPolys());
  faces->SetStrips(input->GetStrips());
  vtkNew<vtkTriangleFilter> triangulate;
  triangulate->SetInputData(faces);
  triangulate->Update();
  mesh.vertices = toVectors<float>(triangulate->GetOutput()->GetPoints()->GetData());
  mesh.triangles.clear();
  appendTriangles(triangulate->GetOutput()->GetPolys(), triangulate->GetOutput()->GetNumberOfPoints(), mesh.triangles);
  return mesh;
}

void fromMesh(const meam::TriangleMesh& mesh, vtkPolyData* output)
{
  output->SetPoints(toVTKPoints(mesh.vertices));
  vtkNew<vtkCellArray> polys;
  const auto count = static_cast<vtkIdType>(mesh.triangles.size());
  polys->AllocateExact(count, 3 * count);
  for (const auto& triangle : mesh.triangles)
  {
    const vtkIdType ids[3] = { triangle[0], triangle[1], triangle[2] };
    polys->InsertNextCell(3, ids);
  }
  output->SetPolys(polys);
}
}
