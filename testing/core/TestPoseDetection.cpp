// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseDetection.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
int right(const meam::Poses& poses, const std::vector<Eigen::Isometry3d>& truth, double millimetres, double degrees)
{
  return static_cast<int>(std::count_if(poses.begin(), poses.end(),
    [&](const meam::Pose& pose)
    {
      return std::any_of(truth.begin(), truth.end(),
        [&](const auto& T)
        {
          return meam::translationError(pose.T_scene_model, T) < millimetres &&
            meam::rotationError(pose.T_scene_model, T) < degrees;
        });
    }));
}

/// The model's own edges, moved: what voting should find exactly.
meam::PointCloud ownEdges(const Eigen::Isometry3d& T, float sign = 1.0f)
{
  meam::PointCloud edges = parts::moved(scenes::bracket().edges, T);
  for (auto& tangent : edges.tangents)
  {
    tangent *= sign;
  }
  return edges;
}
}

TEST(PoseDetection, AMovedPartIsFoundAgain)
{
  std::mt19937 random(5);
  for (int trial = 0; trial < 4; ++trial)
  {
    const Eigen::Isometry3d T = parts::motion(random, 300.0);
    for (const float sign : { 1.0f, -1.0f })
    {
      const meam::Poses poses = meam::detectPoses(ownEdges(T, sign), scenes::bracket());
      ASSERT_GT(poses.size(), 10u);
      EXPECT_GE(right(poses, { T }, 3.0, 6.0), static_cast<int>(0.8 * poses.size())) << "sign " << sign;
    }
  }
}

TEST(PoseDetection, CopiesInASceneAreAmongTheCandidates)
{
  const meam::Scene scene = scenes::withTangents(scenes::seenFromAbove(scenes::threeCopies()));
  const meam::Poses poses = meam::detectPoses(scene.edges, scenes::bracket());
  for (const auto& T : scenes::threeCopies())
  {
    EXPECT_GE(right(poses, { T }, 6.0, 10.0), 1);
  }
}

TEST(PoseDetection, TheSameForAnyNumberOfThreads)
{
  const meam::Scene scene = scenes::withTangents(scenes::seenFromAbove(scenes::threeCopies()));
  meam::PoseDetectionSettings settings;
  settings.threads = 1;
  const meam::Poses one = meam::detectPoses(scene.edges, scenes::bracket(), settings);
  settings.threads = 3;
  const meam::Poses three = meam::detectPoses(scene.edges, scenes::bracket(), settings);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    EXPECT_EQ(one[i].votes, three[i].votes);
    EXPECT_TRUE(one[i].T_scene_model.matrix() == three[i].T_scene_model.matrix());
  }
}

TEST(PoseDetection, TheSeedChoosesTheReferencePoints)
{
  const meam::PointCloud edges = ownEdges(Eigen::Isometry3d::Identity());
  meam::PoseDetectionSettings settings;
  const meam::Poses first = meam::detectPoses(edges, scenes::bracket(), settings);
  const meam::Poses again = meam::detectPoses(edges, scenes::bracket(), settings);
  settings.seed = 2;
  const meam::Poses other = meam::detectPoses(edges, scenes::bracket(), settings);
  const auto same = [](const meam::Poses& a, const meam::Poses& b)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
      [](const auto& p, const auto& q) { return p.T_scene_model.matrix() == q.T_scene_model.matrix(); });
  };
  EXPECT_TRUE(same(first, again));
  EXPECT_FALSE(same(first, other));
}

TEST(PoseDetection, PointsOfOneCubeMakeOnePair)
{
  const auto mostVotes = [](const meam::PointCloud& edges)
  {
    meam::PoseDetectionSettings settings;
    settings.referenceShare = 1.0;
    const meam::Poses poses = meam::detectPoses(edges, scenes::bracket(), settings);
    return std::max_element(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.votes < b.votes; })->votes;
  };
  const meam::PointCloud once = ownEdges(Eigen::Isometry3d::Identity());
  meam::PointCloud twice = once;
  for (std::size_t i = 0; i < once.size(); ++i)
  {
    twice.points.push_back(once.points[i] + Eigen::Vector3f(0.01f, 0.01f, 0.01f));
    twice.tangents.push_back(once.tangents[i]);
  }
  EXPECT_LT(mostVotes(twice), 1.2 * mostVotes(once));
}

TEST(PoseDetection, BadInput)
{
  const meam::TrainedModel& model = scenes::bracket();
  EXPECT_THROW(meam::detectPoses({}, model), meam::Error);
  meam::PointCloud bare = ownEdges(Eigen::Isometry3d::Identity());
  bare.tangents.clear();
  EXPECT_THROW(meam::detectPoses(bare, model), meam::Error);
  meam::PointCloud metres = ownEdges(Eigen::Isometry3d::Identity());
  for (auto& point : metres.points)
  {
    point *= 0.001f;
  }
  try
  {
    meam::detectPoses(metres, model);
    FAIL() << "metres taken for millimetres";
  }
  catch (const meam::Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("1000"), std::string::npos) << error.what();
  }
  meam::PoseDetectionSettings none;
  none.referenceShare = 0.0;
  EXPECT_THROW(meam::detectPoses(ownEdges(Eigen::Isometry3d::Identity()), model, none), meam::Error);
  EXPECT_THROW(meam::detectPoses(ownEdges(Eigen::Isometry3d::Identity()), model, {}, [](double) { return false; }),
    meam::Aborted);
}
