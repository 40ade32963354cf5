// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TriangleMesh.h"

#include "base/Bounds.h"
#include "base/Error.h"

namespace meam
{
void requireMesh(const TriangleMesh& mesh)
{
  if (mesh.triangles.empty())
  {
    throw Error("The mesh has no faces: check that the CAD file holds a surface, not only points.");
  }
  for (const auto& vertex : mesh.vertices)
  {
    if (!vertex.allFinite())
    {
      throw Error("The mesh has a vertex that is not a number: repair the CAD file.");
    }
  }
  const int vertices = static_cast<int>(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles)
  {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= vertices)
    {
      throw Error("The mesh has a face with a vertex that does not exist: the file is damaged.");
    }
  }
}

void requireSamplesOf(const TriangleMesh& mesh, const Points& points)
{
  constexpr float share = 1e-3f; // of the extent, rounding of samples
  Eigen::AlignedBox3f box = bounds(mesh.vertices);
  const Eigen::Vector3f margin = Eigen::Vector3f::Constant(share * box.diagonal().norm());
  box.extend((box.max() + margin).eval());
  box.extend((box.min() - margin).eval());
  if (!box.contains(bounds(points)))
  {
    throw Error("The points are not of this mesh: some lie outside it. Connect the prepared mesh that the surface was "
                "sampled from.");
  }
}
}
