// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseVerification.h"

#include "TestScene.h"
#include "pose/refinement/PoseRefinement.h"

#include <gtest/gtest.h>

#include <tuple>

namespace
{
const meam::Scene& scene()
{
  static const meam::Scene seen = scenes::withTangents(scenes::seenFromAbove(scenes::threeCopies()));
  return seen;
}

meam::Pose at(const Eigen::Isometry3d& T)
{
  meam::Pose pose;
  pose.T_scene_model = T;
  pose.viewId = 0;
  return pose;
}

meam::Pose displaced(const Eigen::Isometry3d& T, double millimetres, double degrees)
{
  Eigen::Isometry3d moved = T;
  moved.translate(Eigen::Vector3d(millimetres, 0, 0));
  moved.rotate(Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d::UnitZ()));
  return at(moved);
}

double scoreOf(const meam::Pose& pose, const meam::Scene& in, const meam::PoseVerificationSettings& settings = {})
{
  const meam::Poses verified = meam::verifyPoses({ pose }, scenes::bracket(), in, settings);
  return verified.empty() ? 0.0 : verified[0].score;
}
}

TEST(PoseVerification, TheTruePoseScoresBest)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const double truth = scoreOf(at(T), scene());
  EXPECT_GT(truth, 0.8);
  EXPECT_LE(truth, 1.0);
  EXPECT_LT(scoreOf(displaced(T, 8.0, 0.0), scene()), truth - 0.1);
  EXPECT_LT(scoreOf(displaced(T, 0.0, 25.0), scene()), truth - 0.1);
  EXPECT_LT(scoreOf(displaced(T, 500.0, 0.0), scene()), 0.01); // where there is nothing
}

TEST(PoseVerification, TheFlippedPartIsWorse)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  // The same place and the same height, turned upside down about the long leg.
  Eigen::Isometry3d flipped = T;
  flipped.translate(Eigen::Vector3d(0, 20, 7.5));
  flipped.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  flipped.translate(Eigen::Vector3d(0, -20, -7.5));
  EXPECT_LT(scoreOf(at(flipped), scene()), scoreOf(at(T), scene()) - 0.1);
}

TEST(PoseVerification, WhatIsNotThereGoesAtAGlanceWhereSomeMustGo)
{
  meam::Poses poses;
  for (const Eigen::Isometry3d& T : scenes::threeCopies())
  {
    poses.push_back(at(T));
    poses.push_back(displaced(T, 500.0, 0.0)); // where there is nothing
  }
  meam::PoseVerificationSettings settings;
  settings.maximumPoses = 5;
  EXPECT_EQ(meam::verifyPoses(poses, scenes::bracket(), scene(), settings).size(), 3u);
  settings.maximumPoses = 6;
  EXPECT_EQ(meam::verifyPoses(poses, scenes::bracket(), scene(), settings).size(), 6u) << "all may stay";
}

TEST(PoseVerification, OfPosesNearlyTheSameMoreVotesDoNotMakeUpForSurfaceThatIsNotThere)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[1];
  const double above = 0.035 * scenes::bracket().diameter; // more than fits, and less than tells two poses apart
  meam::Poses poses{ at(Eigen::Translation3d(0, 0, above) * T), at(T) };
  poses[0].votes = 120;
  poses[1].votes = 100;
  const meam::Poses kept = meam::verifyPoses(poses, scenes::bracket(), scene());
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_LT(meam::translationError(kept[0].T_scene_model, T), 1e-6);
}

TEST(PoseVerification, WithoutASurfaceEdgesDecide)
{
  meam::Scene edgesOnly = scene();
  edgesOnly.surface.clear();
  const Eigen::Isometry3d T = scenes::threeCopies()[1];
  EXPECT_GT(scoreOf(at(T), edgesOnly), 0.8);
  EXPECT_LT(scoreOf(displaced(T, 8.0, 0.0), edgesOnly), scoreOf(at(T), edgesOnly) - 0.2);
}

