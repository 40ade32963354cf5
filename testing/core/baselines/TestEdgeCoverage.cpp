// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/EdgeCoverage.h"

#include "baselines/BaselineSettings.h"
#include "TestScene.h"

namespace
{
double coverageAtOrigin(const meam::Scene& scene, const meam::PoseVerificationSettings& settings)
{
  const meam::Pose pose = scenes::displaced(Eigen::Isometry3d::Identity());
  return scenes::verify({ pose }, scene, scenes::bracket(), settings).at(0).score;
}
}

TEST(EdgeCoverage, FollowsThePaper)
{
  // The share of the view's edge points that have a scene edge point within the tolerance, exactly.
  const meam::TrainedModel& model = scenes::bracket();
  scenes::Seen own;
  own.edges = model.edges;
  meam::PoseVerificationSettings settings = meam::paperVerificationSettings();
  EXPECT_DOUBLE_EQ(coverageAtOrigin(scenes::prepared(own), settings), 1.0);
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
  settings.evidence.tolerance = 1e-4;
  EXPECT_DOUBLE_EQ(coverageAtOrigin(scenes::prepared(own), settings), static_cast<double>(half.size()) / inView);
}

TEST(EdgeCoverage, APoseThatNamesNoViewTakesTheNearestToTheSensor)
{
  const meam::PoseVerificationSettings paper = meam::paperVerificationSettings();
  meam::Pose pose = scenes::displaced(scenes::threeCopies()[0]);
  pose.viewId = -1;
  const meam::Pose verified = scenes::verify({ pose }, scenes::copiesScene(), scenes::bracket(), paper).at(0);
  EXPECT_EQ(verified.viewId,
    meam::PredictedVisibility(scenes::bracket()).view(pose.T_scene_model, scenes::seenCopies().sensor));
  EXPECT_GT(verified.score, 0.5);
}
