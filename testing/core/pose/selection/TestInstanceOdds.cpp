// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/InstanceOdds.h"

#include "TestScene.h"
#include "base/sequences/Sequences.h"
#include "pose/verification/PoseVerification.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
meam::TriangleMesh rod() { return parts::box({ -30, -5, -5 }, { 30, 5, 5 }); }

/// What is left of the log odds of rods of 60 mm along x, whose middles are at these places and a little beside each
/// other.
std::vector<double> withoutOverlaps(const std::vector<std::pair<double, double>>& placesAndOdds)
{
  meam::FinishedInstances found;
  for (const auto& [x, logOdds] : placesAndOdds)
  {
    meam::FinishedInstance& one = found.emplace_back();
    one.pose.T_scene_model.translation() << x, 2.5 * found.size(), 2.5 * found.size();
    one.logOdds = logOdds;
    meam::setEvidence(one.pose, logOdds);
  }
  meam::excludeOverlaps(found, scenes::trained<rod>());
  return meam::mapped<double>(found, [&](const meam::FinishedInstance& one) { return one.logOdds; });
}
}

TEST(InstanceOdds, OfBodiesThatCutIntoEachOtherOneIsRightAtMost)
{
  EXPECT_EQ(withoutOverlaps({ { 0.0, 4.0 }, { 61.0, 2.0 } }), (std::vector<double>{ 4.0, 2.0 })) << "beside";
  const std::vector<double> two = withoutOverlaps({ { 0.0, 4.0 }, { 45.0, 2.0 } });
  EXPECT_NEAR(two[0], 4.0 - std::log1p(std::exp(2.0)), 1e-9);
  EXPECT_NEAR(two[1], 2.0 - std::log1p(std::exp(4.0)), 1e-9);
  for (const double logOdds : withoutOverlaps({ { 0.0, 3.0 }, { 10.0, 3.0 }, { -10.0, 3.0 } }))
  {
    EXPECT_NEAR(logOdds, 3.0 - std::log1p(2.0 * std::exp(3.0)), 1e-9) << "all exclude each other";
  }
}

TEST(InstanceOdds, WhatABetterPoseExcludesHardlyExcludes)
{
  const std::vector<double> row = withoutOverlaps({ { 0.0, 8.0 }, { 45.0, 4.0 }, { 90.0, 3.0 } });
  EXPECT_NEAR(row[0], 8.0 - std::log1p(std::exp(4.0) / (1.0 + std::exp(3.0))), 1e-9);
  EXPECT_LT(row[1], -3.0);
  EXPECT_NEAR(row[2], 3.0 - std::log1p(std::exp(4.0) / (1.0 + std::exp(8.0))), 1e-9);
}

TEST(InstanceOdds, EachPatchThatDiffersTellsOfAnotherPart)
{
  const auto placeWith = [](int missing, int surplus, double excused)
  {
    meam::FinishedInstances found(1);
    found[0].logOdds = std::log(0.9 / 0.1);
    meam::allowForDifferences(found, { missing, surplus }, excused);
    EXPECT_EQ(found[0].pose.contradictions.missing, missing);
    return 1.0 / (1.0 + std::exp(-found[0].logOdds));
  };
  EXPECT_NEAR(placeWith(0, 0, 0.0), 0.9, 1e-9);
  EXPECT_NEAR(placeWith(1, 0, 0.0), 0.9 / (1.0 + std::exp(2.0)), 1e-9);
  EXPECT_NEAR(placeWith(1, 0, 0.8), placeWith(1, 0, 0.0), 1e-9) << "what is missing is not excused";
  EXPECT_NEAR(placeWith(0, 1, 0.0), placeWith(1, 0, 0.0), 1e-9);
  EXPECT_NEAR(placeWith(0, 1, 0.8), 0.9, 1e-9) << "excused";
  EXPECT_NEAR(placeWith(0, 4, 0.8), placeWith(0, 1, 0.0), 1e-9);
  EXPECT_LT(placeWith(2, 0, 0.0), 0.01);
  EXPECT_LT(placeWith(1, 1, 0.0), 0.01);
}

TEST(InstanceOdds, WhatLiesOnAnotherTypesCopyTellsNothingOfTheOthers)
{
  meam::FinishedInstances found(2);
  for (meam::FinishedInstance& one : found)
  {
    one.logOdds = 3.0;
    meam::setEvidence(one.pose, one.logOdds);
  }
  found[1].pose.contradictions.misfit = 100.0;
  EXPECT_EQ(meam::likelyOf(found, 9).size(), 2u);
  const meam::SurfaceContinuation continuation(scenes::copiesScene(), scenes::bracket());
  const auto firstOf = [&](meam::FinishedInstances instances)
  {
    meam::allowForLookalikes(instances, scenes::bracket(), continuation, 0.0);
    return instances[0].logOdds;
  };
  const double withOther = firstOf(found);
  found[1].isOnOther = true;
  EXPECT_FALSE(meam::tells(found[1]));
  EXPECT_EQ(meam::likelyOf(found, 9).size(), 1u);
  EXPECT_GT(firstOf(found), withOther + 0.1);
  EXPECT_NEAR(firstOf(found), firstOf({ found[0] }), 1e-12);
}
