// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/RefinementRestarts.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double SmallTurn = 10.0;   // degrees, beside half a turn
constexpr int Iterations = 6;        // what stays is aligned afterwards
constexpr double WorthTrying = 1e-3; // probability of a pose before: less, and it stays as it is;
constexpr double Sure = 0.9;         // more, and it is tried at half turns alone

PoseRefinementSettings settingsOfRestarts()
{
  PoseRefinementSettings settings;
  settings.iterations = Iterations;
  settings.fullLastStep = false; // some points tell which start is best; the final alignment takes all
  settings.threads = 1;          // poses are worked on in parallel
  return settings;
}

/// As columns.
Eigen::Matrix3d principalAxes(const Points& points, const Eigen::Vector3d& middle)
{
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& point : points)
  {
    const Eigen::Vector3d d = point.cast<double>() - middle;
    scatter += d * d.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors();
}
}

RefinementRestarts::RefinementRestarts(const Scene& scene, const TrainedModel& model, const PoseComparison& comparison,
  const RefinementRestartsSettings& settings)
  : InScene(scene)
  , Model(model)
  , Comparison(comparison)
  , Settings(settings)
  , Refinement(settingsOfRestarts())
{
  if (model.surface.empty())
  {
    return;
  }
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  const Eigen::Matrix3d axes = principalAxes(model.surface.points, middle);
  const Symmetries same = asIfRound(model.symmetries);
  std::vector<Eigen::Isometry3d> known{ Eigen::Isometry3d::Identity() };
  const auto add = [&](int axis, double degrees, std::vector<Eigen::Isometry3d>& turns)
  {
    const Eigen::Isometry3d turn = turnAbout(axes.col(axis), degrees * M_PI / 180.0, middle);
    const auto isKnown = [&](const Eigen::Isometry3d& other)
    { return rotationError(nearestEqual(turn, other, same), other) < 0.5 * SmallTurn; };
    if (std::none_of(known.begin(), known.end(), isKnown))
    {
      known.push_back(turn);
      turns.push_back(turn);
    }
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    if (settings.halfTurns)
    {
      add(axis, 180.0, this->HalfTurns);
    }
    if (settings.smallTurns)
    {
      add(axis, -SmallTurn, this->SmallTurns);
      add(axis, SmallTurn, this->SmallTurns);
    }
  }
}

Pose RefinementRestarts::best(const Pose& pose, PoseComparison::Contender& asItIs) const
{
  Pose best = pose;
  if (claimOf(pose, false) < WorthTrying)
  {
    return best;
  }
  const auto tryFrom = [&](const Eigen::Isometry3d& T_scene_model)
  {
    Pose other = pose;
    other.T_scene_model = T_scene_model;
    other = refinePoses({ other }, this->InScene, this->Model, this->Refinement)[0];
    if (this->Comparison.advantage(other.T_scene_model, asItIs, 0.0) > 0.0)
    {
      best = other;
      asItIs = this->Comparison.contender(best.T_scene_model);
    }
  };
  const double hopeless = -asItIs.explained;
  for (const Eigen::Isometry3d& turn : this->HalfTurns)
  {
    const Eigen::Isometry3d turned = pose.T_scene_model * turn;
    if (this->Comparison.advantage(turned, asItIs, hopeless) > hopeless)
    {
      tryFrom(turned);
    }
  }
  for (const Eigen::Isometry3d& turn : this->SmallTurns)
  {
    if (claimOf(pose, false) < Sure)
    {
      tryFrom(pose.T_scene_model * turn);
    }
  }
  return best;
}
}
