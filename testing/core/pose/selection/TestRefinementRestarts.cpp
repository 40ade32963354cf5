// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/RefinementRestarts.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
/// How many degrees a pose is off that was turned from the truth and is refined from its restarts.
double leftOf(const Eigen::AngleAxisd& turn, double probability = 0.5)
{
  const meam::TrainedModel& model = scenes::bracket();
  const meam::Scene& scene = scenes::copiesScene();
  const Eigen::Isometry3d truth = scene.T_local_scene() * scenes::threeCopies()[0];
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  meam::Pose pose;
  pose.T_scene_model = truth * meam::turnAbout(turn.axis(), turn.angle(), middle);
  pose.probability = probability;
  const meam::PoseComparison comparison(scene, model);
  meam::PoseComparison::Contender asItIs = comparison.contender(pose.T_scene_model);
  const meam::Pose best = meam::RefinementRestarts(scene, model, comparison, {}).best(pose, asItIs);
  EXPECT_TRUE(asItIs.T_scene_model.isApprox(best.T_scene_model, 1e-12)) << "the contender follows the pose";
  return meam::rotationError(best.T_scene_model, truth);
}

const Eigen::Vector3d Up = Eigen::Vector3d::UnitZ();
}

TEST(RefinementRestarts, ATurnTooLargeForRefinementIsUndone)
{
  for (const double degrees : { -14.0, 14.0 })
  {
    EXPECT_LT(leftOf(Eigen::AngleAxisd(degrees * M_PI / 180.0, Up)), 1.0) << degrees;
  }
}

TEST(RefinementRestarts, ThePoseStaysWhereTheSceneSpeaksForNoOther)
{
  EXPECT_LT(leftOf(Eigen::AngleAxisd(0.0, Up)), 0.3);
}

TEST(RefinementRestarts, AnUnlikelyPoseIsNotWorthIt)
{
  EXPECT_NEAR(leftOf(Eigen::AngleAxisd(0.2, Up), 1e-4), 0.2 * 180.0 / M_PI, 1e-9);
}
