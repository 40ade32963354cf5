// SPDX-License-Identifier: BSD-3-Clause
#include "scene/depth/FineDepth.h"

#include "base/Parallel.h"
#include "scene/depth/DepthMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{
meam::Sensor sensorAt(const Eigen::Vector3d& position)
{
  meam::Sensor sensor;
  sensor.position = position;
  sensor.direction = Eigen::Vector3d::UnitZ();
  return sensor;
}

/// Rows of 150 points along x, with noise, of which every seventh is not measured: some cells have none, and runs of
/// points end within rows.
meam::Points scan()
{
  std::mt19937 random(4);
  std::uniform_real_distribution<float> noise(-0.2f, 0.2f);
  meam::Points points;
  for (int k = 0; k < 150 * 120; ++k)
  {
    const float x = static_cast<float>(k % 150), y = static_cast<float>(k / 150);
    const float z = k % 7 == 0 ? NAN : 500.0f + (x > 70.0f ? 20.0f : 0.0f);
    points.emplace_back(x + noise(random), y + noise(random), z + noise(random));
  }
  return points;
}

/// Expects what the depth map, which looks at everything at once, has in the cells without gaps.
void expectSame(const meam::FineDepth& fine, const meam::DepthMap& map, int cell)
{
  const Eigen::Vector3f* mean = fine.meanIn(cell);
  ASSERT_EQ(mean != nullptr, map.isMeasured(cell)) << cell;
  const float depth = fine.depthIn(cell % map.columns(), cell / map.columns());
  ASSERT_EQ(std::isnan(depth), !mean);
  if (mean)
  {
    EXPECT_EQ(*mean, map.meanIn(cell));
    EXPECT_EQ(depth, map.depthIn(cell));
  }
}
}

TEST(FineDepth, HasInEachTileWhatWasMeasuredThere)
{
  meam::Points points = scan();
  for (const bool isShuffled : { false, true })
  {
    if (isShuffled)
    {
      std::shuffle(points.begin(), points.end(), std::mt19937(5));
    }
    const meam::ScanProjection lines(points, sensorAt({ 70, 60, 0 }));
    const meam::FineDepth fine(lines, 1.1);
    const meam::DepthMap map(lines, 1.1);
    ASSERT_EQ(fine.cellCount(), map.cellCount());
    int measured = 0;
    for (int cell = map.cellCount() - 1; cell >= 0; --cell)
    {
      expectSame(fine, map, cell);
      measured += map.isMeasured(cell);
    }
    EXPECT_GT(measured, 0);
    EXPECT_LT(measured, map.cellCount());
    std::mt19937 random(6);
    std::uniform_real_distribution<float> along(-10.0f, 160.0f), height(495.0f, 525.0f);
    for (int k = 0; k < 1000; ++k)
    {
      const Eigen::Vector3f asked(along(random), along(random), height(random));
      EXPECT_EQ(fine.relation(asked, 2.0f), map.relationToMean(asked, 2.0f));
    }
  }
}

TEST(FineDepth, ShuffledPointsAreOneTile)
{
  // Of more tiles each would look at all points again.
  meam::Points points = scan();
  for (const bool isShuffled : { false, true })
  {
    if (isShuffled)
    {
      std::shuffle(points.begin(), points.end(), std::mt19937(5));
    }
    const meam::ScanProjection lines(points, sensorAt({ 70, 60, 0 }));
    const meam::FineDepth fine(lines, 1.3);
    const meam::DepthMap map(lines, 1.3);
    const int row = map.cellAt({ 70, 60, 500 }) / map.columns();
    std::vector<const Eigen::Vector3f*> starts; // where the row would start in memory, by each of its cells
    for (int column = 0; column < map.columns(); ++column)
    {
      if (const Eigen::Vector3f* mean = fine.meanIn(column, row))
      {
        starts.push_back(mean - column);
      }
    }
    ASSERT_GT(starts.size(), 80u);
    EXPECT_EQ(std::equal(starts.begin() + 1, starts.end(), starts.begin()), isShuffled);
  }
}

TEST(FineDepth, TheSameForCallsInParallel)
{
  const meam::Points points = scan();
  const meam::ScanProjection lines(points, sensorAt({ 70, 60, 0 }), 3);
  const meam::FineDepth fine(lines, 1.1);
  const meam::DepthMap map(lines, 1.1);
  meam::parallelForEach(map.cellCount(), 4, {}, [&](int cell) { fine.meanIn((cell * 37) % map.cellCount()); });
  for (int cell = 0; cell < map.cellCount(); ++cell)
  {
    expectSame(fine, map, cell);
  }
}

TEST(FineDepth, EqualPointsAndSomeFarOff)
{
  meam::Points points(64 * 300, Eigen::Vector3f(0, 0, 500)); // runs that come to one cell each
  points.insert(points.end(), { { 900, 0, 500 }, { 0, 900, 500 } });
  const meam::ScanProjection lines(points, sensorAt({ 0, 0, 0 }));
  const meam::FineDepth fine(lines, 0.5);
  const meam::DepthMap map(lines, 0.5);
  for (const Eigen::Vector3f& point : { points.front(), points[points.size() - 2], points.back() })
  {
    ASSERT_GE(map.cellAt(point), 0);
    expectSame(fine, map, map.cellAt(point));
  }
  expectSame(fine, map, map.cellCount() - 1);
}

TEST(FineDepth, NothingMeasuredHasNoCells)
{
  const meam::Points points;
  const meam::ScanProjection lines(points, sensorAt({ 0, 0, 0 }));
  const meam::FineDepth fine(lines, 1.0);
  EXPECT_EQ(fine.cellCount(), 0);
  EXPECT_EQ(fine.relation({ 0, 0, 1 }, 1.0f), meam::FineDepth::Relation::NoSurface);
}
