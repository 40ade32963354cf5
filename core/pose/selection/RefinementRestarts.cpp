// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/RefinementRestarts.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace meam
{
namespace
{
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
  , WorthTrying(settings.worthTrying)
{
  this->Refinement.maximumDistance = settings.distanceShare * model.diameter;
  this->Refinement.iterations = settings.iterations;
  this->Refinement.threads = 1; // poses are worked on in parallel
  if (model.surface.empty())
  {
    return;
  }
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  const Eigen::Matrix3d axes = principalAxes(model.surface.points, middle);
  Symmetries exact = model.symmetries;
  exact.near.clear();
  const Eigen::Isometry3d asItIs = Eigen::Isometry3d::Identity();
  for (int k = 0; k < 3; ++k)
  {
    for (const double degrees : { 180.0, -settings.turn, settings.turn })
    {
      const Eigen::Isometry3d turn = turnAbout(axes.col(k), degrees * M_PI / 180.0, middle);
      if (rotationError(nearestEqual(turn, asItIs, exact), asItIs) > 0.5 * settings.turn)
      {
        this->Turns.push_back(turn);
      }
    }
  }
}

Pose RefinementRestarts::best(const Pose& pose, PoseComparison::Contender& asItIs) const
{
  Pose best = pose;
  if (pose.probability < this->WorthTrying)
  {
    return best;
  }
  for (const Eigen::Isometry3d& turn : this->Turns)
  {
    Pose other = pose;
    other.T_scene_model = pose.T_scene_model * turn;
    other = refinePoses({ other }, this->InScene, this->Model, this->Refinement)[0];
    if (this->Comparison.advantage(other.T_scene_model, asItIs, 0.0) > 0.0)
    {
      best = other;
      asItIs = this->Comparison.contender(best.T_scene_model);
    }
  }
  return best;
}
}
