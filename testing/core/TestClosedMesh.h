// SPDX-License-Identifier: BSD-3-Clause
// What holds for a part's mesh that is closed.
#pragma once

#include "mesh/TriangleMesh.h"

#include <gtest/gtest.h>

#include <map>

namespace parts
{
/// Every edge has two faces, once in each direction, and is longer than `least` (mm).
inline void expectTwoFacesAtEachEdge(const meam::TriangleMesh& part, float least)
{
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : part.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      ++edges[{ t[i], t[(i + 1) % 3] }];
    }
  }
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({ edge.second, edge.first }), 1u);
    EXPECT_GT((part.vertices[edge.first] - part.vertices[edge.second]).norm(), least);
  }
}
}