TEST(PoseVerification, APartUnderAPlateIsHiddenNotWrong)
{
  meam::Scene covered = scene();
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const double before = meam::verifyPoses({ at(T) }, scenes::bracket(), covered)[0].visibleFraction;
  // A plate 30 mm above half of the part; it hides the points below it.
  meam::Points visible;
  const auto under = [&](const Eigen::Vector3f& p)
  { return p.x() < 25.0f && p.x() > -60.0f && std::abs(p.y()) < 70.0f; };
  std::copy_if(covered.surface.begin(), covered.surface.end(), std::back_inserter(visible),
    [&](const auto& p) { return !under(p); });
  for (float x = -60.0f; x < 25.0f; x += 0.7f)
  {
    for (float y = -70.0f; y < 70.0f; y += 0.7f)
    {
      visible.emplace_back(x, y, 30.0f);
    }
  }
  covered.surface = visible;
  std::vector<int> edges;
  for (std::size_t i = 0; i < covered.edges.size(); ++i)
  {
    if (!under(covered.edges.points[i]))
    {
      edges.push_back(static_cast<int>(i));
    }
  }
  covered.edges = covered.edges.subset(edges);
  const meam::Pose pose = meam::verifyPoses({ at(T) }, scenes::bracket(), covered)[0];
  EXPECT_LT(pose.visibleFraction, before - 0.2);
  EXPECT_GT(pose.visibleFraction, 0.2);
  // What is left to see still fits.
  EXPECT_GT(pose.score, 0.75);
}

TEST(PoseVerification, OneInstanceIsReturnedOnce)
{
  const auto& truth = scenes::threeCopies();
  meam::Poses candidates;
  for (const auto& T : truth)
  {
    for (const double off : { 2.0, 0.0, 1.0 })
    {
      candidates.push_back(displaced(T, off, off));
    }
  }
  meam::PoseVerificationSettings settings;
  settings.posesPerInstance = 1;
  const meam::Poses best = meam::verifyPoses(candidates, scenes::bracket(), scene(), settings);
  ASSERT_EQ(best.size(), 3u);
  for (std::size_t i = 1; i < best.size(); ++i)
  {
    EXPECT_GE(best[i - 1].probability * std::sqrt(best[i - 1].visibleFraction),
      best[i].probability * std::sqrt(best[i].visibleFraction));
  }
  for (const int threads : { 1, 3 })
  {
    settings.threads = threads;
    const meam::Poses again = meam::verifyPoses(candidates, scenes::bracket(), scene(), settings);
    ASSERT_EQ(again.size(), 3u);
    for (std::size_t i = 0; i < best.size(); ++i)
    {
      EXPECT_EQ(again[i].T_scene_model.matrix(), best[i].T_scene_model.matrix());
    }
  }
  settings.maximumPoses = 2;
  EXPECT_EQ(meam::verifyPoses(candidates, scenes::bracket(), scene(), settings).size(), 2u);
  settings.minimumScore = 1.1;
  EXPECT_TRUE(meam::verifyPoses(candidates, scenes::bracket(), scene(), settings).empty());
}

TEST(PoseVerification, OfVeryManyPosesAnInstanceIsReturnedOnce)
{
  // Turns in steps that are not the same pose yet; the right ones among them. More than are all compared.
  meam::Poses candidates;
  for (const auto& T : scenes::threeCopies())
  {
    for (int k = 0; k < 250; ++k)
    {
      candidates.push_back(displaced(T, 3.5 * (k % 16), 13.0 * (k / 16)));
    }
  }
  meam::PoseVerificationSettings settings;
  settings.posesPerInstance = 1;
  settings.minimumProbability = 0.5;
  const meam::Poses best = meam::verifyPoses(candidates, scenes::bracket(), scene(), settings);
  ASSERT_EQ(best.size(), 3u);
  for (const meam::Pose& pose : best)
  {
    const auto& truth = scenes::threeCopies();
    EXPECT_TRUE(std::any_of(truth.begin(), truth.end(),
      [&](const Eigen::Isometry3d& T) { return meam::translationError(pose.T_scene_model, T) < 0.15; }));
  }
}

