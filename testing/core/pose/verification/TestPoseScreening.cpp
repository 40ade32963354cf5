// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseScreening.h"

#include "TestScene.h"
#include "base/Random.h"
#include "base/sequences/Sequences.h"
#include "mesh/TriangleMesh.h"
#include "pose/verification/PoseVerification.h"

#include <gtest/gtest.h>

namespace
{
meam::Pose poseAt(const Eigen::Isometry3d& T) { return scenes::displaced(T); }

/// The share of its surface that is there.
double surfaceShare(const meam::Scene& in, const Eigen::Isometry3d& T, const meam::PoseScreeningSettings& settings = {})
{
  return meam::surfaceShares({ poseAt(in.T_local_scene() * T) }, in, scenes::bracket(), settings).front();
}
}

TEST(PoseScreening, CandidatesWithoutTheirSurfaceGoWhereThereAreEnough)
{
  meam::Poses poses;
  for (const Eigen::Isometry3d& T : scenes::threeCopies())
  {
    poses.push_back(poseAt(T));
    poses.push_back(poseAt(Eigen::Translation3d(0, 0, 40) * T)); // in front of all that was measured
  }
  meam::PoseScreeningSettings settings;
  settings.enough = 5;
  const meam::Poses kept = scenes::screen(poses, scenes::copiesScene(), scenes::bracket(), settings);
  ASSERT_EQ(kept.size(), 3u);
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    EXPECT_TRUE(kept[i].T_scene_model.isApprox(scenes::threeCopies()[i], 1e-9)) << "in the order they came";
  }
  settings.enough = 6;
  EXPECT_EQ(scenes::screen(poses, scenes::copiesScene(), scenes::bracket(), settings).size(), 6u) << "all may stay";
}

TEST(PoseScreening, WhatWasNotMeasuredMayBeThereOrNot)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const double whole = surfaceShare(scenes::copiesScene(), T);
  EXPECT_GT(whole, 0.9);
  EXPECT_EQ(surfaceShare(scenes::copiesScene(), Eigen::Translation3d(500, 0, 0) * T), 0.5) << "nothing was measured";
  scenes::Seen part = scenes::seenCopies();
  const float middle = static_cast<float>((T * scenes::bracket().surfaceDistance.middle().cast<double>()).x());
  meam::eraseIf(part.surface, [&](const auto& p) { return p.x() > middle; });
  const meam::Scene half = scenes::prepared(part);
  EXPECT_GT(surfaceShare(half, T), 0.6);
  EXPECT_LT(surfaceShare(half, T), whole - 0.1);
}

TEST(PoseScreening, WithoutFreeSpaceWhatTheSensorLookedPastMayBeThereOrNot)
{
  const Eigen::Isometry3d lifted = Eigen::Translation3d(0, 0, 40) * scenes::threeCopies()[0];
  EXPECT_EQ(surfaceShare(scenes::copiesScene(), lifted), 0.0);
  meam::PoseScreeningSettings settings;
  settings.freeSpace = false;
  EXPECT_EQ(surfaceShare(scenes::copiesScene(), lifted, settings), 0.5);
}

TEST(PoseScreening, OfDuplicatesMoreVotesDoNotMakeUpForSurfaceThatIsNotThere)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[1];
  const double above = 0.035 * scenes::bracket().diameter; // more than fits, and less than tells two poses apart
  meam::Poses poses{ poseAt(Eigen::Translation3d(0, 0, above) * T), poseAt(T) };
  poses[0].votes = 120;
  poses[1].votes = 100;
  const meam::Poses kept = scenes::screen(poses, scenes::copiesScene(), scenes::bracket());
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_LT(meam::translationError(kept[0].T_scene_model, T), 1e-6);
}

TEST(PoseScreening, OfDuplicatesWithoutASurfaceTheOneWithMostVotesStays)
{
  scenes::Seen bare = scenes::seenCopies();
  bare.surface.clear();
  const meam::Scene edgesOnly = scenes::prepared(bare);
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const double apart = 0.04 * scenes::bracket().diameter;
  meam::Poses poses{ poseAt(T), scenes::displaced(T, 0.9 * apart), scenes::displaced(T, 1.5 * apart),
    scenes::displaced(T, 500.0) };
  const int votes[] = { 10, 12, 3, 1 };
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    poses[i].votes = votes[i];
  }
  meam::PoseScreeningSettings settings;
  settings.enough = 0;
  const meam::Poses kept = scenes::screen(poses, edgesOnly, scenes::bracket(), settings);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0].votes, 12) << "it is near to the first and to the third";
  EXPECT_EQ(kept[1].votes, 1) << "no surface is asked for";
}

TEST(PoseScreening, OfDistanceAndAngleBothTellCandidatesApart)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const Eigen::Vector3d middle = scenes::bracket().visibility->middle().cast<double>();
  const auto turnedInPlace = [&](double degrees)
  { return poseAt(T * meam::turnAbout(Eigen::Vector3d::UnitZ(), degrees * M_PI / 180.0, middle)); };
  const auto left = [](const meam::Pose& a, const meam::Pose& b) {
    return scenes::screen({ a, b }, scenes::copiesScene(), scenes::bracket()).size();
  };
  const double apart = 0.04 * scenes::bracket().diameter;
  EXPECT_EQ(left(poseAt(T), scenes::displaced(T, 0.99 * apart)), 1u);
  EXPECT_EQ(left(poseAt(T), scenes::displaced(T, 1.01 * apart)), 2u);
  EXPECT_EQ(left(poseAt(T), turnedInPlace(5.9)), 1u);
  EXPECT_EQ(left(poseAt(T), turnedInPlace(6.1)), 2u);
}

