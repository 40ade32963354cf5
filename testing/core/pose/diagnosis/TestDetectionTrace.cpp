// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/DetectionTrace.h"

#include "TestScene.h"

TEST(DetectionTrace, HoldsEveryStageAndWhatLimitsKeptBack)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::DetectionSettings settings = meam::detectionSettings(meam::Preset::Recommended, 2);
  meam::DetectionTrace trace(scene, scenes::bracket(), settings);
  ASSERT_EQ(trace.stages().size(), 7u);
  EXPECT_EQ(trace.ranked().size(), 2u);
  ASSERT_GE(trace.unlimited().size(), 3u);
  for (std::size_t k = 0; k < 2; ++k)
  {
    EXPECT_TRUE(trace.unlimited()[k].T_scene_model.matrix() == trace.ranked()[k].T_scene_model.matrix());
  }
  EXPECT_GE(trace.allAlternatives().size(), trace.stages()[3].poses.size());
}

TEST(DetectionTrace, WithoutScreeningThereIsNoSuchStage)
{
  const meam::Scene& scene = scenes::copiesScene();
  meam::DetectionSettings settings = meam::detectionSettings(meam::Preset::Recommended, 2);
  settings.screening.reset();
  const meam::DetectionTrace trace(scene, scenes::bracket(), settings);
  ASSERT_EQ(trace.stages().size(), 6u);
  EXPECT_EQ(trace.stages()[1].stage, meam::PoseStage::CandidateVerification);
}

TEST(DetectionTrace, PosesAtAPlaceAreThoseNearAndLittleTurned)
{
  const meam::TrainedModel& model = scenes::bracket();
  const Eigen::Isometry3d T = scenes::lying(10, 20, 30);
  // Turned about the middle, which stays.
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  const auto turned = [&](double degrees)
  {
    meam::Pose pose;
    pose.T_scene_model = T * meam::turnAbout(Eigen::Vector3d::UnitZ(), degrees * M_PI / 180.0, middle);
    return pose;
  };
  const meam::Poses poses = { scenes::displaced(T, 6.0), turned(20.0), scenes::displaced(T, 4.0), turned(-14.0) };
  EXPECT_EQ(meam::posesAt(poses, T, { 5.0, 15.0 }, model), (std::vector<int>{ 2, 3 }));
  const meam::PoseOffset offset = meam::offsetBetween(poses[3].T_scene_model, T, model);
  EXPECT_NEAR(offset.distance, 0.0, 1e-9);
  EXPECT_NEAR(offset.angle, 14.0, 1e-9);
}

TEST(DetectionTrace, OffsetsAreUpToSymmetries)
{
  const auto plate = &scenes::trained<parts::cutPlate>;
  const meam::TrainedModel& model = plate();
  ASSERT_FALSE(model.symmetries.near.empty());
  const Eigen::Isometry3d T = scenes::lying(10, 20, 30);
  const Eigen::Isometry3d equal = T * model.symmetries.near.front().T;
  EXPECT_GT(meam::offsetBetween(equal, T, model).angle, 60.0);
  EXPECT_LT(meam::offsetUpToNear(equal, T, model).angle, 1.0);
}
