// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseEvidence.h"

#include "TestScene.h"
#include "base/Error.h"

#include <gtest/gtest.h>

#include <tuple>

TEST(PoseEvidence, TheScoreIsTheWeightedMeanOfWhatIsThere)
{
  using meam::PointState;
  meam::PoseEvidence evidence;
  evidence.edges.resize(3);
  evidence.edgeStates = { PointState::Matched, PointState::Violated, PointState::Hidden }; // 1 / 2
  evidence.surface.resize(5);
  evidence.surfaceStates = { PointState::Matched, PointState::Matched, PointState::Violated, PointState::Matched,
    PointState::Unknown }; // 3 / 4, of 4 / 5
  evidence.explained = 1;
  evidence.unexplained = 3;
  const auto score = [&](double edges, double surface, double explained)
  {
    meam::EvidenceSettings settings;
    std::tie(settings.edgeWeight, settings.surfaceWeight, settings.explainedWeight) =
      std::tie(edges, surface, explained);
    return evidence.score(settings);
  };
  EXPECT_NEAR(evidence.score(), (0.4 * 0.5 + 0.32 * 0.75 + 0.2 * 0.25) / 0.92, 1e-12);
  EXPECT_NEAR(score(1, 0, 0), 0.5, 1e-12);
  EXPECT_NEAR(score(0, 1, 0), 0.75, 1e-12);
  EXPECT_NEAR(score(0.5, 0.5, 0), (0.5 * 0.5 + 0.4 * 0.75) / 0.9, 1e-12);
  EXPECT_NEAR(score(2, 0, 2), 0.375, 1e-12);
  evidence.surfaceStates[4] = PointState::Hidden;
  EXPECT_NEAR(evidence.score(), 0.4 * 0.5 + 0.4 * 0.75 + 0.2 * 0.25, 1e-12) << "all in sight was measured";
  evidence.surfaceStates = { PointState::Matched, PointState::Unknown, PointState::Unknown, PointState::Unknown,
    PointState::Hidden };
  EXPECT_NEAR(evidence.score(), (0.2 + 0.1 + 0.05) / 0.7, 1e-12) << "a quarter was measured, all of it is there";
  evidence.surfaceStates[0] = PointState::Unknown;
  EXPECT_NEAR(evidence.score(), (0.2 + 0.05) / 0.6, 1e-12) << "nothing was measured";
  EXPECT_EQ(score(0, 1, 0), 0.0) << "and nothing else counts";
  evidence.surface.clear();
  evidence.surfaceStates.clear();
  EXPECT_NEAR(score(0, 1, 0), 0.5, 1e-12) << "edges alone";
}

TEST(PoseEvidence, MatchedAreThoseOfTheSurfaceAndWithoutOneOfTheEdges)
{
  using meam::PointState;
  meam::PoseEvidence evidence;
  evidence.edges = { { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 } };
  evidence.edgeStates = { PointState::Matched, PointState::Hidden, PointState::Matched };
  EXPECT_EQ(evidence.matched(), (meam::Points{ { 1, 0, 0 }, { 3, 0, 0 } }));
  EXPECT_DOUBLE_EQ(evidence.visibleFraction(), 2.0 / 3.0);
  evidence.surface = { { 0, 1, 0 }, { 0, 2, 0 }, { 0, 3, 0 }, { 0, 4, 0 } };
  evidence.surfaceStates = { PointState::Violated, PointState::Matched, PointState::Unknown, PointState::Hidden };
  EXPECT_EQ(evidence.matched(), (meam::Points{ { 0, 2, 0 } }));
  EXPECT_DOUBLE_EQ(evidence.visibleFraction(), 0.75);
}

TEST(PoseEvidence, WeightsThatMakeNoScoreAreAnError)
{
  EXPECT_NO_THROW(meam::requireWeights({}));
  meam::EvidenceSettings settings;
  settings.surfaceWeight = -0.1;
  EXPECT_THROW(meam::requireWeights(settings), meam::Error);
  settings.surfaceWeight = NAN;
  EXPECT_THROW(meam::requireWeights(settings), meam::Error);
  settings.edgeWeight = settings.surfaceWeight = settings.explainedWeight = 0.0;
  EXPECT_THROW(meam::requireWeights(settings), meam::Error);
  settings.explainedWeight = 0.1;
  EXPECT_NO_THROW(meam::requireWeights(settings));
}

TEST(PoseEvidence, WithoutFreeSpaceWhatTheSensorLookedPastSaysNothing)
{
  const meam::Scene scene = scenes::prepared(scenes::withTangents(scenes::seenFromAbove(scenes::threeCopies())));
  Eigen::Isometry3d lifted = scenes::threeCopies()[0]; // in front of all that was measured
  lifted.translation().z() += 40.0;
  meam::EvidenceSettings with, without;
  with.tolerance = without.tolerance = 3.0;
  without.freeSpace = false;
  const auto count = [&](const meam::EvidenceSettings& settings, meam::PointState state)
  {
    const auto states =
      meam::EvidenceCollector(scene, scenes::bracket(), settings).collect(scene.T_local_scene() * lifted).surfaceStates;
    return std::count(states.begin(), states.end(), state);
  };
  EXPECT_GT(count(with, meam::PointState::Violated), 50);
  EXPECT_EQ(count(without, meam::PointState::Violated), 0);
  EXPECT_EQ(count(without, meam::PointState::Unknown),
    count(with, meam::PointState::Unknown) + count(with, meam::PointState::Violated));
}
