// SPDX-License-Identifier: BSD-3-Clause
#include "model/DistanceField.h"

#include "TestParts.h"
#include "base/SoAPoints.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
/// 21 x 21 samples of a square of 20 mm at z = 0.
meam::PointCloud square()
{
  return parts::facing(parts::lattice({ 0, 0 }, { 20, 20 }, 1.0f, 0.0f), Eigen::Vector3f::UnitZ());
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

TEST(DistanceField, InEachCellTheLeastOfAllPoints)
{
  constexpr double spacing = 0.8, reach = 2.5, step = reach / 255;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0.0f, 11.0f);
  std::normal_distribution<float> normal;
  meam::PointCloud cloud;
  for (int k = 0; k < 60; ++k)
  {
    cloud.points.emplace_back(place(random), place(random), 0.5f * place(random));
    cloud.normals.push_back(Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized());
  }
  cloud.tangents = cloud.normals;
  const meam::DistanceField surface = meam::DistanceField::ofSurface(cloud, spacing, reach, Cell);
  const meam::DistanceField edges = meam::DistanceField::ofEdges(cloud, spacing, reach, Cell);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : cloud.points)
  {
    box.extend(point);
  }
  const Eigen::Vector3d low = box.min().cast<double>().array() - reach;
  const Eigen::Array3i size = ((box.sizes().cast<double>().array() + 2.0 * reach) / Cell).cast<int>();
  int near = 0;
  for (int k = 0; k < size.prod(); k += 7) // a seventh of the cells, of all rows
  {
    const Eigen::Vector3d cell(k % size.x(), k / size.x() % size.y(), k / size.x() / size.y());
    const Eigen::Vector3d middle = low + Cell * (cell.array() + 0.5).matrix();
    double ofSurface = reach, ofEdges = reach;
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      const Eigen::Vector3d offset = middle - cloud.points[i].cast<double>();
      const double along = std::abs(cloud.normals[i].cast<double>().dot(offset));
      const double across = std::sqrt(std::max(0.0, offset.squaredNorm() - along * along));
      ofSurface = std::min(ofSurface, std::hypot(along, std::max(0.0, across - spacing)));
      ofEdges = std::min(ofEdges, std::hypot(across, std::max(0.0, along - spacing)));
    }
    EXPECT_NEAR(surface.at(middle.cast<float>()), ofSurface, 1.01 * step) << middle.transpose();
    EXPECT_NEAR(edges.at(middle.cast<float>()), ofEdges, 1.01 * step) << middle.transpose();
    near += ofSurface < reach && ofEdges < reach ? 1 : 0;
  }
  EXPECT_GT(near, 1000);
}

TEST(DistanceField, APointThatIsNoNumberIsNowhere)
{
  meam::PointCloud cloud = square();
  cloud.points[7] = { NAN, 3.0f, 0.0f };
  const meam::DistanceField field = meam::DistanceField::ofSurface(cloud, 1.0, 3.0, Cell);
  EXPECT_NEAR(field.at({ 10.0f, 10.0f, 2.0f }), 2.0, Cell);
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
