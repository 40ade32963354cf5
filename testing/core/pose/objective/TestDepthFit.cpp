// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/DepthFit.h"

#include "TestScene.h"

#include <gtest/gtest.h>

#include <optional>

namespace
{
/// A plate with one half of its upper face 1 mm higher, 1.4 % of the diameter.
meam::TriangleMesh plateWithStep()
{
  meam::TriangleMesh mesh = parts::box({ 0, 0, 0 }, { 60, 40, 10 });
  const meam::TriangleMesh step = parts::box({ 0, 0, 0 }, { 30, 40, 11 });
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), step.vertices.begin(), step.vertices.end());
  for (const auto& triangle : step.triangles)
  {
    mesh.triangles.push_back({ triangle[0] + first, triangle[1] + first, triangle[2] + first });
  }
  return mesh;
}

/// For the pose of the plate against the one turned by half a turn, with a scan of this noise, mm; none where it is not
/// known. `others` lie there, too.
std::optional<double> forTheRightPose(double noise, const std::vector<scenes::Copy>& others = {})
{
  const meam::TrainedModel& model = scenes::trained<plateWithStep>();
  const Eigen::Isometry3d T = scenes::lying(100.0, 50.0, 30.0);
  std::vector<scenes::Copy> copies{ { plateWithStep(), T } };
  copies.insert(copies.end(), others.begin(), others.end());
  const scenes::Seen seen = scenes::withTangents(scenes::seenFromAbove(copies), model.diameter);
  meam::LocalCloud edges = meam::toLocalCloud(seen.edges);
  const meam::Points measured = meam::toLocalPoints(seen.surface, edges.T_local_scene);
  meam::ScanQuality quality;
  quality.pointDistance = noise >= 0.0 ? 0.7 : 0.0;
  quality.noise = noise;
  const meam::Scene scene(std::move(edges), measured, seen.sensor, model.diameter, {}, quality);
  if (!meam::DepthFit::tells(scene, model))
  {
    return std::nullopt;
  }
  const meam::DepthFit fit(scene, model);
  const Eigen::Isometry3d T_local = scene.T_local_scene() * T;
  const meam::DepthFit::Rendered right = fit.render(T_local);
  const meam::DepthFit::Rendered turned =
    fit.render(T_local * meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI, { 30.0, 20.0, 0.0 }));
  EXPECT_EQ(fit.logOdds(right, right), 0.0);
  EXPECT_DOUBLE_EQ(fit.logOdds(turned, right), -fit.logOdds(right, turned));
  return fit.logOdds(right, turned);
}
}

TEST(DepthFit, AStepThatIsLowerThanWhatExplainsAPointTellsTheRotation)
{
  EXPECT_EQ(forTheRightPose(0.05), 6.0) << "2400 square mm are 1 mm off, and no more counts";
}

TEST(DepthFit, WhatNoiseHidesSaysLittle)
{
  // 70 squares of 5.8 mm, each 0.05 deviations off: 0.00125 nats. Cells at the rim, which one of them covers: some 3
  // nats, for as many as 1 of each 30 is independent.
  const std::optional<double> logOdds = forTheRightPose(20.0);
  ASSERT_TRUE(logOdds);
  EXPECT_NEAR(*logOdds, 70 * 0.00125, 0.5);
}

TEST(DepthFit, NothingIsSaidWhereTheNoiseIsNotKnown) { EXPECT_FALSE(forTheRightPose(-1.0)); }

TEST(DepthFit, WhatIsHiddenSaysNothing)
{
  const meam::TriangleMesh cover = parts::box({ -40, -40, 30 }, { 100, 80, 40 });
  const std::optional<double> logOdds = forTheRightPose(0.05, { { cover, scenes::lying(100.0, 50.0, 30.0) } });
  ASSERT_TRUE(logOdds);
  EXPECT_EQ(*logOdds, 0.0);
}
