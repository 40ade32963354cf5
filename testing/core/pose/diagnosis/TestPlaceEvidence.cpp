// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/PlaceEvidence.h"

#include "TestScene.h"

using meam::PointState;

namespace
{
meam::PlaceEvidence evidenceAt(const scenes::Seen& seen, const Eigen::Isometry3d& T_scene_model)
{
  const meam::Scene scene = scenes::prepared(scenes::withTangents(seen));
  return meam::evidenceAt(scene.T_local_scene() * T_scene_model, scene, scenes::bracket(), {});
}
}

TEST(PlaceEvidence, OfAPartThatIsThereAllIs)
{
  const Eigen::Isometry3d T = scenes::lying(0, 0, 20);
  const meam::PlaceEvidence evidence = evidenceAt(scenes::seenFromAbove({ T }), T);
  EXPECT_GT(evidence.edges, 50);
  EXPECT_GT(evidence.edges, 0.95 * evidence.points.edges.size());
  EXPECT_GT(evidence.edgeShare(), 0.85);
  EXPECT_GT(evidence.surfaceShare(PointState::Matched), 0.97);
  EXPECT_LE(evidence.edgesMatched, evidence.edgesNear);
  EXPECT_LE(evidence.edgesAligned, evidence.edgesNear);
  EXPECT_GT(evidence.edgesAligned, 0.8 * evidence.edges);
  EXPECT_EQ(evidence.surface(PointState::Hidden), 0);
}

TEST(PlaceEvidence, EdgesOfAnotherDirectionAreNearAndNoMore)
{
  const Eigen::Isometry3d T = scenes::lying(0, 0, 20);
  scenes::Seen seen = scenes::withTangents(scenes::seenFromAbove({ T }));
  for (Eigen::Vector3f& tangent : seen.edges.tangents)
  {
    tangent = Eigen::Vector3f::UnitZ(); // all edges in sight lie flat but the few along z
  }
  const meam::Scene scene = scenes::prepared(seen);
  const meam::PlaceEvidence evidence = meam::evidenceAt(scene.T_local_scene() * T, scene, scenes::bracket(), {});
  EXPECT_GT(evidence.edgesNear, 0.97 * evidence.edges);
  EXPECT_LT(evidence.edgesMatched, 0.1 * evidence.edges);
  EXPECT_LT(evidence.edgesAligned, 0.1 * evidence.edges);
}

TEST(PlaceEvidence, OfANoisyScanEdgesAreLookedForAsFarAsVerificationDoes)
{
  const Eigen::Isometry3d T = scenes::lying(0, 0, 20);
  const double diameter = scenes::bracket().diameter;
  meam::Scene scene = scenes::prepared(scenes::withTangents(scenes::seenFromAbove({ T })));
  const Eigen::Isometry3d above = Eigen::Translation3d(0.0, 0.0, 0.04 * diameter) * T; // farther than edges are apart
  const auto evidence = [&] { return meam::evidenceAt(scene.T_local_scene() * above, scene, scenes::bracket(), {}); };
  const meam::PlaceEvidence withoutNoise = evidence();
  EXPECT_LT(withoutNoise.edgesAligned, 0.3 * withoutNoise.edges); // those that run upwards
  scene.quality.noise = 0.04 * diameter;
  const meam::PlaceEvidence withNoise = evidence();
  EXPECT_GT(withNoise.edgesNear, 0.9 * withNoise.edges);
  EXPECT_GT(withNoise.edgesAligned, 0.7 * withNoise.edges);
}

TEST(PlaceEvidence, WhatIsHiddenDoesNotCount)
{
  // A plate above half of the part.
  const Eigen::Isometry3d T = scenes::lying(0, 0, 0);
  const scenes::Seen seen = scenes::seenFromAbove(std::vector<scenes::Copy>{
    { parts::lBracket(), T }, { parts::box({ -50, 15, 40 }, { 100, 100, 45 }), Eigen::Isometry3d::Identity() } });
  const meam::PlaceEvidence evidence = evidenceAt(seen, T);
  EXPECT_GT(evidence.surface(PointState::Hidden), 10);
  EXPECT_LT(evidence.edges, static_cast<int>(evidence.points.edges.size()));
  const double hidden = evidence.surface(PointState::Hidden);
  EXPECT_NEAR(hidden / evidence.points.surface.size(), 1.0 - evidence.points.visibleFraction(), 1e-9);
  EXPECT_GT(evidence.surfaceShare(PointState::Matched), 0.8); // what is beside the plate's border may be either
}

TEST(PlaceEvidence, WithoutPointsSharesAreZero)
{
  const meam::PlaceEvidence nothing;
  EXPECT_EQ(nothing.edgeShare(), 0.0);
  EXPECT_EQ(nothing.surfaceShare(PointState::Matched), 0.0);
}