TEST(PoseVerification, RightPosesAreLikelyAndWrongOnesAreNot)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const meam::Pose right = meam::verifyPoses({ at(T) }, scenes::bracket(), scene()).at(0);
  const meam::Pose wrong = meam::verifyPoses({ displaced(T, 9.0, 20.0) }, scenes::bracket(), scene()).at(0);
  EXPECT_GT(right.probability, 0.9);
  EXPECT_LT(wrong.probability, 0.1);
  EXPECT_EQ(meam::confidence(right), right.probability);
  meam::PoseVerificationSettings settings;
  settings.minimumProbability = 0.5;
  EXPECT_EQ(
    meam::verifyPoses({ at(T), displaced(scenes::threeCopies()[1], 9.0, 20.0) }, scenes::bracket(), scene(), settings)
      .size(),
    1u);
}

TEST(PoseVerification, PosesThatMatchTheSameSurfaceAreOfOneInstance)
{
  // Farther apart than the cluster distance (10 % of 73.6 mm), but mostly on the same face.
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  meam::PoseVerificationSettings settings;
  const meam::Poses row = { at(T), displaced(T, 8.5, 0.0) };
  EXPECT_EQ(meam::verifyPoses(row, scenes::bracket(), scene(), settings).size(), 2u);
  settings.posesPerInstance = 1;
  const meam::Poses best = meam::verifyPoses(row, scenes::bracket(), scene(), settings);
  ASSERT_EQ(best.size(), 1u);
  const meam::Pose settled = meam::settlePose(at(T), meam::SceneIndex(scenes::bracket(), scene()));
  EXPECT_LT(
    meam::translationError(best[0].T_scene_model, settled.T_scene_model), 1e-9); // not where the other came from
  EXPECT_LT(meam::translationError(best[0].T_scene_model, T), 0.15);
}

TEST(PoseVerification, AsManyComeOutAsAreAskedForHoweverUnlikely)
{
  meam::Poses poses;
  for (const auto& T : scenes::threeCopies())
  {
    poses.push_back(poses.empty() ? at(T) : displaced(T, 9.0, 20.0));
  }
  meam::PoseVerificationSettings settings;
  settings.posesPerInstance = 1;
  settings.maximumPoses = 2;
  EXPECT_EQ(meam::verifyPoses(poses, scenes::bracket(), scene(), settings).size(), 2u);
}

TEST(PoseVerification, PosesThatSettleInOnePlaceAreOne)
{
  // Nearer than the scene tells apart, farther than the cluster distance.
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  meam::PoseVerificationSettings settings;
  settings.posesPerInstance = 1;
  settings.clusterDistance = 0.5;
  const meam::Poses best =
    meam::verifyPoses({ at(T), displaced(T, 0.8, 0.5), displaced(T, -0.8, 0.5) }, scenes::bracket(), scene(), settings);
  ASSERT_EQ(best.size(), 1u);
  EXPECT_LT(meam::translationError(best[0].T_scene_model, T), 0.15);
}

TEST(PoseVerification, TheOneThatIsLeftOfAnInstanceIsFarFromAllOthers)
{
  // Rows of poses, each within the cluster distance of its neighbours only.
  meam::Poses row;
  for (const auto& T : scenes::threeCopies())
  {
    for (int i = -4; i <= 4; ++i)
    {
      row.push_back(displaced(T, 4.0 * i, 40.0 * (i % 2)));
    }
  }
  meam::PoseVerificationSettings settings;
  settings.posesPerInstance = 1;
  settings.clusterDistance = 5.0;
  const meam::Poses best = meam::verifyPoses(row, scenes::bracket(), scene(), settings);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : scenes::bracket().surface.points)
  {
    middle += point.cast<double>() / scenes::bracket().surface.size();
  }
  ASSERT_GE(best.size(), 3u);
  for (std::size_t a = 0; a < best.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      EXPECT_GE((best[a].T_scene_model * middle - best[b].T_scene_model * middle).norm(), 5.0);
    }
  }
}

