// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseRefinement.h"

#include "baselines/BaselineSettings.h"
#include "TestScene.h"
#include "TestSteps.h"

#include <algorithm>

namespace
{
/// Without what the sensor measured.
meam::Scene edgesAlone(scenes::Seen bare)
{
  bare.surface.clear();
  return scenes::prepared(bare);
}

void expectNear(const meam::Poses& poses, double millimetres, double degrees)
{
  ASSERT_EQ(poses.size(), 3u);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    EXPECT_TRUE(scenes::areNear(poses[i].T_scene_model, scenes::threeCopies()[i], millimetres, degrees)) << i;
    EXPECT_NEAR(poses[i].T_scene_model.linear().determinant(), 1.0, 1e-9);
  }
}
}

TEST(PoseRefinement, ADisturbedPoseComesBackAndTheTrueOneStays)
{
  for (const auto& [millimetres, degrees] : { std::pair(1.5, 2.0), { 0.0, 0.0 } })
  {
    expectNear(scenes::refine(scenes::disturbedCopies(millimetres, degrees), scenes::copiesScene(), scenes::bracket()),
      0.15, 0.25);
  }
}

TEST(PoseRefinement, EdgesAlone)
{
  expectNear(
    scenes::refine(scenes::disturbedCopies(1.0, 1.5), edgesAlone(scenes::seenCopies()), scenes::bracket()), 0.8, 1.5);
}

TEST(PoseRefinement, ScoresAndOrderStayAndThreadsDoNotMatter)
{
  const auto refined = [](int threads)
  {
    meam::PoseRefinementSettings settings;
    settings.threads = threads;
    return scenes::refine(scenes::disturbedCopies(1.5, 2.0), scenes::copiesScene(), scenes::bracket(), settings);
  };
  const meam::Poses one = refined(1);
  EXPECT_TRUE(scenes::areSame(one, refined(3)));
  for (const meam::Pose& pose : one)
  {
    EXPECT_EQ(pose.score, 0.5);
    EXPECT_EQ(pose.votes, 12);
  }
}

TEST(PoseRefinement, FarFromAnythingThePoseStaysFinite)
{
  meam::Poses far = scenes::disturbedCopies(0.0, 0.0);
  for (auto& pose : far)
  {
    pose.T_scene_model.pretranslate(Eigen::Vector3d(5000, 0, 0));
  }
  for (const auto& settings : { meam::PoseRefinementSettings(), meam::paperRefinementSettings() })
  {
    const meam::Poses refined = scenes::refine(far, scenes::copiesScene(), scenes::bracket(), settings);
    for (std::size_t i = 0; i < far.size(); ++i)
    {
      EXPECT_LT(meam::translationError(refined[i].T_scene_model, far[i].T_scene_model), 1e-6);
      EXPECT_EQ(refined[i].fit.constrained, 0);
      EXPECT_NEAR(std::sqrt(refined[i].fit.covariance(5, 5)), 0.5 * scenes::bracket().diameter, 1e-6) << "not known";
    }
  }
}

TEST(PoseRefinement, TellsHowWellTheSceneFixesThePose)
{
  for (const meam::Pose& pose :
    scenes::refine(scenes::disturbedCopies(1.0, 1.5), scenes::copiesScene(), scenes::bracket()))
  {
    EXPECT_EQ(pose.fit.constrained, 6);
    EXPECT_TRUE(pose.fit.constrainedAxes.isOnes(1e-9));
    EXPECT_EQ(pose.fit.iterations, meam::PoseRefinementSettings().iterations);
    EXPECT_GT(pose.fit.residual, 0.0);
    EXPECT_LT(pose.fit.residual, 0.01 * scenes::bracket().diameter);
    EXPECT_TRUE(pose.fit.covariance.isApprox(pose.fit.covariance.transpose()));
    EXPECT_GT(pose.fit.covariance.diagonal().minCoeff(), 0.0);
    EXPECT_LT(std::sqrt(pose.fit.covariance.diagonal().tail<3>().maxCoeff()), 0.1) << "mm";
    EXPECT_LT(std::sqrt(pose.fit.covariance.diagonal().head<3>().maxCoeff()) * 180.0 / M_PI, 0.2) << "degrees";
  }
}

TEST(PoseRefinement, AlongASingleEdgeNothingFixesThePose)
{
  // One straight edge: it may slide along itself and turn about itself.
  scenes::Seen line = scenes::seenCopies();
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const Eigen::Vector3f start = (T * Eigen::Vector3d(0, 0, 15)).cast<float>();
  const Eigen::Vector3f end = (T * Eigen::Vector3d(60, 0, 15)).cast<float>();
  line.edges = {};
  for (int k = 0; k <= 40; ++k)
  {
    line.edges.points.push_back(start + (end - start) * (k / 40.0f));
    line.edges.tangents.push_back((end - start).normalized());
  }
  meam::Poses pose = scenes::disturbedCopies(0.0, 0.0);
  pose.resize(1);
  const meam::PoseFit fit = scenes::refine(pose, edgesAlone(line), scenes::bracket())[0].fit;
  EXPECT_EQ(fit.constrained, 4);
  const Eigen::Vector3d along = (end - start).normalized().cast<double>();
  const Eigen::Matrix3d shifts = fit.covariance.bottomRightCorner<3, 3>();
  const Eigen::Vector3d across = along.unitOrthogonal();
  EXPECT_GT(along.dot(shifts * along), 100.0 * across.dot(shifts * across));
}

TEST(PoseRefinement, WhereTheSceneLeavesAFreedomIsSaid)
{
  const meam::Poses pose{ scenes::disturbedCopies(0.3, 0.5)[0] };
  const meam::PoseFit fit = scenes::refine(pose, scenes::upperFaces({ 0 }), scenes::bracket())[0].fit;
  EXPECT_EQ(fit.constrained, 3);
  Eigen::Matrix<double, 6, 1> across;
  across << 1, 1, 0, 0, 0, 1;
  EXPECT_LT((fit.constrainedAxes - across).cwiseAbs().maxCoeff(), 0.02) << fit.constrainedAxes.transpose();
}

TEST(PoseRefinement, BadInput)
{
  meam::PoseRefinementSettings none;
  none.iterations = 0;
  EXPECT_THROW(
    scenes::refine(scenes::disturbedCopies(0, 0), scenes::copiesScene(), scenes::bracket(), none), meam::Error);
  EXPECT_TRUE(scenes::refine({}, scenes::copiesScene(), scenes::bracket()).empty());
  scenes::Seen weighted = scenes::seenCopies();
  weighted.edges.weights.assign(weighted.edges.size(), 1.0f);
  EXPECT_NO_THROW(scenes::refine(scenes::disturbedCopies(0, 0), scenes::prepared(weighted), scenes::bracket()));
  steps::expectStops([](const meam::Progress& progress)
    { scenes::refine(scenes::disturbedCopies(0, 0), scenes::copiesScene(), scenes::bracket(), {}, progress); });
}
