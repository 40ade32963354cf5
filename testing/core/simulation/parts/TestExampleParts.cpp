// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ConvexHull.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshPreparation.h"
#include "simulation/parts/ExampleParts.h"

#include <gtest/gtest.h>

#include <map>

class ExampleParts : public testing::TestWithParam<int>
{
};

TEST_P(ExampleParts, areClosedAndFaceOutward)
{
  const meam::TriangleMesh part = meam::makeExamplePart(static_cast<meam::ExamplePart>(GetParam()));
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
  EXPECT_LT(84 + 50 * report.triangles, 200000); // bytes as STL
  // Every edge has two faces, once in each direction.
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
    EXPECT_GT((part.vertices[edge.first] - part.vertices[edge.second]).norm(), 0.01f);
  }
}

TEST_P(ExampleParts, haveTheirSize)
{
  const meam::TriangleMesh part = meam::makeExamplePart(static_cast<meam::ExamplePart>(GetParam()));
  const double sizes[] = { 92.0, 112.7, 153.9, 84.5, 107.9, 69.5, 49.8, 117.0 };
  EXPECT_NEAR(meam::diameter(part.vertices), sizes[GetParam()], 0.5);
}

INSTANTIATE_TEST_SUITE_P(All, ExampleParts, testing::Range(0, meam::ExampleParts));
