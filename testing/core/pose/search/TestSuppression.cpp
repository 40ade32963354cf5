// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/Suppression.h"

#include "TestScene.h"

#include <cstdlib>

namespace
{
using Places = std::vector<int>;

/// Of numbers, best first, those that stay where numbers that differ by 1 are rivals.
Places stayingOf(const Places& numbers, bool laterIsBetter)
{
  return meam::suppress(
    static_cast<int>(numbers.size()), [&](int a, int b) { return std::abs(numbers[a] - numbers[b]) <= 1; },
    [&](int, int) { return laterIsBetter; });
}
}

TEST(Suppression, TheFirstOfRivalsStays)
{
  EXPECT_EQ(stayingOf({}, false), Places{});
  EXPECT_EQ(stayingOf({ 5, 6, 7, 1 }, false), (Places{ 0, 2, 3 })) << "what is suppressed suppresses nothing";
}

TEST(Suppression, OneThatBeatsAllItsRivalsTakesTheirPlace)
{
  EXPECT_EQ(stayingOf({ 5, 1, 7, 6 }, true), (Places{ 1, 3 }));
  const auto beatsTheFirstAlone = [](int, int other) { return other == 0; };
  EXPECT_EQ(meam::suppress(
              3, [](int a, int) { return a == 2; }, beatsTheFirstAlone),
    (Places{ 0, 1 }));
}

TEST(Suppression, PointsOnThePartAreExplained)
{
  const meam::Scene& scene = scenes::copiesScene();
  const Eigen::Isometry3d one = scene.T_local_scene() * scenes::threeCopies()[0];
  const Eigen::Isometry3d other = scene.T_local_scene() * scenes::threeCopies()[1];
  const auto explained = [&](const Eigen::Isometry3d& T)
  { return meam::explainedPoints(scene, scenes::bracket(), T, 0.02 * scenes::bracket().diameter); };
  const meam::ExplainedPoints points = explained(one);
  EXPECT_GT(points.size(), 100u);
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end()));
  EXPECT_EQ(meam::sharedPoints(points, points), points.size());
  EXPECT_EQ(meam::sharedPoints(points, explained(other)), 0u);
  EXPECT_GT(meam::sharedPoints(points, explained(scenes::displaced(one, 0.5).T_scene_model)), points.size() / 2);
}
