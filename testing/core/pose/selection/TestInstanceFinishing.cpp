// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/InstanceFinishing.h"

#include "TestScene.h"
#include "base/sequences/Sequences.h"
#include "pose/verification/PoseVerification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace
{
using scenes::displaced;

/// Poses of the bracket in a scene of three copies, scored and then finished, all of them.
struct Finishing
{
  explicit Finishing(meam::Poses poses)
  {
    const meam::Scene& scene = scenes::copiesScene();
    for (meam::Pose& pose : poses)
    {
      pose.T_scene_model = scene.T_local_scene() * pose.T_scene_model;
    }
    this->scored = meam::verifyPoses(poses, scene, scenes::bracket());
  }

  meam::FinishedInstances finished() const
  {
    const meam::Scene& scene = scenes::copiesScene();
    const meam::TrainedModel& model = scenes::bracket();
    const meam::EvidenceCollector collector(scene, model, {});
    const meam::PoseComparison comparison(scene, model, {});
    const meam::EvidenceRates rates = meam::evidenceRatesOf(this->scored, collector, {}, 1, 1);
    const meam::LocalSearch search(scene, model, comparison, collector, rates, {});
    const meam::InstanceClaims claims(scene, model, 0.1 * model.diameter);
    std::vector<int> all(this->scored.size());
    std::iota(all.begin(), all.end(), 0);
    return meam::InstanceFinishing(scene, model, search, claims, this->settings).finished(this->scored, all, {});
  }

  meam::Poses scored;
  meam::PoseSelectionSettings settings;
};

/// How many of them were finished.
int finishedOf(const Finishing& finishing)
{
  const meam::FinishedInstances finished = finishing.finished();
  EXPECT_EQ(finished.size(), finishing.scored.size());
  return static_cast<int>(std::count_if(finished.begin(), finished.end(),
    [](const meam::FinishedInstance& one) { return !one.pose.fit.covariance.isZero(); }));
}

/// How many were finished, or judged to be hopeless, and not left as they were scored.
int lookedAtOf(const Finishing& finishing)
{
  const meam::FinishedInstances finished = finishing.finished();
  int count = 0;
  for (std::size_t k = 0; k < finished.size(); ++k)
  {
    count += finished[k].logOdds != finishing.scored[k].evidence ? 1 : 0;
  }
  return count;
}

/// The three copies, a little off, and around the first many that are wrong.
meam::Poses copiesAndWrongOnes(int wrong)
{
  auto poses =
    meam::mapped<meam::Pose>(scenes::threeCopies(), [&](const Eigen::Isometry3d& T) { return displaced(T, 0.3, 0.3); });
  for (int k = 0; k < wrong; ++k)
  {
    poses.push_back(displaced(scenes::threeCopies()[0], 12.0 + 0.1 * k, 25.0));
  }
  return poses;
}
}

TEST(InstanceFinishing, WhatASurePoseExcludesStaysAsItWasScored)
{
  Finishing finishing(copiesAndWrongOnes(0));
  // Eight are finished together: what comes later finds them sure.
  for (int k = 0; k < 5; ++k)
  {
    finishing.scored.push_back(finishing.scored[0]);
  }
  meam::Pose excluded = finishing.scored[0];
  excluded.T_scene_model = excluded.T_scene_model * Eigen::Translation3d(1.5, 1.0, 0.0);
  excluded.evidence = 0.0;
  excluded.placeProbability = 0.5;
  finishing.scored.push_back(excluded);
  EXPECT_EQ(finishedOf(finishing), 8);
  finishing.settings.excludesOverlaps = false;
  EXPECT_EQ(finishedOf(finishing), 9);
}

TEST(InstanceFinishing, WhatIsHopelessWhereItLiesIsNotFinished)
{
  Finishing finishing(copiesAndWrongOnes(5));
  EXPECT_EQ(finishedOf(finishing), 3);
  EXPECT_EQ(lookedAtOf(finishing), 8);
}

TEST(InstanceFinishing, WhereEnoughAreSureTheUnlikelyStayAsTheyWereScored)
{
  Finishing finishing(copiesAndWrongOnes(30));
  finishing.settings.excludesOverlaps = false;
  EXPECT_EQ(lookedAtOf(finishing), 33);
  finishing.settings.maximumPoses = 1; // and two to spare
  EXPECT_EQ(lookedAtOf(finishing), 4) << "those of the smallest lot";
  finishing.settings.maximumPoses = 2; // of four, one is missing: nothing but a long row of wrong ones ends it
  EXPECT_EQ(lookedAtOf(finishing), 20) << "three that are sure, and 16 that are not, in lots of four";
  finishing.settings.sureCopies = 3;
  EXPECT_EQ(lookedAtOf(finishing), 4);
}

TEST(InstanceFinishing, ALongRowOfWrongPosesEndsIt)
{
  Finishing finishing(copiesAndWrongOnes(100));
  finishing.settings.excludesOverlaps = false;
  EXPECT_EQ(lookedAtOf(finishing), 40) << "three that are sure, and 32 that are not, in lots of eight";
  finishing.settings.maximumPoses = 20;
  EXPECT_EQ(lookedAtOf(finishing), 40) << "no more than where all are wanted";
  finishing.settings.maximumPoses = 5;
  EXPECT_EQ(lookedAtOf(finishing), 19) << "three that are sure, and 16 that are not, in lots of seven and of four";
}

TEST(InstanceFinishing, WhatIsLeftComesAfterWhatIsFinished)
{
  Finishing finishing(copiesAndWrongOnes(10));
  finishing.settings.excludesOverlaps = false;
  finishing.settings.maximumPoses = 1; // and two to spare: the first four are finished
  finishing.scored.back().evidence = 20.0;
  finishing.scored.back().probability = 1.0;
  meam::FinishedInstances finished = finishing.finished();
  EXPECT_EQ(
    std::count_if(finished.begin(), finished.end(), [](const meam::FinishedInstance& one) { return one.isLeft; }), 9);
  EXPECT_EQ(finished.back().pose.evidence, 20.0);
  meam::sortBest(finished);
  EXPECT_FALSE(finished[3].isLeft);
  EXPECT_TRUE(finished[4].isLeft);
  EXPECT_EQ(finished[4].pose.evidence, 20.0);
}

TEST(InstanceFinishing, IsTheSameOnAnyNumberOfThreads)
{
  Finishing finishing(copiesAndWrongOnes(20));
  finishing.settings.threads = 1;
  const meam::FinishedInstances one = finishing.finished();
  finishing.settings.threads = 3;
  const meam::FinishedInstances three = finishing.finished();
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t k = 0; k < one.size(); ++k)
  {
    EXPECT_TRUE(one[k].pose.T_scene_model.isApprox(three[k].pose.T_scene_model, 0.0));
    EXPECT_EQ(one[k].logOdds, three[k].logOdds);
  }
}