TEST(PoseVerification, TheScoreIsTheWeightedMeanOfWhatIsThere)
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
    std::tie(settings.edgeWeight, settings.surfaceWeight, settings.explainedWeight) = std::tie(edges, surface, explained);
    return evidence.support(settings);
  };
  EXPECT_NEAR(evidence.support(), (0.4 * 0.5 + 0.32 * 0.75 + 0.2 * 0.25) / 0.92, 1e-12);
  EXPECT_NEAR(score(1, 0, 0), 0.5, 1e-12);
  EXPECT_NEAR(score(0, 1, 0), 0.75, 1e-12);
  EXPECT_NEAR(score(0.5, 0.5, 0), (0.5 * 0.5 + 0.4 * 0.75) / 0.9, 1e-12);
  EXPECT_NEAR(score(2, 0, 2), 0.375, 1e-12);
  evidence.surfaceStates[4] = PointState::Hidden;
  EXPECT_NEAR(evidence.support(), 0.4 * 0.5 + 0.4 * 0.75 + 0.2 * 0.25, 1e-12) << "all in sight was measured";
  evidence.surfaceStates = { PointState::Matched, PointState::Unknown, PointState::Unknown, PointState::Unknown,
    PointState::Hidden };
  EXPECT_NEAR(evidence.support(), (0.2 + 0.1 + 0.05) / 0.7, 1e-12) << "a quarter was measured, all of it is there";
  evidence.surfaceStates[0] = PointState::Unknown;
  EXPECT_NEAR(evidence.support(), (0.2 + 0.05) / 0.6, 1e-12) << "nothing was measured";
  EXPECT_EQ(score(0, 1, 0), 0.0) << "and nothing else counts";
  evidence.surface.clear();
  evidence.surfaceStates.clear();
  EXPECT_NEAR(score(0, 1, 0), 0.5, 1e-12) << "edges alone";
}

TEST(PoseVerification, WithoutFreeSpaceWhatTheSensorLookedPastSaysNothing)
{
  const meam::SceneIndex index(scenes::bracket(), scene());
  Eigen::Isometry3d lifted = scenes::threeCopies()[0]; // in front of all that was measured
  lifted.translation().z() += 40.0;
  meam::EvidenceSettings settings;
  settings.freeSpace = false;
  const auto count = [&](const meam::EvidenceSettings& with, meam::PointState state)
  {
    const auto states = meam::EvidenceCollector(index, 3.0, with).collect(lifted).surfaceStates;
    return std::count(states.begin(), states.end(), state);
  };
  EXPECT_GT(count({}, meam::PointState::Violated), 50);
  EXPECT_EQ(count(settings, meam::PointState::Violated), 0);
  EXPECT_EQ(count(settings, meam::PointState::Unknown),
    count({}, meam::PointState::Unknown) + count({}, meam::PointState::Violated));
  EXPECT_EQ(meam::EvidenceCollector(index, 3.0).glance(lifted), 0.0);
  EXPECT_EQ(meam::EvidenceCollector(index, 3.0, settings).glance(lifted), 0.5);
}

TEST(PoseVerification, AtAGlanceWhatWasNotMeasuredMayBeThereOrNot)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const auto glance = [&](const meam::Scene& in, const Eigen::Isometry3d& at)
  {
    const meam::SceneIndex index(scenes::bracket(), in);
    return meam::EvidenceCollector(index, 3.0).glance(Eigen::Isometry3d(index.scene.frame * at));
  };
  const double whole = glance(scene(), T);
  EXPECT_GT(whole, 0.9);
  EXPECT_EQ(glance(scene(), Eigen::Translation3d(500, 0, 0) * T), 0.5) << "nothing was measured";
  meam::Scene half = scene();
  const float middle = static_cast<float>((T * scenes::bracket().surfaceDistance.middle().cast<double>()).x());
  const auto gone = std::remove_if(half.surface.begin(), half.surface.end(), [&](const auto& p) { return p.x() > middle; });
  half.surface.erase(gone, half.surface.end());
  EXPECT_GT(glance(half, T), 0.6);
  EXPECT_LT(glance(half, T), whole - 0.1);
}

