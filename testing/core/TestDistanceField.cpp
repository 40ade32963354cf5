// SPDX-License-Identifier: BSD-3-Clause
#include "model/DistanceField.h"

#include <gtest/gtest.h>

namespace
{
/// 21 x 21 samples of a square of 20 mm at z = 0.
meam::PointCloud square()
{
  meam::PointCloud result;
  for (int x = 0; x <= 20; ++x)
  {
    for (int y = 0; y <= 20; ++y)
    {
      result.points.emplace_back(x, y, 0);
      result.normals.push_back(Eigen::Vector3f::UnitZ());
    }
  }
  return result;
}

constexpr double Cell = 0.2;
}

TEST(DistanceField, OfAPlaneIsTheHeight)
{
  const meam::DistanceField field = meam::DistanceField::ofSurface(square(), 1.0, 3.0, Cell);
  for (const float height : { 0.0f, 0.9f, 1.7f, 2.6f })
  {
    // Between samples, too: half a cell's diagonal is what the grid may add.
    EXPECT_NEAR(field.at({ 10.3f, 7.6f, height }), height, Cell);
    EXPECT_NEAR(field.at({ 10.3f, 7.6f, -height }), height, Cell);
  }
  EXPECT_NEAR(field.at({ 22.5f, 10.0f, 0.0f }), 1.5, Cell); // beside it, less the spacing
}

TEST(DistanceField, FarAwayIsTheReach)
{
  const meam::DistanceField field = meam::DistanceField::ofSurface(square(), 1.0, 3.0, Cell);
  EXPECT_EQ(field.at({ 10, 10, 3.5f }), 3.0f);
  EXPECT_EQ(field.at({ 1e6f, 0, 0 }), 3.0f);
  EXPECT_EQ(field.at({ -1e30f, 0, 0 }), 3.0f);
  EXPECT_EQ(field.at(Eigen::Vector3f::Constant(NAN)), 3.0f);
  EXPECT_EQ(meam::DistanceField().at({ 0, 0, 0 }), 0.0f) << "of nothing, with no reach";
  EXPECT_EQ(meam::DistanceField::ofSurface({}, 1.0, 3.0, Cell).at({ 0, 0, 0 }), 3.0f);
}

TEST(DistanceField, OfALineOfEdgePoints)
{
  meam::PointCloud edge;
  for (int x = 0; x <= 20; x += 2)
  {
    edge.points.emplace_back(x, 0, 0);
    edge.tangents.push_back(x % 4 == 0 ? Eigen::Vector3f::UnitX() : Eigen::Vector3f(-1, 0, 0));
  }
  const meam::DistanceField field = meam::DistanceField::ofEdges(edge, 2.0, 3.0, Cell);
  EXPECT_NEAR(field.at({ 9.0f, 0, 0 }), 0.0, Cell);
  EXPECT_NEAR(field.at({ 9.0f, 1.2f, -1.6f }), 2.0, Cell);
  EXPECT_LT((field.middle() - Eigen::Vector3f(10, 0, 0)).norm(), 1e-4f);
  EXPECT_NEAR(field.radius(), 10.0f, 1e-4);
}
