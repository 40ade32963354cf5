// SPDX-License-Identifier: BSD-3-Clause
#include "base/LocalCloud.h"

#include "TestParts.h"
#include "base/Frames.h"
#include "base/sequences/Sequences.h"

namespace
{
using parts::skewed;

/// In their principal frame.
meam::Points local(const meam::PrecisePoints& points, int threads = 1)
{
  return meam::toLocalPoints(
    meam::ScanPoints<double>{ points.front().data(), points.size() }, meam::principalFrame(points), threads);
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

TEST(LocalCloud, PointsOnALine)
{
  // Their mean is (3, 0, 2); along x they are skewed towards greater values.
  const meam::Points points{ { 0, 0, 2 }, { NAN, 0, 2 }, { 1, 0, 2 }, { 8, 0, 2 }, { 1, INFINITY, 2 } };
  const meam::Points found = meam::toLocalPoints(points, meam::principalFrame(parts::precise(points)));
  ASSERT_EQ(found.size(), 3u) << "those that are finite";
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_TRUE(found[k].isApprox(Eigen::Vector3f(k == 0 ? -3.0f : k == 1 ? -2.0f : 5.0f, 0, 0), 1e-6f)) << k;
  }
  EXPECT_TRUE(meam::toLocalPoints(meam::Points{}, Eigen::Isometry3d::Identity()).empty());
}

TEST(LocalCloud, PointsThatAreBlankedOrNotFiniteAreLeftOut)
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
    EXPECT_EQ(
      meam::toLocalPoints(meam::ScanPoints<double>{ xyz.data(), count, flags.data(), 2 }, frame, threads), expected);
  }
  const std::vector<float> rounded(xyz.begin(), xyz.end());
  EXPECT_EQ(meam::toLocalPoints(meam::ScanPoints<float>{ rounded.data(), count, flags.data(), 2 }, frame), expected);
  EXPECT_GT(meam::toLocalPoints(meam::ScanPoints<double>{ xyz.data(), count }, frame).size(), expected.size());
  EXPECT_TRUE(meam::toLocalPoints(meam::ScanPoints<float>{}, frame).empty());
}

TEST(LocalCloud, ThePrecisionOfPointsFarAway)
{
  // In single precision coordinates of 1e6 mm are known to 0.06 mm.
  const meam::PrecisePoints points = skewed(1000);
  meam::PrecisePoints far = points;
  for (auto& point : far)
  {
    point += Eigen::Vector3d(1e6, -2e6, 3e6);
  }
  const meam::Points here = local(points), there = local(far);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_LT((here[i] - there[i]).norm(), 1e-3f);
  }
}

TEST(LocalCloud, AMotionChangesHardlyABit)
{
  const meam::PrecisePoints points = skewed(20000);
  const meam::PrecisePoints moved = parts::moved(points, somewhere());
  const meam::Points here = local(points), there = local(moved);
  const auto isDifferent = [&](int i) { return here[i] != there[i]; };
  EXPECT_LT(meam::indicesWhere(points.size(), isDifferent).size(), 5u) << "roundings that fall between two numbers";
  EXPECT_TRUE((meam::principalFrame(moved) * somewhere()).isApprox(meam::principalFrame(points), 1e-9));
}

TEST(LocalCloud, TheSameForAnyNumberOfThreads)
{
  meam::PrecisePoints points = skewed(5000);
  for (std::size_t i = 0; i < points.size(); i += 7)
  {
    points[i].y() = NAN;
  }
  const meam::Points one = local(points, 1), three = local(points, 3);
  EXPECT_EQ(one, three);
  EXPECT_EQ(one.size(), 5000u - 715u);
  const meam::PrecisePoints finite = skewed(5000);
  const meam::PrecisePoints tangents(5000, Eigen::Vector3d(1, 2, -2) / 3.0);
  const meam::LocalCloud byOne = meam::toLocalCloud(finite, tangents, {}, somewhere(), 1);
  const meam::LocalCloud byThree = meam::toLocalCloud(finite, tangents, {}, somewhere(), 3);
  EXPECT_EQ(byOne.cloud.points, byThree.cloud.points);
  EXPECT_EQ(byOne.cloud.tangents, byThree.cloud.tangents);
}

TEST(LocalCloud, ACloudKeepsWhatBelongsToItsPoints)
{
  meam::PointCloud edges;
  edges.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 8, 0, 0 }, { NAN, 0, 0 } };
  edges.tangents = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 } };
  edges.weights = { 1.0f, 0.5f, 0.25f, 1.0f };
  const meam::LocalCloud found = meam::toLocalCloud(edges);
  const Eigen::Isometry3d& T = found.T_local_scene;
  EXPECT_TRUE(T.isApprox(meam::principalFrame(parts::precise(edges.points)), 1e-12));
  ASSERT_EQ(found.cloud.size(), 4u);
  EXPECT_FALSE(found.cloud.points[3].allFinite());
  EXPECT_EQ(found.cloud.weights, edges.weights);
  for (int k = 0; k < 4; ++k)
  {
    EXPECT_TRUE(found.cloud.tangents[k].isApprox((T.linear() * edges.tangents[k].cast<double>()).cast<float>()));
  }
}
