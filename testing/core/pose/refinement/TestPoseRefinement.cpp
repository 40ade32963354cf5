// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseRefinement.h"

#include "TestScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
const meam::Scene& scene()
{
  static const meam::Scene seen = scenes::withTangents(scenes::seenFromAbove(scenes::threeCopies()));
  return seen;
}

meam::Poses disturbed(double millimetres, double degrees)
{
  std::mt19937 random(11);
  meam::Poses poses;
  for (const auto& T : scenes::threeCopies())
  {
    Eigen::Vector3d axis = parts::motion(random, 1.0).linear().col(0);
    Eigen::Vector3d shift = parts::motion(random, 1.0).linear().col(1);
    meam::Pose pose;
    pose.T_scene_model = T;
    pose.T_scene_model.translate(millimetres * shift);
    pose.T_scene_model.rotate(Eigen::AngleAxisd(degrees * M_PI / 180.0, axis));
    pose.viewId = T.linear()(2, 2) > 0 ? 0 : 1; // seen from its +z or its -z
    pose.score = 0.5;
    pose.votes = 12;
    poses.push_back(pose);
  }
  return poses;
}

void expectNear(const meam::Poses& poses, double millimetres, double degrees)
{
  ASSERT_EQ(poses.size(), 3u);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    EXPECT_LT(meam::translationError(poses[i].T_scene_model, scenes::threeCopies()[i]), millimetres) << i;
    EXPECT_LT(meam::rotationError(poses[i].T_scene_model, scenes::threeCopies()[i]), degrees) << i;
    EXPECT_NEAR(poses[i].T_scene_model.linear().determinant(), 1.0, 1e-9);
  }
}
}

TEST(PoseRefinement, ADisturbedPoseComesBack)
{
  expectNear(meam::refinePoses(disturbed(1.5, 2.0), scenes::bracket(), scene()), 0.15, 0.25);
}

TEST(PoseRefinement, TheTruePoseStays)
{
  expectNear(meam::refinePoses(disturbed(0.0, 0.0), scenes::bracket(), scene()), 0.15, 0.25);
}

TEST(PoseRefinement, EdgesAlone)
{
  meam::Scene edgesOnly = scene();
  edgesOnly.surface.clear();
  expectNear(meam::refinePoses(disturbed(1.0, 1.5), scenes::bracket(), edgesOnly), 0.8, 1.5);
}

TEST(PoseRefinement, PointToPointOfThePaper)
{
  expectNear(
    meam::refinePoses(disturbed(1.5, 2.0), scenes::bracket(), scene(), meam::paperRefinementSettings()), 0.8, 1.5);
}

TEST(PoseRefinement, ScoresAndOrderStayAndThreadsDoNotMatter)
{
  meam::PoseRefinementSettings settings;
  settings.threads = 1;
  const meam::Poses one = meam::refinePoses(disturbed(1.5, 2.0), scenes::bracket(), scene(), settings);
  settings.threads = 3;
  const meam::Poses three = meam::refinePoses(disturbed(1.5, 2.0), scenes::bracket(), scene(), settings);
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    EXPECT_TRUE(one[i].T_scene_model.matrix() == three[i].T_scene_model.matrix());
    EXPECT_EQ(one[i].score, 0.5);
    EXPECT_EQ(one[i].votes, 12);
  }
}

