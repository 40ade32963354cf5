// SPDX-License-Identifier: BSD-3-Clause
#include "features/TangentEstimation.h"

#include "TestParts.h"
#include "base/sequences/Sequences.h"

namespace
{
meam::PointCloud line(const Eigen::Vector3f& direction, int points, float step)
{
  meam::PointCloud cloud;
  for (int i = 0; i < points; ++i)
  {
    cloud.points.push_back(direction.normalized() * (i * step));
    cloud.pointIds.push_back(100 + i);
  }
  return cloud;
}

meam::PointCloud circle(float radius, int points)
{
  meam::PointCloud cloud;
  for (int i = 0; i < points; ++i)
  {
    const double angle = 2.0 * M_PI * i / points;
    cloud.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 3.0);
  }
  return cloud;
}

const Eigen::Vector3d Down(0, 0, -1);
}

TEST(TangentEstimation, OnALineItIsTheLine)
{
  meam::TangentEstimationSettings settings;
  settings.leafSize = -1.0;
  const Eigen::Vector3f direction = Eigen::Vector3f(1, 2, 3).normalized();
  const meam::PointCloud edges = parts::withTangents(line(direction, 41, 0.5f), 50.0, Down, settings);
  ASSERT_EQ(edges.size(), 41u);
  for (const auto& tangent : edges.tangents)
  {
    EXPECT_NEAR(std::abs(tangent.dot(direction)), 1.0f, 1e-5f);
  }
  EXPECT_EQ(edges.pointIds.front(), 100);
}

TEST(TangentEstimation, OnACircleItIsAcrossTheRadius)
{
  meam::TangentEstimationSettings settings;
  settings.leafSize = 1.0;
  const meam::PointCloud edges = parts::withTangents(circle(20.0f, 500), 50.0, Down, settings);
  EXPECT_GT(edges.size(), 80u);
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const Eigen::Vector3f radius = (edges.points[i] - Eigen::Vector3f(0, 0, 3)).normalized();
    EXPECT_LT(std::abs(edges.tangents[i].dot(radius)), std::sin(3.0 * M_PI / 180.0));
    EXPECT_NEAR(edges.tangents[i].norm(), 1.0f, 1e-5f);
  }
}

TEST(TangentEstimation, LengthsFollowTheNoiseOfThePoints)
{
  // 1.2 % of the diameter is the deviation of the noise: two thirds of a line's points would be off it.
  std::mt19937 random(2);
  std::normal_distribution<float> noise(0.0f, 0.6f);
  meam::PointCloud edges = line({ 1, 0, 0 }, 400, 0.25f);
  for (auto& point : edges.points)
  {
    point += Eigen::Vector3f(noise(random), noise(random), noise(random));
  }
  const auto typicalError = [&](const meam::TangentEstimationSettings& settings)
  {
    const meam::PointCloud found = parts::withTangents(edges, 50.0, Down, settings);
    auto errors = meam::mapped<double>(found.tangents,
      [&](const auto& tangent) { return std::acos(std::min(std::abs(tangent.x()), 1.0f)) * 180.0 / M_PI; });
    std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
    return errors[errors.size() / 2];
  };
  meam::TangentEstimationSettings fixed;
  fixed.radius = 3.0;
  fixed.inlierDistance = 0.6;
  EXPECT_LT(typicalError({}), 0.6 * typicalError(fixed));
}

TEST(TangentEstimation, TheRadiusFollowsTheirSpacing)
{
  // 6 % of the diameter hold three points, too few for a line.
  const meam::PointCloud sparse = line({ 0, 1, 0 }, 60, 1.9f);
  meam::TangentEstimationSettings fixed;
  fixed.radius = 3.0;
  EXPECT_TRUE(parts::withTangents(sparse, 50.0, Down, fixed).empty());
  const meam::PointCloud edges = parts::withTangents(sparse, 50.0, Down);
  EXPECT_GT(edges.size(), 50u);
  for (const auto& tangent : edges.tangents)
  {
    EXPECT_NEAR(std::abs(tangent.y()), 1.0f, 1e-5f);
  }
}

