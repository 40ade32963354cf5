// SPDX-License-Identifier: BSD-3-Clause
#include "model/DistanceField.h"

#include "base/SoAPoints.h"

#include <gtest/gtest.h>

#include <random>

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

TEST(DistanceField, FarAwayIsTheTruncationDistance)
{
  const meam::DistanceField field = meam::DistanceField::ofSurface(square(), 1.0, 3.0, Cell);
  EXPECT_EQ(field.at({ 10, 10, 3.5f }), 3.0f);
  EXPECT_EQ(field.at({ 1e6f, 0, 0 }), 3.0f);
  EXPECT_EQ(field.at({ -1e30f, 0, 0 }), 3.0f);
  EXPECT_EQ(field.at(Eigen::Vector3f::Constant(NAN)), 3.0f);
  EXPECT_EQ(meam::DistanceField().at({ 0, 0, 0 }), 0.0f) << "of nothing, truncated at 0";
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

TEST(DistanceField, ManyAtOnceAsOneByOne)
{
  const meam::DistanceField field = meam::DistanceField::ofSurface(square(), 1.0, 3.0, Cell);
  Eigen::Isometry3f toPart = Eigen::Translation3f(3, -2, 1) * Eigen::Isometry3f::Identity();
  toPart.rotate(Eigen::AngleAxisf(0.4f, Eigen::Vector3f(2, 1, 2) / 3.0f));
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-6.0f, 26.0f);
  meam::SoAPoints points; // more than are looked up together, and not a multiple of any vector
  for (int k = 0; k < 999; ++k)
  {
    points.add(toPart.inverse() * Eigen::Vector3f(place(random), place(random), 0.15f * place(random)));
  }
  points.add({ 1e30f, 0, 0 });
  points.add(Eigen::Vector3f::Constant(NAN));
  std::vector<float> distances(points.size());
  field.at(toPart, points, 0, 400, distances.data());
  field.at(toPart, points, 400, static_cast<int>(points.size()) - 400, distances.data() + 400);
  int different = 0; // where rounding decides between cells
  int near = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const float one = field.at(toPart * points[k]);
    different += distances[k] != one ? 1 : 0;
    near += one < 3.0f ? 1 : 0;
    EXPECT_NEAR(distances[k], one, 2.0 * Cell);
  }
  EXPECT_LE(different, 3);
  EXPECT_GT(near, 300);
  float distance = -1.0f;
  meam::DistanceField().at(toPart, points, 0, 1, &distance);
  EXPECT_EQ(distance, 0.0f) << "of nothing, truncated at 0";
}
