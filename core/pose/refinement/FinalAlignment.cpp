// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/FinalAlignment.h"

#include "pose/refinement/PoseResiduals.h"

#include <algorithm>
#include <limits>

namespace meam
{
namespace
{
class FinalAlignment
{
public:
  FinalAlignment(const Scene& scene, const TrainedModel& model, const FinalAlignmentSettings& settings)
    : InScene(scene)
    , Model(model)
    , Settings(settings)
    , Fitter(scene, model, settings.fitter)
  {
  }

  /// Steps with all points until the pose stays. False where the scene leaves it a freedom that is none of the part's
  /// symmetries.
  bool align(Pose& pose) const
  {
    const double diameter = this->Model.diameter;
    const double window = this->Settings.window * diameter;
    const double margin = this->Settings.margin * diameter;
    VisiblePart part;
    EdgeIndex::Neighbours neighbours;                           // of its edges
    double travelled = std::numeric_limits<double>::infinity(); // since they were looked up, at most
    NormalEquations::Result fit;
    Twist wanted, taken;      // in the step before
    bool isFollowing = false; // a step of the same kind
    double wide = this->Settings.widestFirst;
    double stepLength = 0.0;
    int steps = 0;
    for (; steps < this->Settings.steps && !(isFollowing && stepLength <= this->Settings.leastMotion * diameter);
         ++steps)
    {
      if (steps < this->Settings.visibilitySteps && this->Fitter.update(part, pose, 1))
      {
        isFollowing = false;
        travelled = std::numeric_limits<double>::infinity();
      }
      const double limit = wide * this->Settings.across * diameter;
      const Eigen::Isometry3d T = pose.T_scene_model;
      const Eigen::Isometry3f Tf = T.cast<float>();
      const SoAOrientedPoints edges = moved(part.edges, Tf);
      if (travelled > margin)
      {
        neighbours = this->InScene.edgeIndex.neighbours(edges, window, limit, margin);
        travelled = 0.0;
      }
      const EdgeIndex::Means means = EdgeIndex::meansAround(neighbours, edges, window, limit);
      fit = this->steadyFit(T, edges, means, moved(part.surface, Tf), limit);
      Twist step = this->Fitter.twistOf(pose, fit.motion);
      for (const ContinuousSymmetry& symmetry : this->Model.symmetries.continuous)
      {
        const Eigen::Vector3d axis = pose.T_scene_model.linear() * symmetry.axis; // turns about it are all the same
        step.head<3>() -= axis.dot(step.head<3>()) * axis;
      }
      const Twist farther = isFollowing ? this->extrapolated(step, wanted, taken) : step;
      stepLength = farther.head<3>().norm() + farther.tail<3>().norm();
      travelled += 2.0 * farther.head<3>().norm() + farther.tail<3>().norm(); // a diameter from the middle
      wanted = step;
      taken = farther;
      isFollowing = wide == 1.0;
      wide = 1.0;
      pose.T_scene_model = this->Fitter.motionOf(pose, farther) * T;
    }
    pose.fit = this->Fitter.poseFit(pose, fit, fit.remaining, pose.fit.iterations + steps);
    return this->Fitter.isFixed(fit);
  }

private:
  using Twist = PoseFitter::Twist;

  /// Steps shrink by a nearly constant share, for the weights follow the pose: the secant foresees all that are left
  /// (Aitken's delta-squared process). `wanted` and `taken` are those of the step before.
  Twist extrapolated(const Twist& step, const Twist& wanted, const Twist& taken) const
  {
    const Twist change = step - wanted;
    const double share = change.dot(step) / change.squaredNorm();
    const Twist foreseen = step - share * (taken + change);
    const double times = foreseen.norm() / step.norm();
    return times > 0.0 ? Twist(foreseen * (std::min(times, this->Settings.extrapolation) / times)) : step;
  }

  /// Residuals that change steadily with the pose, so that it comes to stay in one place: against the mean of the edge
  /// points about each edge, and against the surface up to `limit` (mm).
  NormalEquations::Result steadyFit(const Eigen::Isometry3d& T, const SoAOrientedPoints& edges, EdgeIndex::Means means,
    const SoAOrientedPoints& surface, double limit) const
  {
    for (float& weight : means.weights)
    {
      weight = std::min(weight, 1.0f);
    }
    NormalEquations fit(this->Fitter.middle(T));
    addLineResiduals(fit, edges, means.offsets, means.weights);
    constexpr float anyDistance = std::numeric_limits<float>::infinity();
    addSurfaceResiduals(fit, this->InScene.depth, surface, { static_cast<float>(limit), anyDistance, true });
    return fit.result();
  }

  const Scene& InScene;
  const TrainedModel& Model;
  const FinalAlignmentSettings& Settings;
  PoseFitter Fitter;
};
}

Pose alignRobustly(
  const Pose& pose, const Scene& scene, const TrainedModel& model, const FinalAlignmentSettings& settings)
{
  const FinalAlignment alignment(scene, model, settings);
  Pose aligned = pose;
  const bool isFixed = alignment.align(aligned);
  const bool isNear = rotationError(aligned.T_scene_model, pose.T_scene_model) < settings.mostTurned &&
                      translationError(aligned.T_scene_model, pose.T_scene_model,
                        model.visibility->middle().cast<double>()) < settings.farthest * model.diameter;
  if (isFixed && isNear)
  {
    return aligned;
  }
  Pose same = pose;
  same.fit = fitInPlace(pose, pose.T_scene_model, scene, model, settings);
  return same;
}

PoseFit fitInPlace(const Pose& pose, const Eigen::Isometry3d& T_aligned, const Scene& scene, const TrainedModel& model,
  const FinalAlignmentSettings& settings)
{
  const PoseFitter fitter(scene, model, settings.fitter);
  PoseFit fit = fitter.fitAt(pose, settings.fitDistance * model.diameter);
  PoseFitter::Twist difference = fitter.twistOf(pose, T_aligned * pose.T_scene_model.inverse());
  difference.head<3>() /= 0.5 * model.diameter; // radians
  fit.covariance += difference * difference.transpose();
  return fit;
}
}
