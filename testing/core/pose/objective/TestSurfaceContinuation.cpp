// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/SurfaceContinuation.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
meam::TriangleMesh blockOf(float length) { return parts::box({ -30, -20, 0 }, { length - 30, 20, 15 }); }

meam::TriangleMesh lowBlock() { return blockOf(60); }

/// Patches beside the block where it is looked for as it lies, in the scene of other bodies.
double besideTheBlock(const std::vector<scenes::Copy>& copies)
{
  const meam::TrainedModel& model = scenes::trained<lowBlock>();
  const meam::Scene scene =
    scenes::prepared(scenes::withTangents(scenes::seenFromAbove(copies), model.diameter), model.diameter);
  const meam::SurfaceContinuation continuation(scene, model);
  const auto beyond = continuation.beyond(scene.T_local_scene());
  const double patches = continuation.unexplained(beyond, {});
  const Eigen::Isometry3f T_model_scene = scene.T_local_scene().inverse().cast<float>();
  EXPECT_EQ(continuation.unexplained(beyond, { T_model_scene }), patches) << "none lies on the block";
  return patches;
}
}

TEST(SurfaceContinuation, NothingGoesOnBesideTheBlockItself)
{
  EXPECT_EQ(besideTheBlock({ { lowBlock(), Eigen::Isometry3d::Identity() } }), 0.0);
}

TEST(SurfaceContinuation, ALongerBlockGoesOn)
{
  // A strip of 40 mm, of which 12 % of the diameter, 8.8 mm, count but for two cells: in patches of 7.4 x 7.4 mm.
  const double patches = besideTheBlock({ { blockOf(80), Eigen::Isometry3d::Identity() } });
  EXPECT_GT(patches, 2.0);
  EXPECT_LT(patches, 40.0 * 8.8 / (7.37 * 7.37));
}

TEST(SurfaceContinuation, AHigherBodyBesideItDoesNotGoOn)
{
  Eigen::Isometry3d beside = Eigen::Isometry3d::Identity();
  beside.translation() = Eigen::Vector3d(60.0, 0.0, 8.0);
  EXPECT_LT(besideTheBlock({ { lowBlock(), Eigen::Isometry3d::Identity() }, { lowBlock(), beside } }), 0.1);
}