TEST(PoseScreening, OfACrowdNoTwoAreDuplicatesAndWhatWentIsOneOfWhatStayed)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const Eigen::Vector3d middle = scenes::bracket().visibility->middle().cast<double>();
  meam::Random random(5);
  meam::Poses poses;
  for (int k = 0; k < 400; ++k)
  {
    const auto off = [&] { return 20.0 * (random.uniform() - 0.5); }; // mm, degrees
    const Eigen::Isometry3d moved = Eigen::Translation3d(off(), off(), off()) * T;
    poses.push_back(poseAt(moved * meam::turnAbout(Eigen::Vector3d::UnitZ(), off() * M_PI / 180.0, middle)));
    poses.back().votes = 1 + k % 7;
  }
  const meam::TrainedModel& model = scenes::bracket();
  meam::PoseScreeningSettings settings;
  settings.leastSurface = 0.0;
  const meam::Poses kept = scenes::screen(poses, scenes::copiesScene(), model, settings);
  const auto sameAs = [&](const meam::Pose& a, const meam::Pose& b)
  {
    return meam::translationError(a.T_scene_model, b.T_scene_model, middle) < 0.04 * model.diameter &&
           meam::rotationError(a.T_scene_model, b.T_scene_model) < 6.0;
  };
  EXPECT_GT(kept.size(), 20u);
  EXPECT_LT(kept.size(), 300u);
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      EXPECT_FALSE(sameAs(kept[i], kept[k]));
    }
  }
  for (const meam::Pose& pose : poses)
  {
    EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [&](const meam::Pose& other) { return sameAs(pose, other); }));
  }
}

TEST(PoseScreening, AModelWithoutASurfaceIsScreenedForDuplicatesAlone)
{
  meam::TrainedModel model = scenes::bracket();
  model.surface = {};
  model.deriveFields();
  const auto poses = meam::ofIndices<meam::Pose>(
    8, [&](int k) { return scenes::displaced(scenes::threeCopies()[0], 12.0 * (k / 2), 0.0); }); // each twice
  meam::PoseScreeningSettings settings;
  settings.enough = 0;
  EXPECT_EQ(scenes::screen(poses, scenes::copiesScene(), model, settings).size(), 4u);
}

TEST(PoseScreening, CandidatesThatATurnMakesTheSameTakeOnePlace)
{
  meam::Poses candidates;
  for (const double degrees : { 0.0, 18.0, 36.0, 100.0 })
  {
    candidates.push_back(poseAt(scenes::gearAt(degrees)));
  }
  candidates.push_back(poseAt(scenes::gearAt(0) * Eigen::AngleAxisd(M_PI / 6.0, Eigen::Vector3d::UnitX()))); // tilted
  const meam::Poses kept = scenes::screen(candidates, scenes::gearScene(), scenes::trained<parts::gear>());
  ASSERT_EQ(kept.size(), 2u);
  const auto tilt = [&](int k) { return std::acos(std::abs(kept[k].T_scene_model.linear()(2, 2))) * 180.0 / M_PI; };
  EXPECT_NEAR(tilt(0), 0.0, 0.1);
  EXPECT_NEAR(tilt(1), 30.0, 0.1) << "the other place is the tilted one's";
}

TEST(PoseScreening, CandidatesAreTurnedByTheLikeliestNearSymmetry)
{
  const meam::Pose wrong = poseAt(scenes::gearAt(108));
  const meam::Poses verified = scenes::verify({ wrong }, scenes::gearScene(), scenes::trained<parts::gear>());
  ASSERT_EQ(verified.size(), 1u);
  EXPECT_TRUE(verified[0].T_scene_model.isApprox(scenes::gearAt(108), 1e-9)) << "a pose that is only scored stays";
  const meam::Poses screened = scenes::screen({ wrong }, scenes::gearScene(), scenes::trained<parts::gear>());
  ASSERT_EQ(screened.size(), 1u);
  EXPECT_LT(meam::rotationError(screened[0].T_scene_model, scenes::gearAt(0)), 1.0);
}

TEST(PoseScreening, ThreadsDoNotMatterAndAbortStops)
{
  const auto poses = meam::ofIndices<meam::Pose>(
    300, [&](int k) { return scenes::displaced(scenes::threeCopies()[k % 3], 3.5 * (k / 3 % 10), 13.0 * (k / 30)); });
  meam::PoseScreeningSettings settings;
  settings.threads = 1;
  const meam::Poses one = scenes::screen(poses, scenes::copiesScene(), scenes::bracket(), settings);
  settings.threads = 3;
  const meam::Poses three = scenes::screen(poses, scenes::copiesScene(), scenes::bracket(), settings);
  EXPECT_TRUE(scenes::areSame(one, three));
  EXPECT_TRUE(scenes::screen({}, scenes::copiesScene(), scenes::bracket()).empty());
  EXPECT_THROW(
    scenes::screen(poses, scenes::copiesScene(), scenes::bracket(), {}, [](double) { return false; }), meam::Aborted);
}
