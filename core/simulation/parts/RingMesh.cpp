// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/parts/RingMesh.h"

namespace meam
{
TriangleMesh ringMesh(const std::vector<PrecisePoints>& rings, bool closed)
{
  TriangleMesh mesh;
  std::vector<int> starts;
  for (const PrecisePoints& ring : rings)
  {
    starts.push_back(static_cast<int>(mesh.vertices.size()));
    for (const Eigen::Vector3d& point : ring)
    {
      mesh.vertices.push_back(point.cast<float>());
    }
  }
  const std::size_t bands = closed ? rings.size() : rings.size() - 1;
  for (std::size_t i = 0; i < bands; ++i)
  {
    const std::size_t next = (i + 1) % rings.size();
    const int here = static_cast<int>(rings[i].size());
    const int there = static_cast<int>(rings[next].size());
    for (int k = 0; k < std::max(here, there); ++k)
    {
      const int a = starts[i] + k % here;
      const int b = starts[i] + (k + 1) % here;
      const int c = starts[next] + (k + 1) % there;
      const int d = starts[next] + k % there;
      if (here == 1)
      {
        mesh.triangles.emplace_back(a, c, d);
      }
      else if (there == 1)
      {
        mesh.triangles.emplace_back(a, b, d);
      }
      else if ((mesh.vertices[a] - mesh.vertices[c]).norm() < (mesh.vertices[b] - mesh.vertices[d]).norm())
      {
        mesh.triangles.emplace_back(a, b, c);
        mesh.triangles.emplace_back(a, c, d);
      }
      else
      {
        mesh.triangles.emplace_back(a, b, d);
        mesh.triangles.emplace_back(b, c, d);
      }
    }
  }
  return mesh;
}
}
