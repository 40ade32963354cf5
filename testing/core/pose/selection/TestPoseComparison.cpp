// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/PoseComparison.h"

#include "TestScene.h"
#include "base/Bounds.h"
#include "base/sequences/Sequences.h"

#include <gtest/gtest.h>

namespace
{
/// Quarter turns and flips are near-symmetries.
const meam::TrainedModel& comparedPlate() { return scenes::trained<parts::cutPlate>(); }

/// The plate lying as it was drawn, its upper side seen; with `hidden` the quarter of the cut is not.
scenes::Seen lyingPlate(bool hidden)
{
  scenes::Seen seen = scenes::seenFromAbove({ scenes::Copy{ parts::cutPlate(), Eigen::Isometry3d::Identity() } });
  const auto isHidden = [&](const auto& p) { return hidden && p.x() > 5 && p.y() > 5; };
  const auto drop = [&](meam::Points& points) { meam::eraseIf(points, isHidden); };
  drop(seen.surface);
  drop(seen.edges.points);
  return scenes::withTangents(seen, comparedPlate().diameter);
}

Eigen::Isometry3d quarterTurns(int turns)
{
  return meam::turnAbout(Eigen::Vector3d::UnitZ(), turns * M_PI / 2, Eigen::Vector3d::Zero());
}

/// Compares poses, in the scene's coordinates, of the plate.
struct Comparing
{
  explicit Comparing(const scenes::Seen& seen, const meam::PoseComparisonSettings& settings = {})
    : scene(scenes::prepared(seen, comparedPlate().diameter))
    , comparison(scene, comparedPlate(), settings)
  {
  }

  meam::PoseComparison::Contender at(int turns) const { return this->comparison.contender(this->local(turns)); }
  Eigen::Isometry3d local(int turns) const { return this->scene.T_local_scene() * quarterTurns(turns); }

  meam::Scene scene;
  meam::PoseComparison comparison;
};

/// Of the true pose over a quarter turn.
double advantageIn(const scenes::Seen& seen, const meam::PoseComparisonSettings& settings = {})
{
  const Comparing in(seen, settings);
  return in.comparison.advantage(in.at(0), in.at(1));
}
}

TEST(PoseComparison, TheCutCornerDecidesBetweenTurns)
{
  const Comparing in(lyingPlate(false));
  for (int turns = 1; turns < 4; ++turns)
  {
    const double advantage = in.comparison.advantage(in.at(0), in.at(turns));
    EXPECT_GT(advantage, 20.0) << turns;
    EXPECT_NEAR(in.comparison.advantage(in.at(turns), in.at(0)), -advantage, 1e-9) << "antisymmetric";
  }
  EXPECT_EQ(in.comparison.advantage(in.at(0), in.at(0)), 0.0);
}

TEST(PoseComparison, WhatIsFarBehindIsNotLookedAtToTheEnd)
{
  const Comparing in(lyingPlate(false));
  const meam::PoseComparison::Contender right = in.at(0);
  const double whole = in.comparison.advantage(in.at(1), right);
  EXPECT_EQ(in.comparison.advantage(in.local(1), right, -1e9), whole);
  const double most = in.comparison.advantage(in.local(1), right, 1e9);
  EXPECT_GE(most, whole);
  EXPECT_LT(most, 0.0);
}

TEST(PoseComparison, WhatIsNotSeenDecidesNothing)
{
  const Comparing in(lyingPlate(true));
  // Turned by 180 degrees the cut would lie where whole surface was seen.
  EXPECT_GT(in.comparison.advantage(in.at(0), in.at(2)), 5.0);
  const scenes::Seen nothing = []
  {
    scenes::Seen half = lyingPlate(true);
    const auto far = [](const auto& p) { return std::abs(p.x()) > 10 || std::abs(p.y()) > 10; };
    meam::eraseIf(half.surface, far);
    half.edges = half.edges.subset({ 0 });
    half.edges.points[0].x() += 1000.0f; // none here
    return half;
  }();
  EXPECT_LT(std::abs(advantageIn(nothing)), 1.0);
}

TEST(PoseComparison, FloorSeenWhereAPoseHasSurfaceSpeaksAgainstIt)
{
  const scenes::Seen onTheFloor = []
  {
    scenes::Seen seen = lyingPlate(false);
    for (float x = -29.5f; x < 30.0f; x += 0.7f)
    {
      for (float y = -29.5f; y < 30.0f; y += 0.7f)
      {
        const bool besideTheCut = (x - 6.0f) * 10.0f + (y - 30.0f) * 24.0f > 0.0f; // beyond the line of the corner
        if (besideTheCut)
        {
          seen.surface.push_back({ x, y, -40.0f });
        }
      }
    }
    return seen;
  }();
  EXPECT_GT(advantageIn(onTheFloor), advantageIn(lyingPlate(false)) + 5.0);
  meam::PoseComparisonSettings settings;
  settings.freeSpace = false;
  EXPECT_LE(advantageIn(onTheFloor, settings), advantageIn(lyingPlate(false), settings));
}

TEST(PoseComparison, WhatBothPredictDoesNotCountUnlessEachIsComparedByAllThatItPredicts)
{
  // Over a quarter that the true pose and a quarter turn both cover the sensor saw past the plate: against either, by
  // as many points as it happens to predict there.
  const auto advantage = [](bool torn, bool sameVisibility)
  {
    scenes::Seen seen = lyingPlate(false);
    for (auto& point : seen.surface)
    {
      point.z() -= torn && point.x() < -2 && point.y() < -2 ? 40.0f : 0.0f;
    }
    meam::PoseComparisonSettings settings;
    settings.sameVisibility = sameVisibility;
    return advantageIn(seen, settings);
  };
  EXPECT_NEAR(advantage(true, true), advantage(false, true), 1e-9);
  EXPECT_GT(std::abs(advantage(true, false) - advantage(false, false)), 1.0);
}

TEST(PoseComparison, EdgesThatShouldBeOutOfSightCountHalf)
{
  // A scene edge runs where the lower edge of the true pose's cut corner is, which the plate hides.
  const scenes::Seen without = lyingPlate(false);
  scenes::Seen seen = scenes::seenFromAbove({ scenes::Copy{ parts::cutPlate(), Eigen::Isometry3d::Identity() } });
  const float below = meam::bounds(parts::cutPlate().vertices).min().z();
  for (float along = 0.1f; along < 0.9f; along += 0.02f)
  {
    seen.edges.points.push_back({ 6.0f + 24.0f * along, 30.0f - 10.0f * along, below });
  }
  seen = scenes::withTangents(seen, comparedPlate().diameter);
  const Comparing in(seen);
  const Eigen::Isometry3d back = in.scene.T_local_scene().inverse();
  const meam::Points& edges = in.scene.edgePoints().points;
  const auto isBelow = [&](const Eigen::Vector3f& point) { return (back * point.cast<double>()).z() < below + 0.5; };
  const double added = static_cast<double>(std::count_if(edges.begin(), edges.end(), isBelow));
  EXPECT_GT(added, 5.0);
  EXPECT_NEAR(in.comparison.advantage(in.at(0), in.at(1)) - advantageIn(without), 0.5 * 3.0 * added, 1.5);
}

TEST(PoseComparison, EdgesAloneDecide)
{
  scenes::Seen edgesOnly = lyingPlate(false);
  edgesOnly.surface.clear();
  EXPECT_GT(advantageIn(edgesOnly), 5.0);
}
