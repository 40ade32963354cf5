// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/InstanceChoice.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
using Indices = std::vector<int>;
}

TEST(InstanceChoice, OfEqualEvidenceTheOneThatTheSceneSpeaksForStays)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::EvidenceCollector collector(scene, scenes::bracket());
  const meam::PoseComparison comparison(scene, scenes::bracket());
  const Eigen::Isometry3d truth = scene.T_local_scene() * scenes::threeCopies()[0];
  meam::Poses poses{ scenes::displaced(truth, 1.0, 4.0), scenes::displaced(truth), scenes::displaced(truth, 0.5, 2.0) };
  const auto staying = [&](double evidenceOfFirst)
  {
    poses[0].evidence = evidenceOfFirst;
    poses[1].evidence = poses[2].evidence = 1.0;
    const double distance = 0.1 * scenes::bracket().diameter;
    return meam::InstanceChoice(poses, distance, scenes::bracket(), collector, comparison, true, 2).select();
  };
  EXPECT_EQ(staying(1.5), (Indices{ 1 })) << "evidence hardly differs: the scene tells, point by point";
  EXPECT_EQ(staying(4.0), (Indices{ 0 })) << "clearly more evidence";
}

TEST(InstanceChoice, PosesThatMatchTheSameAreOfOneInstance)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::EvidenceCollector collector(scene, scenes::bracket());
  const meam::PoseComparison comparison(scene, scenes::bracket());
  const Eigen::Isometry3d one = scene.T_local_scene() * scenes::threeCopies()[0];
  const Eigen::Isometry3d other = scene.T_local_scene() * scenes::threeCopies()[1];
  const meam::Poses poses{ scenes::displaced(one), scenes::displaced(other), scenes::displaced(one, 0.2) };
  const auto staying = [&](double distance)
  { return meam::InstanceChoice(poses, distance, scenes::bracket(), collector, comparison, true, 2).select().size(); };
  EXPECT_EQ(staying(0.01), 2u) << "a little apart, on the same surface";
  EXPECT_EQ(staying(0.1 * scenes::bracket().diameter), 2u);
}