TEST(PoseRefinement, FarFromAnythingThePoseStaysFinite)
{
  meam::Poses far = disturbed(0.0, 0.0);
  for (auto& pose : far)
  {
    pose.T_scene_model.pretranslate(Eigen::Vector3d(5000, 0, 0));
  }
  for (const auto& settings : { meam::PoseRefinementSettings(), meam::paperRefinementSettings() })
  {
    const meam::Poses refined = meam::refinePoses(far, scenes::bracket(), scene(), settings);
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
  for (const meam::Pose& pose : meam::refinePoses(disturbed(1.0, 1.5), scenes::bracket(), scene()))
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

TEST(PoseRefinement, APoseSettlesInOnePlaceWhereverItComesFrom)
{
  const meam::SceneIndex index(scenes::bracket(), scene());
  const meam::Poses right = disturbed(0.0, 0.0);
  const meam::Poses near = disturbed(0.05, 0.1);
  meam::Poses settled;
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    settled.push_back(meam::settlePose(near[i], index));
    EXPECT_EQ(settled[i].score, near[i].score);
    EXPECT_EQ(settled[i].fit.constrained, 6);
    const Eigen::Isometry3d other = meam::settlePose(right[i], index).T_scene_model;
    EXPECT_LT(meam::translationError(settled[i].T_scene_model, other), 1e-3);
    EXPECT_LT(meam::rotationError(settled[i].T_scene_model, other), 1e-3);
  }
  expectNear(settled, 0.15, 0.25);
}

TEST(PoseRefinement, APoseSettlesInTheSamePlaceOfASceneThatIsMoved)
{
  std::mt19937 random(8);
  const meam::Scene still = meam::sceneInOwnFrame(scene().edges, meam::inOwnFrame(scene().surface), scene().sensor);
  const meam::SceneIndex index(scenes::bracket(), still);
  const meam::Poses near = disturbed(0.05, 0.1);
  for (int k = 0; k < 5; ++k)
  {
    const Eigen::Isometry3d T = parts::motion(random, 200.0);
    const Eigen::Isometry3f moving = T.cast<float>();
    meam::Scene moved = scene();
    for (meam::Points* points : { &moved.surface, &moved.edges.points })
    {
      for (auto& point : *points)
      {
        point = moving * point;
      }
    }
    for (auto& tangent : moved.edges.tangents)
    {
      tangent = moving.linear() * tangent;
    }
    moved.sensor.position = T * moved.sensor.position;
    moved.sensor.direction = T.linear() * moved.sensor.direction;
    moved = meam::sceneInOwnFrame(moved.edges, meam::inOwnFrame(moved.surface), moved.sensor);
    const meam::SceneIndex elsewhere(scenes::bracket(), moved);
    const Eigen::Isometry3d between = moved.frame * T * still.frame.inverse();
    for (const meam::Pose& pose : meam::inFrameOf(still, near, scenes::bracket().symmetries))
    {
      const Eigen::Isometry3d expected = between * meam::settlePose(pose, index).T_scene_model;
      meam::Pose other = pose;
      other.T_scene_model = between * pose.T_scene_model;
      other = meam::settlePose(other, elsewhere);
      EXPECT_LT(meam::translationError(other.T_scene_model, expected, index.view.middle().cast<double>()), 1e-3);
      EXPECT_LT(meam::rotationError(other.T_scene_model, expected), 1e-3);
    }
  }
}

namespace
{
/// The upper faces alone, in which a part may slide, and the edge points of these indices.
meam::Scene upperFaces(const std::vector<int>& edges)
{
  meam::Scene faces = scene();
  const auto isLow = [](const Eigen::Vector3f& point) { return point.z() <= 14.5f; };
  faces.surface.erase(std::remove_if(faces.surface.begin(), faces.surface.end(), isLow), faces.surface.end());
  faces.edges = faces.edges.subset(edges);
  return faces;
}
}

TEST(PoseRefinement, WhereTheSceneLeavesAFreedomAPoseIsNotSettled)
{
  const meam::Scene face = upperFaces({ 0 });
  const meam::SceneIndex index(scenes::bracket(), face);
  const meam::Pose pose = disturbed(0.3, 0.5)[0];
  const meam::PoseFit fit = meam::refinePoses({ pose }, index)[0].fit;
  EXPECT_EQ(fit.constrained, 3);
  Eigen::Matrix<double, 6, 1> across;
  across << 1, 1, 0, 0, 0, 1; // the part lies flat: it may turn about z and slide along x and y
  EXPECT_LT((fit.constrainedAxes - across).cwiseAbs().maxCoeff(), 0.02) << fit.constrainedAxes.transpose();
  const meam::Pose stays = meam::settlePose(pose, index);
  EXPECT_TRUE(stays.T_scene_model.isApprox(pose.T_scene_model, 1e-12));
  EXPECT_EQ(stays.fit.constrained, 3) << "how well the scene fixes the pose is told all the same";
}

TEST(PoseRefinement, WhereTheSceneFixesAPoseWeaklyItIsSettled)
{
  std::vector<int> few;
  for (int k = 0; k < static_cast<int>(scene().edges.size()); k += 8)
  {
    few.push_back(k);
  }
  const meam::Scene face = upperFaces(few);
  const meam::SceneIndex index(scenes::bracket(), face);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const meam::Pose one = meam::settlePose(disturbed(0.1, 0.2)[i], index);
    const meam::Pose other = meam::settlePose(disturbed(0.05, 0.1)[i], index);
    EXPECT_EQ(one.fit.constrained, 5) << "less than a hundredth of what corresponds speaks for the sixth";
    EXPECT_LT(meam::translationError(one.T_scene_model, other.T_scene_model), 1e-3);
    EXPECT_LT(meam::rotationError(one.T_scene_model, other.T_scene_model), 1e-3);
  }
}

