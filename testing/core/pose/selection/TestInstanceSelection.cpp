// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/InstanceSelection.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
/// Three copies, and a place where there is none, in the local frame.
meam::Poses verified()
{
  meam::Poses poses;
  for (const Eigen::Isometry3d& T : scenes::threeCopies())
  {
    poses.push_back(scenes::displaced(T, 1.0, 1.0));
  }
  poses.push_back(scenes::displaced(Eigen::Isometry3d(Eigen::Translation3d(500, 0, 0))));
  const meam::Scene& scene = scenes::copiesScene();
  return meam::toLocalFrame(
    scenes::verify(poses, scene, scenes::bracket()), scene.T_local_scene(), scenes::bracket().symmetries);
}
}

TEST(InstanceSelection, ThoseThatAreLikelyByThemselvesTell)
{
  const meam::Poses scored = verified();
  const meam::PoseSelectionSettings settings;
  meam::InstanceSelection selection(scored, scenes::copiesScene(), scenes::bracket(), settings);
  const meam::Poses telling = selection.telling();
  ASSERT_EQ(telling.size(), 3u);
  for (const meam::Pose& pose : telling)
  {
    EXPECT_GT(pose.placeProbability, 0.9);
  }
  const meam::Poses all = selection.poses();
  EXPECT_EQ(all.size(), scored.size());
  EXPECT_TRUE(scenes::areSame(all, meam::selectPoses(scored, scenes::copiesScene(), scenes::bracket(), settings)));
}

TEST(InstanceSelection, WhatIsOnOtherTypesCopiesStays)
{
  const meam::Poses scored = verified();
  meam::InstanceSelection selection(scored, scenes::copiesScene(), scenes::bracket(), {});
  ASSERT_EQ(selection.telling().size(), 3u);
  EXPECT_EQ(selection.poses({ true, false, true }).size(), scored.size());
}
