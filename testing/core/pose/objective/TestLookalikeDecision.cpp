// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/LookalikeDecision.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
const meam::Contradictions Nothing;
const meam::Contradictions GoesOn{ 2.0, 0.0, 0.0 };
const meam::Contradictions SeenPast{ 0.0, 2.0, 0.0 };
const meam::Contradictions Misfits{ 0.0, 0.0, 5.0 };
constexpr double Even = 0.0; // a scan that excuses nothing
}

TEST(LookalikeDecision, WhatNothingContradictsSpeaksForThePartAndTheRestAgainstIt)
{
  EXPECT_GT(Nothing.logRatio(Even), 0.0);
  for (const meam::Contradictions& one : { GoesOn, SeenPast, Misfits })
  {
    EXPECT_LT(one.logRatio(Even), 0.0);
  }
  EXPECT_LT((meam::Contradictions{ 2.0, 2.0, 0.0 }).logRatio(Even), GoesOn.logRatio(Even));
  EXPECT_EQ((meam::Contradictions{ 0.0, 0.0, 1.0 }).logRatio(Even), Nothing.logRatio(Even)) << "as is expected";
}

TEST(LookalikeDecision, AnUnevenScanExcusesSome)
{
  const meam::Contradictions some{ 0.5, 0.5, 0.0 };
  EXPECT_LT(some.logRatio(Even), 0.0);
  EXPECT_EQ(some.logRatio(0.9), Nothing.logRatio(0.9));
  EXPECT_LT(GoesOn.logRatio(0.9), 0.0);
}

TEST(LookalikeDecision, APoseThatIsNotThereLeavesWhatIsKnownBefore)
{
  for (const meam::Contradictions& one : { Nothing, GoesOn })
  {
    const double ratio = std::exp(one.logRatio(Even));
    const auto shareOf = [ratio](double part) { return part * ratio / (part * ratio + 1.0 - part); };
    EXPECT_NEAR(meam::sharesOfPart({ one }, { 0.0 }, Even)[0],
      0.88 * shareOf(0.97) + 0.02 * shareOf(0.5) + 0.1 * shareOf(0.03), 1e-12);
  }
}

TEST(LookalikeDecision, WhereWhatIsSeenLooksAlikeWhatIsHiddenDoesToo)
{
  EXPECT_GT(meam::sharesOfPart({ Nothing }, { 1.0 }, Even)[0], 0.9);
  std::vector<meam::Contradictions> poses(100, Misfits);
  poses.push_back(Nothing);
  EXPECT_LT(meam::sharesOfPart(poses, std::vector<double>(101, 1.0), Even).back(), 0.5);
  EXPECT_GT(meam::sharesOfPart(poses, std::vector<double>(101, 0.0), Even).back(), 0.8) << "of poses that are there";
}

TEST(LookalikeDecision, OneThatIsContradictedAmongManyThatAreNotIsTheOther)
{
  std::vector<meam::Contradictions> poses(20, Nothing);
  poses.push_back({ 2.0, 2.0, 5.0 });
  const std::vector<double> shares = meam::sharesOfPart(poses, std::vector<double>(21, 1.0), Even);
  EXPECT_GT(shares.front(), 0.98);
  EXPECT_LT(shares.back(), 0.3);
}
