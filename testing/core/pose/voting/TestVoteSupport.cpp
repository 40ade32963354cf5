// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/VoteSupport.h"

#include "TestScene.h"
#include "pose/PoseTolerances.h"

#include <numeric>

namespace
{
/// Quarter turns map it onto itself.
meam::TriangleMesh square() { return parts::box({ -20, -20, 0 }, { 20, 20, 12 }); }

std::vector<meam::PointVotes> votesOf(const meam::TrainedModel& model, const meam::Scene& scene,
  const Eigen::Isometry3d& T_scene_model, meam::Features features = meam::Features::Both)
{
  meam::PoseDetectionSettings detection;
  detection.features = features;
  return meam::votesForPose(scene.T_local_scene() * T_scene_model, scene, model, detection);
}

int electing(const std::vector<meam::PointVotes>& votes)
{
  return static_cast<int>(
    std::count_if(votes.begin(), votes.end(), [](const meam::PointVotes& point) { return point.rank == 1; }));
}
}

TEST(VoteSupport, PointsThatElectAPoseAreItsCandidates)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::TrainedModel& model = scenes::bracket();
  const meam::PoseDetectionSettings detection = scenes::withShare(1.0);
  const meam::Poses candidates = meam::detectPoses(scene, model, detection);
  for (const Eigen::Isometry3d& T : scenes::threeCopies())
  {
    const Eigen::Isometry3d place = scene.T_local_scene() * T;
    const auto votes = meam::votesForPose(place, scene, model, detection);
    const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
    const auto leading = std::count_if(candidates.begin(), candidates.end(),
      [&](const meam::Pose& pose)
      {
        return meam::translationError(pose.T_scene_model, place, middle) < meam::SamePoseDistance * model.diameter &&
               meam::rotationError(pose.T_scene_model, place) < meam::SamePoseAngle;
      });
    EXPECT_GT(electing(votes), 20);
    EXPECT_LE(electing(votes), leading);
    EXPECT_GE(electing(votes), 0.9 * leading); // some lie a little beside the part
    for (const meam::PointVotes& point : votes)
    {
      EXPECT_TRUE(point.isReference);
      EXPECT_LE(point.votes, point.most);
      EXPECT_TRUE(point.rank != 1 || point.votes == point.most);
    }
  }
}

TEST(VoteSupport, ReferencePointsAreThoseOfDetection)
{
  const meam::Scene scene = scenes::alone(parts::lBracket(), scenes::bracket(), scenes::lying(0, 0, 20));
  meam::PoseDetectionSettings detection;
  detection.features = meam::Features::Edges;
  const Eigen::Isometry3d T = scene.T_local_scene() * scenes::lying(0, 0, 20);
  for (const double share : { 0.2, 1.0 })
  {
    detection.referenceShare = share;
    const auto votes = meam::votesForPose(T, scene, scenes::bracket(), detection);
    const auto references = std::count_if(
      votes.begin(), votes.end(), [](const meam::PointVotes& point) { return point.isReference && point.byEdges; });
    const int candidates = static_cast<int>(meam::detectPoses(scene, scenes::bracket(), detection).size());
    EXPECT_LE(references, candidates);
    EXPECT_GE(references, 0.8 * candidates); // nothing but the part is there
  }
}

TEST(VoteSupport, AnEqualPoseHasTheSameVotes)
{
  const meam::TrainedModel& model = scenes::trained<square>();
  ASSERT_FALSE(model.symmetries.discrete.empty());
  const Eigen::Isometry3d T = scenes::lying(0, 0, 10);
  const meam::Scene scene = scenes::alone(square(), model, T);
  const auto votes = votesOf(model, scene, T);
  const auto turned = votesOf(model, scene, T * Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ()));
  EXPECT_GT(electing(votes), static_cast<int>(votes.size()) / 3);
  const auto sum = [](const std::vector<meam::PointVotes>& of) {
    return std::accumulate(of.begin(), of.end(), 0, [](int all, const meam::PointVotes& p) { return all + p.votes; });
  };
  EXPECT_NEAR(sum(turned), sum(votes), 0.02 * sum(votes));
  EXPECT_NEAR(electing(turned), electing(votes), 2);
}

TEST(VoteSupport, NothingVotesWhereNothingIs)
{
  const meam::Scene scene = scenes::alone(parts::lBracket(), scenes::bracket(), scenes::lying(0, 0, 20));
  EXPECT_TRUE(votesOf(scenes::bracket(), scene, scenes::lying(300, 0, 20)).empty());
  EXPECT_EQ(electing(votesOf(scenes::bracket(), scene, scenes::lying(0, 0, 110))), 0); // turned away
}
