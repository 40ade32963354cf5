// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/MirrorDecision.h"

#include "TestScene.h"
#include "pose/verification/PoseVerification.h"

#include <gtest/gtest.h>

namespace
{
meam::TriangleMesh rightHand() { return parts::blockOnPlate(false); }
meam::TriangleMesh plate() { return parts::box({ 0.0f, 0.0f, 0.0f }, { 60.0f, 40.0f, 6.0f }); }

/// The place of a pose of the right hand's part, claimed with 0.9, where `lies` is at the same pose.
meam::Pose decided(const meam::TriangleMesh& lies, double place = 0.9)
{
  const meam::TrainedModel& model = scenes::trained<rightHand>();
  const meam::Scene scene = scenes::alone(lies, model, Eigen::Isometry3d::Identity());
  const meam::EvidenceCollector collector(scene, model);
  meam::Pose pose = scenes::displaced(scene.T_local_scene());
  const double logOdds = std::log(place / (1.0 - place));
  meam::setEvidence(pose, logOdds);
  meam::FinishedInstances found{ { pose, {}, logOdds, logOdds } };
  meam::allowForMirrorImage(found, scene, model, collector, {}, {}, 1);
  return found[0].pose;
}
}

TEST(MirrorDecision, ThePartItselfStaysAsLikely)
{
  const meam::Pose pose = decided(rightHand());
  EXPECT_GT(pose.placeProbability, 0.85);
  EXPECT_LT(pose.contradictions.mirrored, 0.05);
}

TEST(MirrorDecision, WhereTheOtherHandsPartLiesItIsUnlikely)
{
  const meam::Pose pose = decided(parts::blockOnPlate(true));
  EXPECT_LT(pose.placeProbability, 0.5);
  EXPECT_GT(pose.contradictions.mirrored, 0.5);
}

TEST(MirrorDecision, WhatIsNotLikelyIsNotAsked)
{
  const meam::Pose pose = decided(parts::blockOnPlate(true), 0.4);
  EXPECT_NEAR(pose.placeProbability, 0.4, 1e-9);
  EXPECT_EQ(pose.contradictions.mirrored, 0.0);
}

TEST(MirrorDecision, WhereNothingTellsThemApartThePriorStays)
{
  // A plate alone: the block's corner is missing on both alike.
  const meam::Pose pose = decided(plate());
  EXPECT_NEAR(pose.contradictions.mirrored, 0.05, 0.05);
}
