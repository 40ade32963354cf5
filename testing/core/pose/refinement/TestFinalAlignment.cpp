// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/FinalAlignment.h"

#include "TestScene.h"

#include <algorithm>

TEST(FinalAlignment, APoseComesToOnePlaceWhereverItComesFrom)
{
  const meam::Poses right = scenes::disturbedCopies(0.0, 0.0);
  const meam::Poses near = scenes::disturbedCopies(0.05, 0.1);
  ASSERT_EQ(near.size(), 3u);
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    const meam::Pose aligned = scenes::align(near[i], scenes::copiesScene(), scenes::bracket());
    EXPECT_EQ(aligned.score, near[i].score);
    EXPECT_EQ(aligned.fit.constrained, 6);
    const Eigen::Isometry3d other = scenes::align(right[i], scenes::copiesScene(), scenes::bracket()).T_scene_model;
    EXPECT_TRUE(scenes::areNear(aligned.T_scene_model, other, 1e-3, 1e-3));
    const Eigen::Isometry3d& truth = scenes::threeCopies()[i];
    EXPECT_TRUE(scenes::areNear(aligned.T_scene_model, truth, 0.15, 0.25)) << i;
    EXPECT_NEAR(aligned.T_scene_model.linear().determinant(), 1.0, 1e-9);
  }
}

TEST(FinalAlignment, APoseComesToTheSamePlaceOfASceneThatIsMoved)
{
  const meam::TrainedModel& model = scenes::bracket();
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  const meam::Poses near = scenes::disturbedCopies(0.05, 0.1);
  std::mt19937 random(8);
  for (int k = 0; k < 5; ++k)
  {
    const Eigen::Isometry3d T = parts::motion(random, 200.0);
    scenes::Seen moved = scenes::seenCopies();
    moved.edges = parts::moved(scenes::seenCopies().edges, T);
    moved.surface = meam::moved(scenes::seenCopies().surface, T);
    moved.sensor.position = T * moved.sensor.position;
    moved.sensor.direction = T.linear() * moved.sensor.direction;
    const meam::Scene elsewhere = scenes::prepared(moved);
    for (const meam::Pose& pose : near)
    {
      const Eigen::Isometry3d expected = T * scenes::align(pose, scenes::copiesScene(), model).T_scene_model;
      const Eigen::Isometry3d found = scenes::align(meam::moved(pose, T), elsewhere, model).T_scene_model;
      EXPECT_LT(meam::translationError(found, expected, middle), 1e-3);
      EXPECT_LT(meam::rotationError(found, expected), 1e-3);
    }
  }
}

TEST(FinalAlignment, WhereTheSceneLeavesAFreedomAPoseStays)
{
  const meam::Scene face = scenes::upperFaces({ 0 });
  const meam::Pose pose = scenes::disturbedCopies(0.3, 0.5)[0];
  const meam::Pose stays = scenes::align(pose, face, scenes::bracket());
  EXPECT_TRUE(stays.T_scene_model.isApprox(pose.T_scene_model, 1e-12));
  EXPECT_EQ(stays.fit.constrained, 3) << "how well the scene fixes the pose is said all the same";
}

TEST(FinalAlignment, WhereTheSceneFixesAPoseWeaklyItIsAligned)
{
  std::vector<int> few;
  for (int k = 0; k < static_cast<int>(scenes::seenCopies().edges.size()); k += 8)
  {
    few.push_back(k);
  }
  const meam::Scene face = scenes::upperFaces(few);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const meam::Pose one = scenes::align(scenes::disturbedCopies(0.1, 0.2)[i], face, scenes::bracket());
    const meam::Pose other = scenes::align(scenes::disturbedCopies(0.05, 0.1)[i], face, scenes::bracket());
    EXPECT_EQ(one.fit.constrained, 5) << "less than a hundredth of what corresponds speaks for the sixth";
    EXPECT_TRUE(scenes::areNear(one.T_scene_model, other.T_scene_model, 1e-3, 1e-3));
  }
}

TEST(FinalAlignment, WhatAPoseDiffersByFromTheAlignedOneAddsToItsCovariance)
{
  const meam::TrainedModel& model = scenes::bracket();
  meam::Pose pose;
  pose.T_scene_model = scenes::copiesScene().T_local_scene() * scenes::threeCopies()[0];
  const Eigen::Vector3d middle = pose.T_scene_model * model.visibility->middle().cast<double>();
  // A hundredth of a radian about z through the part's middle, then 2 mm along x and 1 mm back along y.
  Eigen::Isometry3d motion = meam::turnAbout(Eigen::Vector3d::UnitZ(), 0.01, middle);
  motion.pretranslate(Eigen::Vector3d(2.0, -1.0, 0.0));
  const auto fit = [&](const Eigen::Isometry3d& T_aligned)
  { return meam::fitInPlace(pose, T_aligned, scenes::copiesScene(), model); };
  const meam::PoseFit as = fit(pose.T_scene_model), away = fit(motion * pose.T_scene_model);
  Eigen::Matrix<double, 6, 1> difference;
  difference << 0.0, 0.0, 0.01, 2.0, -1.0, 0.0;
  EXPECT_TRUE((away.covariance - as.covariance).isApprox(difference * difference.transpose(), 1e-9));
  EXPECT_EQ(away.residual, as.residual);
  EXPECT_EQ(away.constrained, as.constrained);
}

TEST(FinalAlignment, APoseThatIsLedFartherAwayStays)
{
  const meam::Scene& in = scenes::copiesScene();
  const meam::TrainedModel& model = scenes::bracket();
  for (const meam::Pose& pose : meam::toLocalFrame(scenes::disturbedCopies(0.0, 3.5), in.T_local_scene(), {}))
  {
    EXPECT_TRUE(meam::alignRobustly(pose, in, model).T_scene_model.matrix() == pose.T_scene_model.matrix());
  }
}
