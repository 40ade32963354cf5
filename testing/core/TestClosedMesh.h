// SPDX-License-Identifier: BSD-3-Clause
// What holds for a part's mesh that is closed.
#pragma once

#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshPreparation.h"

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

/// Closed, facing outwards, of one piece, and with nothing to mend.
inline meam::MeshReport reportOfClean(const meam::TriangleMesh& part)
{
  const meam::MeshReport report = meam::prepareMesh(part).report;
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.flippedComponents, 0);
  EXPECT_EQ(report.mergedVertices, 0);
  EXPECT_EQ(report.nearVertices, 0);
  EXPECT_EQ(report.degenerateTriangles, 0);
  EXPECT_EQ(report.duplicateTriangles, 0);
  EXPECT_EQ(report.intersections, 0);
  EXPECT_EQ(report.vertices, static_cast<int>(part.vertices.size()));
  return report;
}
}