TEST(TangentEstimation, ItMovesWithThePoints)
{
  meam::TangentEstimationSettings settings;
  settings.leafSize = -1.0;
  std::mt19937 random(3);
  const meam::PointCloud flat = circle(20.0f, 200);
  const meam::PointCloud expected = parts::withTangents(flat, 50.0, Down, settings);
  for (int trial = 0; trial < 5; ++trial)
  {
    const Eigen::Isometry3d T = parts::motion(random, 100.0);
    const meam::PointCloud found = parts::withTangents(parts::moved(flat, T), 50.0, Down, settings);
    ASSERT_EQ(found.size(), expected.size());
    const meam::PointCloud turned = parts::moved(expected, T);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      EXPECT_GT(std::abs(found.tangents[i].dot(turned.tangents[i])), 0.999f);
    }
  }
}

TEST(TangentEstimation, TheNumberOfThreadsDoesNotMatter)
{
  const auto found = [](int threads)
  {
    meam::TangentEstimationSettings settings;
    settings.threads = threads;
    return parts::withTangents(circle(20.0f, 2000), 50.0, Down, settings);
  };
  const meam::PointCloud one = found(1), four = found(4);
  EXPECT_EQ(one.points, four.points);
  EXPECT_EQ(one.tangents, four.tangents);
  EXPECT_EQ(one.weights, four.weights);
  EXPECT_EQ(one.weights.size(), one.size());
}

TEST(TangentEstimation, TilesFollowAlgorithms1And2)
{
  // Two lines that cross the tiles [0, 5) and [5, 10) along x; the second tile also holds a lone point
  // far from any line through it that has support.
  meam::TangentEstimationSettings settings = meam::paperTangentSettings();
  settings.leafSize = -1.0;
  settings.pixelSize = 0.5; // tiles of 5 mm
  settings.lineSupport = 0.5;
  meam::PointCloud cloud;
  for (int i = 0; i < 20; ++i)
  {
    cloud.points.emplace_back(0.25f + 0.5f * i, 1.0f, 2.0f);
  }
  cloud.points.emplace_back(7.3f, 4.4f, 2.0f);
  const meam::PointCloud edges = parts::withTangents(cloud, 0.0, Down, settings);
  ASSERT_EQ(edges.size(), 20u); // 2 of 11 points lie on a line through the lone one: too few
  for (const auto& tangent : edges.tangents)
  {
    EXPECT_NEAR(std::abs(tangent.x()), 1.0f, 1e-6f);
  }
}

TEST(TangentEstimation, PointsWithoutALineAreLeftOut)
{
  meam::PointCloud cloud = line({ 1, 0, 0 }, 30, 0.5f);
  cloud.points.emplace_back(0, 40, 0);
  cloud.pointIds.push_back(7);
  const meam::PointCloud edges = parts::withTangents(cloud, 50.0, Down);
  for (const int id : edges.pointIds)
  {
    EXPECT_NE(id, 7);
  }
  EXPECT_GT(edges.size(), 5u);
}

TEST(TangentEstimation, PointsThatCarryTangentsAreOnlyThinned)
{
  meam::TangentEstimationSettings settings;
  settings.leafSize = 2.0;
  meam::PointCloud cloud = line({ 1, 0, 0 }, 40, 0.5f);
  cloud.tangents.assign(cloud.size(), Eigen::Vector3f::UnitY()); // not what the points would say
  cloud.edgeTypes.assign(cloud.size(), meam::EdgeType::Crease);
  cloud.edgeTypes[1] = meam::EdgeType::HoleBorder;
  for (const auto method : { meam::TangentMethod::RobustLine, meam::TangentMethod::Tiles })
  {
    settings.method = method;
    const meam::LocalCloud local = meam::toLocalCloud(cloud);
    const meam::ThinnedEdges found = meam::estimateTangents(local, 50.0, Down, settings);
    ASSERT_EQ(found.indices.size(), 11u) << "the middle of the line is that of a cube";
    EXPECT_EQ(found.edges.cloud.points, local.cloud.subset(found.indices).points);
    EXPECT_EQ(found.edges.cloud.tangents, local.cloud.subset(found.indices).tangents);
    EXPECT_EQ(found.edges.cloud.weights, std::vector<float>(11, 1.0f));
    EXPECT_TRUE(found.edges.T_local_scene.matrix() == local.T_local_scene.matrix());
    const meam::PointCloud edges = cloud.subset(found.indices);
    EXPECT_EQ(edges.edgeTypes, std::vector<meam::EdgeType>(11, meam::EdgeType::Crease));
    EXPECT_EQ(parts::withTangents(edges, 50.0, Down, settings).points, edges.points);
  }
  // Nothing else has to be known of the part.
  meam::TangentEstimationSettings given;
  given.leafSize = 1.0;
  EXPECT_NO_THROW(parts::withTangents(parts::withTangents(line({ 1, 0, 0 }, 41, 0.5f), 50.0, Down), 0.0, Down, given));
}

