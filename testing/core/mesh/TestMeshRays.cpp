// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/MeshRays.h"
#include "TestParts.h"
#include "base/Error.h"

TEST(MeshRays, hitsInTheirOrder)
{
  // Through the middles of two faces, where the diagonals run: one hit each.
  const meam::MeshRays rays(parts::box({ -10, -20, -30 }, { 10, 20, 30 }));
  const auto hits = rays.hits({ 50, 0, 0 }, { -1, 0, 0 }, 100);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].distance, 40.0);
  EXPECT_EQ(hits[0].normal, Eigen::Vector3d(1, 0, 0));
  EXPECT_TRUE(hits[0].entering);
  EXPECT_EQ(hits[1].distance, 60.0);
  EXPECT_EQ(hits[1].normal, Eigen::Vector3d(-1, 0, 0));
  EXPECT_FALSE(hits[1].entering);
  EXPECT_EQ(rays.hits({ 50, 0, 0 }, { -1, 0, 0 }, 50).size(), 1u);
  EXPECT_TRUE(rays.hits({ 50, 0, 0 }, { 1, 0, 0 }, 100).empty());
}

TEST(MeshRays, aFaceThatTheRayRunsAlongIsNotMet)
{
  const meam::MeshRays rays(parts::box({ -10, -20, -30 }, { 10, 20, 30 }));
  for (const auto& hit : rays.hits({ 50, 0, 30 }, { -1, 0, 0 }, 100))
  {
    EXPECT_EQ(std::abs(hit.normal.x()), 1.0);
  }
}

TEST(MeshRays, fromInside)
{
  const meam::MeshRays rays(parts::box({ -10, -20, -30 }, { 10, 20, 30 }));
  EXPECT_FALSE(rays.firstEntered({ 0, 0, 0 }, { 0, 0, 1 }, 100));
  const auto first = rays.firstEntered({ 0, 0, 40 }, { 0, 0, -1 }, 100);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->distance, 10.0);
}

TEST(MeshRays, badMeshes) { EXPECT_THROW(meam::MeshRays(meam::TriangleMesh()), meam::Error); }
