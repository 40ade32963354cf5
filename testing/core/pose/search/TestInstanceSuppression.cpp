// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/InstanceSuppression.h"

#include "TestScene.h"

namespace
{
using Indices = std::vector<int>;
}

TEST(InstanceSuppression, OfEqualEvidenceTheOneThatTheSceneSpeaksForStays)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::PoseComparison comparison(scene, scenes::bracket());
  const Eigen::Isometry3d truth = scene.T_local_scene() * scenes::threeCopies()[0];
  meam::Poses poses{ scenes::displaced(truth, 1.0, 4.0), scenes::displaced(truth), scenes::displaced(truth, 0.5, 2.0) };
  const auto staying = [&](double evidenceOfFirst)
  {
    poses[0].evidence = evidenceOfFirst;
    poses[1].evidence = poses[2].evidence = 1.0;
    const meam::InstanceClaims claims(scene, scenes::bracket(), 0.1 * scenes::bracket().diameter);
    return meam::bestOfInstances(poses, claims, comparison, true, 2);
  };
  EXPECT_EQ(staying(1.5), (Indices{ 1 })) << "evidence hardly differs: the scene tells, point by point";
  EXPECT_EQ(staying(4.0), (Indices{ 0 })) << "clearly more evidence";
}

TEST(InstanceSuppression, PosesThatExplainTheSameAreOfOneInstance)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::PoseComparison comparison(scene, scenes::bracket());
  const Eigen::Isometry3d one = scene.T_local_scene() * scenes::threeCopies()[0];
  const Eigen::Isometry3d other = scene.T_local_scene() * scenes::threeCopies()[1];
  const meam::Poses poses{ scenes::displaced(one), scenes::displaced(other), scenes::displaced(one, 0.2) };
  const auto staying = [&](double distance)
  {
    const meam::InstanceClaims claims(scene, scenes::bracket(), distance);
    return meam::bestOfInstances(poses, claims, comparison, true, 2).size();
  };
  EXPECT_EQ(staying(0.01), 2u) << "a little apart, on the same surface";
  EXPECT_EQ(staying(0.1 * scenes::bracket().diameter), 2u);
}
