// SPDX-License-Identifier: BSD-3-Clause
#include "base/LocalFrame.h"

#include "TestParts.h"
#include "scene/Scene.h"
#include "base/Frames.h"

#include <gtest/gtest.h>

namespace
{
/// Skewed along each axis, so that the principal frame is clear.
meam::PrecisePoints skewed(int count)
{
  std::mt19937 random(4);
  std::gamma_distribution<double> distance(2.0, 1.0);
  meam::PrecisePoints points;
  for (int i = 0; i < count; ++i)
  {
    points.emplace_back(90.0 * distance(random), 40.0 * distance(random), 10.0 * distance(random));
  }
  return points;
}

meam::FramedPoints framed(const meam::PrecisePoints& points, int threads = 1)
{
  return meam::inOwnFrame(points.front().data(), points.size(), threads);
}

/// Sensible poses have a middle far from the frame's origin.
const Eigen::Isometry3d& somewhere()
{
  static const Eigen::Isometry3d T = []
  {
    std::mt19937 random(9);
    return parts::motion(random, 800.0);
  }();
  return T;
}
}

TEST(OwnFrame, OfPointsOnALine)
{
  // Their mean is (3, 0, 2); along x they are skewed towards greater values.
  const meam::Points points{ { 0, 0, 2 }, { NAN, 0, 2 }, { 1, 0, 2 }, { 8, 0, 2 }, { 1, INFINITY, 2 } };
  const meam::FramedPoints own = meam::inOwnFrame(points);
  ASSERT_EQ(own.points.size(), 3u) << "those that are finite";
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_TRUE(own.points[k].isApprox(Eigen::Vector3f(k == 0 ? -3.0f : k == 1 ? -2.0f : 5.0f, 0, 0), 1e-6f)) << k;
  }
  EXPECT_TRUE(meam::inOwnFrame(meam::Points{}).points.empty());
}

TEST(LocalFrame, PointsThatAreBlankedOrNotFiniteAreLeftOut)
{
  constexpr int count = 3000; // more than one block
  std::vector<double> xyz;
  std::vector<std::uint8_t> flags(count, 1);
  meam::Points expected;
  const Eigen::Isometry3d frame = somewhere();
  for (int i = 0; i < count; ++i)
  {
    const Eigen::Vector3d point(i % 11 == 0 ? NAN : i, i % 13 == 0 ? INFINITY : 2 * i, i == 7 ? 1e200 : -i);
    xyz.insert(xyz.end(), point.data(), point.data() + 3);
    flags[i] = i % 5 == 0 ? 6 : 4;
    if (point.allFinite() && i % 5 != 0 && i != 7)
    {
      expected.push_back((frame * point).cast<float>());
    }
  }
  for (const int threads : { 1, 3 })
  {
    EXPECT_EQ(meam::toFrame(meam::ScanPoints<double>{ xyz.data(), count, flags.data(), 2 }, frame, threads), expected);
  }
  const std::vector<float> rounded(xyz.begin(), xyz.end());
  EXPECT_EQ(meam::toFrame(meam::ScanPoints<float>{ rounded.data(), count, flags.data(), 2 }, frame), expected);
  EXPECT_GT(meam::toFrame(meam::ScanPoints<double>{ xyz.data(), count }, frame).size(), expected.size());
  EXPECT_TRUE(meam::toFrame(meam::ScanPoints<float>{}, frame).empty());
}

TEST(OwnFrame, ThePrecisionOfPointsFarAway)
{
  // In single precision coordinates of 1e6 mm are told to 0.06 mm.
  const meam::PrecisePoints points = skewed(1000);
  meam::PrecisePoints far = points;
  for (auto& point : far)
  {
    point += Eigen::Vector3d(1e6, -2e6, 3e6);
  }
  const meam::FramedPoints here = framed(points), there = framed(far);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_LT((here.points[i] - there.points[i]).norm(), 1e-3f);
  }
}

TEST(OwnFrame, AMotionChangesHardlyABit)
{
  const meam::PrecisePoints points = skewed(20000);
  const meam::FramedPoints here = framed(points), there = framed(parts::moved(points, somewhere()));
  int different = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    different += here.points[i] != there.points[i] ? 1 : 0;
  }
  EXPECT_LT(different, 5) << "roundings that fall between two numbers";
  EXPECT_TRUE((there.frame * somewhere()).isApprox(here.frame, 1e-9));
}