TEST(PoseVerification, CoverageFollowsThePaper)
{
  // The share of the view's edge points that have a scene edge point within the tolerance, exactly.
  const meam::TrainedModel& model = scenes::bracket();
  meam::Scene own;
  own.edges = model.edges;
  meam::PoseVerificationSettings settings = meam::paperVerificationSettings();
  EXPECT_DOUBLE_EQ(scoreOf(at(Eigen::Isometry3d::Identity()), own, settings), 1.0);
  std::vector<int> half;
  int inView = 0;
  for (std::size_t i = 0; i < model.edges.size(); ++i)
  {
    if ((model.edgeViews[i] & 1u) != 0 && inView++ % 2 == 0)
    {
      half.push_back(static_cast<int>(i));
    }
  }
  own.edges = model.edges.subset(half);
  settings.tolerance = 1e-4;
  EXPECT_DOUBLE_EQ(
    scoreOf(at(Eigen::Isometry3d::Identity()), own, settings), static_cast<double>(half.size()) / inView);
}

TEST(PoseVerification, BadInput)
{
  EXPECT_THROW(meam::verifyPoses({ at(Eigen::Isometry3d::Identity()) }, scenes::bracket(), {}), meam::Error);
  EXPECT_TRUE(meam::verifyPoses({}, scenes::bracket(), scene()).empty());
  meam::Pose notFinite = at(scenes::threeCopies()[0]);
  notFinite.T_scene_model.linear()(0, 0) = NAN;
  EXPECT_THROW(meam::verifyPoses({ notFinite }, scenes::bracket(), scene()), meam::Error);
  meam::Scene away = scene();
  away.sensor.perspective = true;
  away.sensor.position = { 0, 0, 1000 };
  EXPECT_NO_THROW(meam::verifyPoses({}, scenes::bracket(), away));
  away.sensor.direction = Eigen::Vector3d::UnitZ();
  EXPECT_THROW(meam::verifyPoses({}, scenes::bracket(), away), meam::Error) << "it sees nothing of the scene";
}

TEST(PoseVerification, APoseThatNamesNoViewTakesTheNearestToTheSensor)
{
  const meam::PoseVerificationSettings paper = meam::paperVerificationSettings();
  meam::Pose pose = at(scenes::threeCopies()[0]);
  pose.viewId = -1;
  const meam::Pose verified = meam::verifyPoses({ pose }, scenes::bracket(), scene(), paper).at(0);
  EXPECT_EQ(verified.viewId, meam::PredictedVisibility(scenes::bracket()).view(pose.T_scene_model, scene().sensor));
  EXPECT_GT(verified.score, 0.5);
}

TEST(PoseVerification, AModelWithoutASurfaceIsJudgedByItsEdges)
{
  meam::TrainedModel model = scenes::bracket();
  model.surface = {};
  model.deriveFields();
  meam::Scene edgesOnly = scene();
  edgesOnly.surface.clear();
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  meam::Poses poses;
  for (int k = 0; k < 8; ++k)
  {
    poses.push_back(displaced(T, 12.0 * k, 0.0));
  }
  meam::PoseVerificationSettings settings;
  settings.maximumPoses = 5; // fewer than there are
  const meam::Poses kept = meam::verifyPoses(poses, model, scene(), settings);
  const meam::Poses alone = meam::verifyPoses(poses, model, edgesOnly, settings);
  ASSERT_EQ(kept.size(), alone.size());
  ASSERT_FALSE(kept.empty());
  EXPECT_LT(meam::translationError(kept[0].T_scene_model, T), 1e-6);
  EXPECT_GT(kept[0].probability, 0.9);
}