TEST(PoseRefinement, AlongASingleEdgeNothingFixesThePose)
{
  // One straight edge: it may slide along itself and turn about itself.
  meam::Scene line = scene();
  line.surface.clear();
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const Eigen::Vector3f start = (T * Eigen::Vector3d(0, 0, 15)).cast<float>();
  const Eigen::Vector3f end = (T * Eigen::Vector3d(60, 0, 15)).cast<float>();
  line.edges = {};
  for (int k = 0; k <= 40; ++k)
  {
    line.edges.points.push_back(start + (end - start) * (k / 40.0f));
    line.edges.tangents.push_back((end - start).normalized());
  }
  meam::Poses pose = disturbed(0.0, 0.0);
  pose.resize(1);
  const meam::PoseFit fit = meam::refinePoses(pose, scenes::bracket(), line)[0].fit;
  EXPECT_EQ(fit.constrained, 4);
  const Eigen::Vector3d along = (end - start).normalized().cast<double>();
  const Eigen::Matrix3d shifts = fit.covariance.bottomRightCorner<3, 3>();
  const Eigen::Vector3d across = along.unitOrthogonal();
  EXPECT_GT(along.dot(shifts * along), 100.0 * across.dot(shifts * across));
}

TEST(PoseRefinement, BadInput)
{
  meam::PoseRefinementSettings none;
  none.iterations = 0;
  EXPECT_THROW(meam::refinePoses(disturbed(0, 0), scenes::bracket(), scene(), none), meam::Error);
  EXPECT_THROW(meam::refinePoses(disturbed(0, 0), scenes::bracket(), {}), meam::Error);
  meam::Scene weighted = scene();
  weighted.edges.weights.assign(weighted.edges.size() - 1, 1.0f);
  EXPECT_THROW(meam::refinePoses(disturbed(0, 0), scenes::bracket(), weighted), meam::Error) << "one is missing";
  weighted.edges.weights.push_back(1.0f);
  EXPECT_NO_THROW(meam::refinePoses(disturbed(0, 0), scenes::bracket(), weighted));
  for (const float weight : { -0.1f, 1.5f, NAN })
  {
    weighted.edges.weights.back() = weight;
    EXPECT_THROW(meam::refinePoses(disturbed(0, 0), scenes::bracket(), weighted), meam::Error) << weight;
  }
  meam::Poses notFinite = disturbed(0, 0);
  notFinite[1].T_scene_model.translation().y() = NAN;
  EXPECT_THROW(meam::refinePoses(notFinite, scenes::bracket(), scene()), meam::Error);
}

TEST(PoseRefinement, APoseThatNamesNoViewTakesTheNearestToTheSensor)
{
  meam::Poses nameless = disturbed(0.3, 0.5);
  meam::Poses named = nameless;
  for (std::size_t i = 0; i < named.size(); ++i)
  {
    nameless[i].viewId = i % 2 == 0 ? -1 : 99;
    named[i].viewId = meam::PredictedVisibility(scenes::bracket()).view(named[i].T_scene_model, scene().sensor);
  }
  const meam::PoseRefinementSettings settings = meam::paperRefinementSettings();
  const meam::Poses one = meam::refinePoses(nameless, scenes::bracket(), scene(), settings);
  const meam::Poses other = meam::refinePoses(named, scenes::bracket(), scene(), settings);
  for (std::size_t i = 0; i < named.size(); ++i)
  {
    EXPECT_EQ(one[i].viewId, named[i].viewId);
    EXPECT_TRUE(one[i].T_scene_model.matrix() == other[i].T_scene_model.matrix());
  }
}
