// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/SizeDecision.h"

#include "TestScene.h"
#include "pose/verification/PoseVerification.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
/// The worst of so many poses, each claimed with 0.9, where brackets lie that are longer along x by `factor`.
meam::Pose decided(float factor, int copies = 4)
{
  const meam::TrainedModel& model = scenes::bracket();
  const std::vector<scenes::Copy> lying = scenes::stretchedBrackets(copies, { factor, 1.0f, 1.0f });
  const meam::Scene scene = scenes::sceneOf(lying);
  meam::FinishedInstances found;
  for (const scenes::Copy& copy : lying)
  {
    const double logOdds = std::log(0.9 / 0.1);
    found.push_back({ scenes::displaced(scene.T_local_scene() * copy.T_scene_model), {}, logOdds });
    meam::setEvidence(found.back().pose, logOdds);
  }
  meam::allowForOtherSize(found, scene, model, 1);
  return found.back().pose;
}
}

TEST(SizeDecision, ThePartItselfStaysAsLikely)
{
  const meam::Pose pose = decided(1.0f);
  EXPECT_NEAR(pose.placeProbability, 0.9, 1e-9);
  EXPECT_EQ(pose.contradictions.resized, 0.0);
  EXPECT_NEAR(pose.contradictions.lengths.x(), 1.0, 0.01);
}

TEST(SizeDecision, WhatIsATenthLongerIsAnotherPart)
{
  const meam::Pose pose = decided(1.1f);
  EXPECT_LT(pose.placeProbability, 0.5);
  EXPECT_GT(pose.contradictions.resized, 0.5);
  EXPECT_NEAR(pose.contradictions.lengths.x(), 1.1, 0.02);
}

TEST(SizeDecision, ThreePosesTellNoSize)
{
  const meam::Pose pose = decided(1.1f, 3);
  EXPECT_NEAR(pose.placeProbability, 0.9, 1e-9);
  EXPECT_TRUE(pose.contradictions.lengths.array().isNaN().all());
}
