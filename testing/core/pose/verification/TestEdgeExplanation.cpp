// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/EdgeExplanation.h"

#include "TestScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

TEST(EdgeExplanation, EdgesOfAKnownPoseAreExplainedByItAndOthersByNone)
{
  const auto& copies = scenes::threeCopies();
  const meam::Poses poses{ scenes::displaced(copies[2]), scenes::displaced(copies[0]) };
  const int expected[] = { 1, -1, 0 };
  for (std::size_t k = 0; k < copies.size(); ++k)
  {
    const meam::LocalCloud edges = meam::toLocalCloud(scenes::seenFromAbove({ copies[k] }).edges);
    const std::vector<int> explained = meam::explainEdges(edges, poses, scenes::bracket());
    ASSERT_EQ(explained.size(), edges.cloud.size());
    EXPECT_GT(std::count(explained.begin(), explained.end(), expected[k]), 0.9 * explained.size()) << "copy " << k;
  }
}

TEST(EdgeExplanation, AWrongPoseExplainsFew)
{
  const auto& copies = scenes::threeCopies();
  const meam::LocalCloud edges = meam::toLocalCloud(scenes::seenFromAbove({ copies[0] }).edges);
  const auto count = [&](const meam::Pose& pose)
  {
    const std::vector<int> explained = meam::explainEdges(edges, { pose }, scenes::bracket());
    return std::count(explained.begin(), explained.end(), 0);
  };
  EXPECT_LT(3 * count(scenes::displaced(copies[0], 3.0, 40.0)), count(scenes::displaced(copies[0])));
  EXPECT_EQ(count(scenes::displaced(copies[0], 500.0)), 0);
}

TEST(EdgeExplanation, WithoutPosesNothingIsExplained)
{
  const meam::LocalCloud edges = meam::toLocalCloud(scenes::seenFromAbove(scenes::threeCopies()).edges);
  const std::vector<int> explained = meam::explainEdges(edges, {}, scenes::bracket());
  EXPECT_EQ(std::count(explained.begin(), explained.end(), -1), static_cast<long>(edges.cloud.size()));
}

TEST(EdgeExplanation, ExplainedIsWhatLiesNearAnEdgeOfThePart)
{
  const meam::TrainedModel& model = scenes::bracket();
  const meam::Pose pose = scenes::displaced(scenes::threeCopies()[1]);
  const Eigen::Vector3d middle = pose.T_scene_model * model.edgeDistance.middle().cast<double>();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(-0.8, 0.8); // of the diameter: beyond the part on all sides
  meam::LocalCloud around;
  for (int k = 0; k < 20000; ++k)
  {
    const Eigen::Vector3d off(within(random), within(random), within(random));
    around.cloud.points.push_back((middle + model.diameter * off).cast<float>());
  }
  const double near = 0.02 * model.diameter;
  const std::vector<int> explained = meam::explainEdges(around, { pose }, model, near);
  for (std::size_t k = 0; k < explained.size(); ++k)
  {
    const Eigen::Vector3f inPart = pose.T_scene_model.inverse().cast<float>() * around.cloud.points[k];
    ASSERT_EQ(explained[k] == 0, model.edgeDistance.at(inPart) <= static_cast<float>(near)) << inPart.transpose();
  }
  EXPECT_GT(std::count(explained.begin(), explained.end(), 0), 50);
}
