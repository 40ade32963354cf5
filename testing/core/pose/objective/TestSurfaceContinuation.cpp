// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/SurfaceContinuation.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
meam::TriangleMesh blockOf(float length) { return parts::box({ -30, -20, 0 }, { length - 30, 20, 15 }); }

meam::TriangleMesh lowBlock() { return blockOf(60); }
meam::TriangleMesh sheet() { return parts::box({ -30, -20, 0 }, { 30, 20, 1 }); }

/// Patches beside the part where it is looked for as it lies, in the scene of other bodies.
double besidePart(
  const meam::TrainedModel& model, const std::vector<scenes::Copy>& copies, const meam::Points& edges = {})
{
  scenes::Seen seen = scenes::seenFromAbove(copies);
  seen.edges.points.insert(seen.edges.points.end(), edges.begin(), edges.end());
  const meam::Scene scene = scenes::prepared(scenes::withTangents(seen, model.diameter), model.diameter);
  const meam::SurfaceContinuation continuation(scene, model);
  const auto beyond = continuation.beyond(scene.T_local_scene());
  const double patches = continuation.unexplained(beyond, {});
  const Eigen::Isometry3f T_model_scene = scene.T_local_scene().inverse().cast<float>();
  EXPECT_EQ(continuation.unexplained(beyond, { T_model_scene }), patches) << "none lies on the block";
  return patches;
}

double besideTheBlock(const std::vector<scenes::Copy>& copies)
{
  return besidePart(scenes::trained<lowBlock>(), copies);
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

TEST(SurfaceContinuation, WhatASheetLiesOnIsBehindItsEdge)
{
  const meam::TriangleMesh below = parts::box({ -30, -20, -1 }, { 70, 20, 0.5f }); // half a millimetre lower
  const std::vector<scenes::Copy> copies{ { sheet(), Eigen::Isometry3d::Identity() },
    { below, Eigen::Isometry3d::Identity() } };
  meam::Points edge; // as the image shows it
  for (float y = -20.0f; y <= 20.0f; y += 0.5f)
  {
    edge.emplace_back(30.0f, y, 1.0f);
  }
  EXPECT_GT(besidePart(scenes::trained<sheet>(), copies), 0.5);
  EXPECT_LT(besidePart(scenes::trained<sheet>(), copies, edge), 0.1);
}

TEST(SurfaceContinuation, AHigherBodyBesideItDoesNotGoOn)
{
  Eigen::Isometry3d beside = Eigen::Isometry3d::Identity();
  beside.translation() = Eigen::Vector3d(60.0, 0.0, 8.0);
  EXPECT_LT(besideTheBlock({ { lowBlock(), Eigen::Isometry3d::Identity() }, { lowBlock(), beside } }), 0.1);
}
