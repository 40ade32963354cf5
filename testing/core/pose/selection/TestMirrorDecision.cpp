// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/MirrorDecision.h"

#include "TestScene.h"
#include "pose/verification/PoseVerification.h"

#include <gtest/gtest.h>

namespace
{
meam::TriangleMesh rightHand() { return parts::blockOnPlate(false); }

/// The pose T of the right hand's part, claimed with `place`, where `lies` is at the same pose.
meam::Pose decided(
  const meam::TriangleMesh& lies, double place = 0.9, const Eigen::Isometry3d& T = Eigen::Isometry3d::Identity())
{
  const meam::TrainedModel& model = scenes::trained<rightHand>();
  const meam::Scene scene = scenes::alone(lies, model, T);
  const meam::EvidenceCollector collector(scene, model);
  meam::Pose pose = scenes::displaced(scene.T_local_scene() * T);
  const double logOdds = std::log(place / (1.0 - place));
  meam::setEvidence(pose, logOdds);
  meam::FinishedInstances found{ { pose, {}, logOdds } };
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
  const Eigen::Isometry3d blockBelow(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  const meam::Pose pose = decided(rightHand(), 0.9, blockBelow);
  EXPECT_NEAR(pose.contradictions.mirrored, 0.05, 0.04);
  EXPECT_GT(pose.placeProbability, 0.8);
}
