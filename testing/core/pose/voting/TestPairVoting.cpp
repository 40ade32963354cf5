// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/PairVoting.h"

#include "TestScene.h"
#include "pose/voting/VoteAccumulator.h"

#include <algorithm>
#include <set>

namespace
{
/// The model's own edge points as a scene, moved.
meam::LocalCloud asScene(const meam::TrainedModel& model, const Eigen::Isometry3d& T)
{
  meam::LocalCloud scene;
  scene.cloud = parts::moved(model.edges, T);
  return scene;
}

Eigen::Isometry3d someMotion()
{
  std::mt19937 random(5);
  return parts::motion(random, 200.0);
}
}

TEST(PairVoting, PointsOfAPartElectItsPose)
{
  const meam::TrainedModel& model = scenes::bracket();
  const Eigen::Isometry3d T = someMotion();
  const meam::PoseDetectionSettings settings = scenes::withShare(1.0);
  const meam::VotingRound round = meam::edgeRound(asScene(model, T), model, settings);
  ASSERT_EQ(round.points.points.size(), model.edges.size());
  const meam::PairVoting voting(round, settings);
  meam::VoteAccumulator accumulator(model.table.votingPoints, round.part.angleStep);
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  int right = 0, asked = 0;
  for (std::size_t i = 0; i < round.references.size(); i += 10)
  {
    const int k = round.references[i];
    const meam::PairFrame reference(round.points.points[k], round.points.directions[k]);
    accumulator.clear();
    voting.vote(reference, accumulator);
    const std::vector<meam::VotePeak> peaks = accumulator.peaks(1);
    ASSERT_EQ(peaks.size(), 1u);
    const meam::PairFrame ofModel(model.edges.points[peaks[0].modelPoint], model.edges.tangents[peaks[0].modelPoint]);
    const Eigen::Isometry3d found = meam::alignFrames(ofModel, reference, peaks[0].flip, peaks[0].alpha);
    EXPECT_LE(accumulator.votesFor(peaks[0].modelPoint, peaks[0].flip, peaks[0].alpha), peaks[0].votes);
    right += (found * middle - T * middle).norm() < 0.1 * model.diameter ? 1 : 0;
    ++asked;
  }
  EXPECT_GT(right, 0.8 * asked);
}

TEST(PairVoting, ASingleScenePointHasNoPair)
{
  const meam::TrainedModel& model = scenes::bracket();
  meam::LocalCloud scene = asScene(model, Eigen::Isometry3d::Identity());
  meam::VotingRound round = meam::edgeRound(scene, model, scenes::withShare(1.0));
  round.referred = round.points.subset({ 0 });
  const meam::PairVoting voting(round, scenes::withShare(1.0));
  meam::VoteAccumulator accumulator(model.table.votingPoints, round.part.angleStep);
  voting.vote(meam::PairFrame(round.points.points[0], round.points.directions[0]), accumulator);
  EXPECT_TRUE(accumulator.peaks(1).empty());
}

TEST(PairVoting, ReferencesAreTheShareThatIsAskedFor)
{
  const meam::TrainedModel& model = scenes::bracket();
  const meam::LocalCloud scene = asScene(model, Eigen::Isometry3d::Identity());
  const std::size_t all = scene.cloud.size();
  const meam::VotingRound half = meam::edgeRound(scene, model, scenes::withShare(0.5));
  ASSERT_GT(all, 200u); // no less than 100 vote
  EXPECT_EQ(half.references.size(), (all + 1) / 2);
  EXPECT_EQ(std::set<int>(half.references.begin(), half.references.end()).size(), half.references.size());
  // The first of them are those of a smaller share.
  const meam::VotingRound quarter = meam::edgeRound(scene, model, scenes::withShare(0.25));
  EXPECT_TRUE(std::equal(quarter.references.begin(), quarter.references.end(), half.references.begin()));
}

TEST(PairVoting, ReferencesDoNotDependOnTheOrderOfThePoints)
{
  const meam::TrainedModel& model = scenes::bracket();
  meam::LocalCloud scene = asScene(model, Eigen::Isometry3d::Identity());
  const auto placesOf = [&]
  {
    const meam::VotingRound round = meam::edgeRound(scene, model, scenes::withShare(0.5));
    std::vector<std::array<float, 3>> places;
    for (const int i : round.references)
    {
      const Eigen::Vector3f& p = round.points.points[i];
      places.push_back({ p.x(), p.y(), p.z() });
    }
    std::sort(places.begin(), places.end());
    return places;
  };
  const auto before = placesOf();
  std::reverse(scene.cloud.points.begin(), scene.cloud.points.end());
  std::reverse(scene.cloud.tangents.begin(), scene.cloud.tangents.end());
  EXPECT_EQ(placesOf(), before);
}

TEST(PairVoting, WhatCannotVoteIsRefused)
{
  const meam::TrainedModel& model = scenes::bracket();
  meam::LocalCloud scene = asScene(model, Eigen::Isometry3d::Identity());
  EXPECT_THROW(meam::edgeRound(scene, model, scenes::withShare(1.5)), meam::Error);
  scene.cloud.tangents.clear();
  EXPECT_THROW(meam::edgeRound(scene, model, scenes::withShare(1.0)), meam::Error);
  EXPECT_THROW(meam::edgeRound({}, model, scenes::withShare(1.0)), meam::Error);
}
