// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/LookalikeDecision.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
const meam::Contradictions Nothing;
const meam::Contradictions GoesOn{ 2.0, 0.0 };
}

TEST(LookalikeDecision, WhatNothingContradictsSpeaksForThePartAndTheRestAgainstIt)
{
  EXPECT_GT(Nothing.logRatio(), 0.0);
  EXPECT_LT(GoesOn.logRatio(), 0.0);
  EXPECT_LT((meam::Contradictions{ 0.0, 2.0 }).logRatio(), 0.0);
  EXPECT_LT((meam::Contradictions{ 2.0, 2.0 }).logRatio(), GoesOn.logRatio());
}

TEST(LookalikeDecision, APoseThatIsNotThereLeavesWhatIsKnownBefore)
{
  // Nineteen of twenty are of the part before anything is seen.
  for (const meam::Contradictions& one : { Nothing, GoesOn })
  {
    const double odds = 19.0 * std::exp(one.logRatio());
    EXPECT_NEAR(meam::sharesOfPart({ one }, { 0.0 })[0], odds / (1.0 + odds), 1e-12);
  }
}

TEST(LookalikeDecision, WhereWhatIsSeenLooksAlikeWhatIsHiddenDoesToo)
{
  EXPECT_GT(meam::sharesOfPart({ Nothing }, { 1.0 })[0], 0.9);
  std::vector<meam::Contradictions> poses(100, GoesOn);
  poses.push_back(Nothing);
  EXPECT_LT(meam::sharesOfPart(poses, std::vector<double>(101, 1.0)).back(), 0.5);
  EXPECT_GT(meam::sharesOfPart(poses, std::vector<double>(101, 0.0)).back(), 0.9) << "of poses that are there";
}

TEST(LookalikeDecision, OneThatIsContradictedAmongManyThatAreNotIsTheOther)
{
  std::vector<meam::Contradictions> poses(20, Nothing);
  poses.push_back(GoesOn);
  const std::vector<double> shares = meam::sharesOfPart(poses, std::vector<double>(21, 1.0));
  EXPECT_GT(shares.front(), 0.95);
  EXPECT_LT(shares.back(), 0.7);
}
