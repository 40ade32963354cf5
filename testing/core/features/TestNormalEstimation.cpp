// SPDX-License-Identifier: BSD-3-Clause
#include "features/NormalEstimation.h"

#include "TestParts.h"
#include "base/sequences/Sequences.h"

#include <numeric>
#include <random>

namespace
{
std::vector<int> all(const meam::Points& points)
{
  std::vector<int> indices(points.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

meam::Points normalsOf(const meam::Points& points, const meam::Sensor& sensor, int threads = 1)
{
  return meam::estimateNormals(points, meam::PointGrid(points, 5.0), all(points), sensor, 100.0, threads);
}

/// Every mm of z = slope * x.
meam::Points plane(float slope)
{
  return parts::lattice({ -20, -20 }, { 20, 20 }, 1.0f, [slope](float x, float) { return slope * x + 500.0f; });
}
}

TEST(NormalEstimation, OfAPlaneTowardsTheSensor)
{
  meam::Sensor above; // at the origin, looks along +z
  const meam::Points found = normalsOf(plane(0.75f), above);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_LT((found[i] - Eigen::Vector3f(0.6f, 0.0f, -0.8f)).norm(), 1e-3f);
  }
  meam::Sensor below;
  below.perspective = false;
  below.direction = -Eigen::Vector3d::UnitZ();
  EXPECT_LT((normalsOf(plane(0.75f), below)[0] - Eigen::Vector3f(-0.6f, 0.0f, 0.8f)).norm(), 1e-3f);
}

TEST(NormalEstimation, OfASphereOutwards)
{
  meam::Points points;
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  const Eigen::Vector3f middle(0, 0, 500);
  while (points.size() < 4000)
  {
    const Eigen::Vector3f direction = Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    if (direction.z() < -0.2f)
    {
      points.push_back(middle + 40.0f * direction);
    }
  }
  const meam::Points found = normalsOf(points, {});
  const auto isOff = [&](int i) { return found[i].dot((points[i] - middle).normalized()) < std::cos(0.15f); };
  EXPECT_LT(meam::indicesWhere(points.size(), isOff).size(), 40u) << "at the border a few lean outwards";
}

TEST(NormalEstimation, NoneWhereTooLittleWasMeasured)
{
  const meam::Points points = { { 0, 0, 500 }, { 1, 0, 500 }, { 0, 1, 500 }, { 80, 0, 500 } };
  for (const Eigen::Vector3f& normal : normalsOf(points, {}))
  {
    EXPECT_TRUE(normal.isZero());
  }
}

TEST(NormalEstimation, TheSameForAnyNumberOfThreads)
{
  const meam::Points points = plane(0.3f);
  EXPECT_EQ(normalsOf(points, {}, 1), normalsOf(points, {}, 3));
}