TEST(OwnFrame, TheSameForAnyNumberOfThreads)
{
  meam::PrecisePoints points = skewed(5000);
  for (std::size_t i = 0; i < points.size(); i += 7)
  {
    points[i].y() = NAN;
  }
  const meam::FramedPoints one = framed(points, 1), three = framed(points, 3);
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.points.size(), 5000u - 715u);
}

TEST(OwnFrame, ACloudKeepsWhatBelongsToItsPoints)
{
  meam::PointCloud edges;
  edges.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 8, 0, 0 }, { NAN, 0, 0 } };
  edges.tangents = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 } };
  edges.weights = { 1.0f, 0.5f, 0.25f, 1.0f };
  const auto [frame, own] = meam::inOwnFrame(meam::PreciseCloud(edges));
  ASSERT_EQ(own.size(), 4u);
  EXPECT_FALSE(own.points[3].allFinite());
  EXPECT_EQ(own.weights, edges.weights);
  for (int k = 0; k < 4; ++k)
  {
    EXPECT_TRUE(own.tangents[k].isApprox((frame.linear() * edges.tangents[k].cast<double>()).cast<float>()));
  }
}

TEST(OwnFrame, ASceneIsTheSameWhereverItLies)
{
  meam::PreciseCloud edges;
  edges.points = skewed(500);
  edges.tangents.assign(500, Eigen::Vector3d(1, 2, -2) / 3.0);
  const meam::PrecisePoints surface = skewed(3000);
  const meam::Sensor sensor{ true, { 10, 20, 900 }, { 0, 0, -1 } };
  const meam::Scene here = meam::sceneInOwnFrame(edges, framed(surface), sensor);
  const meam::Scene there = meam::sceneInOwnFrame(parts::moved(edges, somewhere()),
    framed(parts::moved(surface, somewhere())),
    { true, somewhere() * sensor.position, somewhere().linear() * sensor.direction });
  for (std::size_t i = 0; i < edges.points.size(); ++i)
  {
    EXPECT_LT((here.edges.points[i] - there.edges.points[i]).norm(), 1e-4f);
    EXPECT_LT((here.edges.tangents[i] - there.edges.tangents[i]).norm(), 1e-6f);
  }
  EXPECT_LT((here.sensor.position - there.sensor.position).norm(), 1e-9);
  EXPECT_LT((here.sensor.direction - there.sensor.direction).norm(), 1e-12);
  // Poses as well; of those that a half turn makes equal the same one.
  meam::Symmetries half;
  half.discrete = { meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI, { 1, 2, 3 }) };
  std::mt19937 random(5);
  for (int k = 0; k < 20; ++k)
  {
    meam::Pose pose, moved, turned;
    pose.T_scene_model = parts::motion(random, 50.0);
    moved.T_scene_model = somewhere() * pose.T_scene_model;
    turned.T_scene_model = moved.T_scene_model * half.discrete[0];
    const Eigen::Isometry3d one = meam::inFrameOf(here, { pose }, half)[0].T_scene_model;
    EXPECT_TRUE(meam::inFrameOf(there, { moved }, half)[0].T_scene_model.isApprox(one, 1e-9));
    EXPECT_TRUE(meam::inFrameOf(there, { turned }, half)[0].T_scene_model.isApprox(one, 1e-9));
  }
  const meam::Scene edgesAlone = meam::sceneInOwnFrame(edges, {}, sensor);
  EXPECT_TRUE(edgesAlone.frame.isApprox(meam::principalFrame(edges.points)));
}

TEST(OwnFrame, AMotionTurnsACovariance)
{
  meam::Pose pose;
  pose.fit.covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  Eigen::Isometry3d quarter(Eigen::Translation3d(7, 8, 9));
  quarter.rotate(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ())); // x becomes y
  Eigen::Matrix<double, 6, 1> expected;
  expected << 2, 1, 3, 5, 4, 6;
  EXPECT_TRUE(meam::moved(pose, quarter).fit.covariance.diagonal().isApprox(expected, 1e-12));
}
