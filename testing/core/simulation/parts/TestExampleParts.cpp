// SPDX-License-Identifier: BSD-3-Clause
#include "TestClosedMesh.h"
#include "mesh/ConvexHull.h"
#include "mesh/TriangleMesh.h"
#include "simulation/parts/ExampleParts.h"

class ExampleParts : public testing::TestWithParam<int>
{
};

TEST_P(ExampleParts, areClosedFaceOutwardAndHaveTheirSize)
{
  const meam::TriangleMesh part = meam::makeExamplePart(static_cast<meam::ExamplePart>(GetParam()));
  const meam::MeshReport report = parts::reportOfClean(part);
  EXPECT_LT(84 + 50 * report.triangles, 200000); // bytes as STL
  const double sizes[] = { 92.0, 112.7, 153.9, 84.5, 107.9, 69.5, 49.8, 117.0 };
  EXPECT_NEAR(meam::diameter(part.vertices), sizes[GetParam()], 0.5);
  parts::expectTwoFacesAtEachEdge(part, 0.01f);
}

INSTANTIATE_TEST_SUITE_P(All, ExampleParts, testing::Range(0, meam::ExampleParts));
