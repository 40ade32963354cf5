// SPDX-License-Identifier: BSD-3-Clause
#include "base/BlockedPoints.h"

#include "TestParts.h"

#include <algorithm>
#include <numeric>

namespace
{
constexpr int Size = meam::BlockedPoints::Size;

/// Indices of all points of the blocks within a radius.
std::vector<int> within(const meam::BlockedPoints& blocks, const Eigen::Vector3f& centre, double radius)
{
  std::vector<int> found;
  for (const int block : blocks.within(centre, radius))
  {
    const int end = std::min((block + 1) * Size, static_cast<int>(blocks.order().size()));
    found.insert(found.end(), blocks.order().begin() + block * Size, blocks.order().begin() + end);
  }
  return found;
}
}

TEST(BlockedPoints, HaveEveryPointOnce)
{
  for (const int count : { 1, 15, 16, 17, 500, 4097 })
  {
    const meam::BlockedPoints blocks(parts::scattered(count, 20.0));
    std::vector<int> order = blocks.order();
    std::sort(order.begin(), order.end());
    std::vector<int> expected(count);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(order, expected);
  }
}

TEST(BlockedPoints, AreTheSameForAnyNumberOfThreads)
{
  const meam::Points points = parts::scattered(4097, 20.0);
  EXPECT_EQ(meam::BlockedPoints(points, 4).order(), meam::BlockedPoints(points).order());
}

TEST(BlockedPoints, MissNoPointWithinTheRadius)
{
  const meam::Points points = parts::scattered(6000, 20.0); // more blocks than are looked at together
  const meam::BlockedPoints blocks(points);
  for (const double radius : { 0.0, 0.5, 6.0, 100.0 })
  {
    for (std::size_t k = 0; k < points.size(); k += 97)
    {
      std::vector<int> found = within(blocks, points[k], radius);
      std::sort(found.begin(), found.end());
      EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        if ((points[i] - points[k]).norm() <= radius)
        {
          EXPECT_TRUE(std::binary_search(found.begin(), found.end(), static_cast<int>(i)))
            << i << " within " << radius << " of " << k;
        }
      }
    }
  }
}

TEST(BlockedPoints, LeaveOutWhatIsFar)
{
  const meam::Points points = parts::scattered(6000, 20.0);
  const meam::BlockedPoints blocks(points);
  const double inside =
    std::count_if(points.begin(), points.end(), [](const auto& point) { return point.norm() <= 15.0f; });
  EXPECT_LT(within(blocks, Eigen::Vector3f::Zero(), 15.0).size(), 2.0 * inside);
  EXPECT_TRUE(blocks.within({ 100.0f, 0.0f, 0.0f }, 10.0).empty());
}

TEST(BlockedPoints, ManyEqualPointsAreSplitToo)
{
  const meam::BlockedPoints blocks(meam::Points(1000, Eigen::Vector3f::Ones()));
  EXPECT_EQ(within(blocks, Eigen::Vector3f::Ones(), 0.0).size(), 1000u);
}

TEST(BlockedPoints, PointsThatAreNotFiniteAreLeftOut)
{
  meam::Points points = parts::scattered(40, 20.0);
  points[3].y() = NAN;
  points[20].z() = INFINITY;
  const meam::BlockedPoints blocks(points);
  EXPECT_EQ(blocks.order().size(), 38u);
  EXPECT_EQ(std::count(blocks.order().begin(), blocks.order().end(), 3), 0);
  EXPECT_EQ(within(blocks, Eigen::Vector3f::Zero(), 1000.0).size(), 38u);
  EXPECT_TRUE(meam::BlockedPoints({}).within(Eigen::Vector3f::Zero(), 1.0).empty());
}