/// A line of 40 mm, another of 5 mm, and a circle of a radius of 6 mm: of a part of 50 mm the first is a segment.
TEST(TangentEstimation, OfLineSegmentsOnlyPointsOnLongLinesStay)
{
  meam::PointCloud cloud = line({ 1, 0, 0 }, 81, 0.5f);
  for (const Eigen::Vector3f& point : line({ 0, 1, 0 }, 11, 0.5f).points)
  {
    cloud.points.push_back(point + Eigen::Vector3f(0, 30, 0));
  }
  for (const Eigen::Vector3f& point : circle(6.0f, 80).points)
  {
    cloud.points.push_back(point + Eigen::Vector3f(20, -30, 0));
  }
  cloud.pointIds.clear();
  meam::TangentEstimationSettings settings;
  settings.method = meam::TangentMethod::LineSegments;
  settings.leafSize = -1.0;
  const meam::PointCloud found = parts::withTangents(cloud, 50.0, Down, settings);
  ASSERT_EQ(found.size(), 81u);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_EQ(found.points[i].y(), 0.0f);
    EXPECT_NEAR(std::abs(found.tangents[i].x()), 1.0, 1e-5);
  }
  // A gap ends a segment: two runs of 19.5 mm stay, when no more is asked for.
  meam::PointCloud broken = line({ 1, 0, 0 }, 120, 0.5f);
  broken.points.erase(broken.points.begin() + 40, broken.points.begin() + 80);
  broken.pointIds.clear();
  settings.segmentLength = 19.0;
  EXPECT_EQ(parts::withTangents(broken, 50.0, Down, settings).size(), 80u);
  settings.segmentLength = 20.0;
  EXPECT_EQ(parts::withTangents(broken, 50.0, Down, settings).size(), 0u);
}

TEST(TangentEstimation, EdgesSayWhereTheyComeFrom)
{
  meam::LocalCloud edges = meam::toLocalCloud(line({ 1, 0, 0 }, 30, 0.5f));
  EXPECT_FALSE(meam::estimateTangents(edges, 50.0, Down).edges.fromScan);
  edges.fromScan = true;
  EXPECT_TRUE(meam::estimateTangents(edges, 50.0, Down).edges.fromScan);
}

TEST(TangentEstimation, BadInput)
{
  EXPECT_THROW(parts::withTangents({}, 50.0, Down), meam::Error);
  meam::PointCloud invalid;
  invalid.points.assign(5, Eigen::Vector3f::Constant(NAN));
  EXPECT_THROW(parts::withTangents(invalid, 50.0, Down), meam::Error);
  EXPECT_THROW(parts::withTangents(line({ 1, 0, 0 }, 10, 1.0f), 0.0, Down), meam::Error);     // no length known
  EXPECT_THROW(parts::withTangents(line({ 1, 0, 0 }, 30, 0.0005f), 50.0, Down), meam::Error); // in metres
  const meam::PrecisePoints far(5, Eigen::Vector3d(1e300, 0.0, 0.0));
  EXPECT_THROW(
    meam::estimateTangents(meam::toLocalCloud(far, {}, {}, Eigen::Isometry3d::Identity()), 50.0, Down), meam::Error);
  meam::PointCloud some = line({ 1, 0, 0 }, 30, 0.5f);
  some.points[3].x() = NAN;
  EXPECT_NO_THROW(parts::withTangents(some, 50.0, Down));
}
