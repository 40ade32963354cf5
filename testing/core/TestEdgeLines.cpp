// SPDX-License-Identifier: BSD-3-Clause
#include "pose/EdgeLines.h"

#include "TestParts.h"

#include <gtest/gtest.h>

namespace
{
meam::PointCloud scattered(int count)
{
  std::mt19937 random(21);
  meam::PointCloud edges;
  for (int k = 0; k < count; ++k)
  {
    const Eigen::Isometry3d T = parts::motion(random, 20.0);
    edges.points.push_back(T.translation().cast<float>());
    edges.tangents.push_back(T.linear().col(0).cast<float>());
  }
  return edges;
}
}

TEST(EdgeLines, FindsWhatAskingEveryLineFinds)
{
  const meam::PointCloud edges = scattered(2000);
  const meam::PointGrid grid(edges.points, 3.0);
  const meam::EdgeLines lines(edges, grid);
  const meam::PointCloud asked = scattered(200);
  int found = 0;
  for (const double radius : { 0.5, 4.0, 15.0 }) // 15: more rows of cells than are looked at together
  {
    for (std::size_t k = 0; k < asked.size(); ++k)
    {
      const Eigen::Vector3f point = asked.points[k] + Eigen::Vector3f(0.3f, -0.2f, 0.1f);
      int expected = -1;
      double least = radius * radius;
      for (std::size_t i = 0; i < edges.size(); ++i)
      {
        const Eigen::Vector3d offset = (point - edges.points[i]).cast<double>();
        const Eigen::Vector3d tangent = edges.tangents[i].cast<double>();
        const double across = offset.cross(tangent).squaredNorm();
        if (offset.norm() <= radius && std::abs(tangent.dot(asked.tangents[k].cast<double>())) > 0.85 && across < least)
        {
          least = across;
          expected = static_cast<int>(i);
        }
      }
      const meam::EdgeLines::Match match = lines.nearest(point, asked.tangents[k], radius);
      EXPECT_EQ(match.edge, expected) << k << " within " << radius;
      if (expected >= 0)
      {
        EXPECT_NEAR(match.squaredDistance, least, 1e-3 * least + 1e-5);
        ++found;
      }
    }
  }
  EXPECT_GT(found, 200);
}

TEST(EdgeLines, DistanceIsThatToTheLine)
{
  meam::PointCloud edges;
  edges.points = { { 0, 0, 0 }, { 0, 3, 0 } };
  edges.tangents = { { 0, 1, 0 }, { 1, 0, 0 } };
  const meam::PointGrid grid(edges.points, 1.0);
  const meam::EdgeLines lines(edges, grid);
  // 2 along the first line and 0.5 beside it; the second is nearer, but runs across.
  meam::EdgeLines::Match match = lines.nearest({ 0.5f, 2.0f, 0.0f }, { 0, -1, 0 }, 2.5);
  EXPECT_EQ(match.edge, 0);
  EXPECT_FLOAT_EQ(match.squaredDistance, 0.25f);
  EXPECT_EQ(lines.nearest({ 0.5f, 2.0f, 0.0f }, { 1, 0, 0 }, 2.5).edge, 1);
  EXPECT_EQ(lines.nearest({ 0.5f, 2.0f, 0.0f }, { 0, 0, 1 }, 2.5).edge, -1);
  EXPECT_EQ(lines.nearest({ 0.5f, 2.0f, 0.0f }, { 0, -1, 0 }, 1.0).edge, -1);
}

TEST(EdgeLines, NoEdgesNoMatch)
{
  const meam::PointGrid grid({}, 1.0);
  EXPECT_EQ(meam::EdgeLines({}, grid).nearest({ 1, 2, 3 }, { 1, 0, 0 }, 5.0).edge, -1);
}
