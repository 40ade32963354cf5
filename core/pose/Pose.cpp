// SPDX-License-Identifier: BSD-3-Clause
#include "pose/Pose.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meam
{
namespace
{
bool isRatherThere(const Pose& pose) { return placeOrScore(pose) >= 0.5; }

/// The methods that the paper compares itself with give scores alone.
bool haveProbabilities(const Poses& poses)
{
  return std::any_of(poses.begin(), poses.end(), [](const Pose& pose) { return claimOf(pose, false) > 0.0; });
}

/// Of poses that these symmetries make equal the one that is turned least.
Eigen::Isometry3d leastTurned(const Eigen::Isometry3d& T, const Symmetries& symmetries)
{
  return nearestEqual(T, Eigen::Isometry3d::Identity(), symmetries);
}

Pose leastTurned(Pose pose, const Symmetries& symmetries)
{
  pose.T_scene_model = leastTurned(pose.T_scene_model, symmetries);
  for (RotationAlternative& alternative : pose.alternatives)
  {
    alternative.T_scene_model = leastTurned(alternative.T_scene_model, symmetries);
  }
  return pose;
}
}

Pose moved(const Pose& pose, const Eigen::Isometry3d& motion)
{
  Pose result = pose;
  result.T_scene_model = motion * pose.T_scene_model;
  for (RotationAlternative& alternative : result.alternatives)
  {
    alternative.T_scene_model = motion * alternative.T_scene_model;
  }
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = motion.linear();
  turn.bottomRightCorner<3, 3>() = motion.linear();
  result.fit.covariance = turn * pose.fit.covariance * turn.transpose();
  return result;
}

Poses toLocalFrame(const Poses& poses, const Eigen::Isometry3d& T_local_scene, const Symmetries& symmetries)
{
  Poses result;
  for (const Pose& pose : poses)
  {
    if (!pose.T_scene_model.matrix().allFinite())
    {
      throw Error("Pose " + std::to_string(result.size() + 1) + " has numbers that are not finite.");
    }
    result.push_back(leastTurned(moved(pose, T_local_scene), symmetries));
  }
  return result;
}

Poses toSceneFrame(const Poses& poses, const Eigen::Isometry3d& T_local_scene, const Symmetries& symmetries)
{
  return mapped<Pose>(
    poses, [&](const Pose& pose) { return leastTurned(moved(pose, T_local_scene.inverse()), symmetries); });
}

std::string describe(const Poses& poses)
{
  if (poses.empty())
  {
    return "No part was found.";
  }
  const std::string all = std::to_string(poses.size()) + (poses.size() == 1 ? " pose" : " poses");
  if (!haveProbabilities(poses))
  {
    return all + " came out; the method does not tell how likely a copy is there.";
  }
  const auto count = std::count_if(poses.begin(), poses.end(), isRatherThere);
  const std::string of = " of " + all;
  if (count > 0)
  {
    return std::to_string(count) + of + (count == 1 ? " is" : " are") + " more likely there than not.";
  }
  const auto best = std::max_element(
    poses.begin(), poses.end(), [](const Pose& a, const Pose& b) { return placeOrScore(a) < placeOrScore(b); });
  return "Nothing sure was found: the likeliest" + of + " is there with a probability of " +
         std::to_string(std::lround(100.0 * placeOrScore(*best))) + " %.";
}

std::string doubtsOf(const Poses& poses)
{
  const bool haveScoresAlone = !poses.empty() && !haveProbabilities(poses);
  return haveScoresAlone || std::any_of(poses.begin(), poses.end(), isRatherThere) ? std::string() : describe(poses);
}

std::string cutShort(double timeLimit)
{
  std::ostringstream words;
  words << "The time limit of " << timeLimit << " s struck: these are the best poses that were found until then. Raise "
        << "it (TimeLimit), ask for fewer poses, or scan with fewer points.";
  return words.str();
}

Eigen::Affine3d uncertaintyEllipsoid(const Pose& pose, const Eigen::Vector3d& middle, double deviations)
{
  const Eigen::Matrix3d covariance = pose.fit.covariance.bottomRightCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  Eigen::Affine3d ellipsoid;
  ellipsoid.linear() = deviations * axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  ellipsoid.translation() = pose.T_scene_model * middle;
  return ellipsoid;
}

double rotationError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle() * 180.0 / M_PI;
}

double translationError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const Eigen::Vector3d& point)
{
  return (a * point - b * point).norm();
}
}
