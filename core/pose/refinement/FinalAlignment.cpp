// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/FinalAlignment.h"

#include "pose/refinement/PoseResiduals.h"

#include <algorithm>
#include <limits>

namespace meam
{
namespace
{
// Shares of the diameter
constexpr double Window = 0.02;       // from a point of the part to edge points that count
constexpr double Across = 0.006;      // the same across its tangent, and along the normal of its surface
constexpr double Margin = 0.003;      // that a point moves by before its edge points are looked up again
constexpr double WidestFirst = 1.5;   // times Across in the first step
constexpr double LeastMotion = 3e-6;  // less is none: the pose stays
constexpr int Steps = 15;             // at most
constexpr int VisibilitySteps = 8;    // in the first ones the predicted visibility is looked up again
constexpr double Extrapolation = 5.0; // times its length that a step is taken farther, at most
constexpr double Farthest = 0.02;     // a pose that comes to stay farther from where it was has gone astray,
constexpr double MostTurned = 3.0;    // or turned by more degrees
constexpr double InPlace = 0.012;     // between corresponding points, for the fit of a pose that is not aligned

class FinalAlignment
{
public:
  FinalAlignment(const Scene& scene, const TrainedModel& model)
    : InScene(scene)
    , Model(model)
    , Fitter(scene, model)
  {
  }

  /// Steps with all points until the pose stays. False where the scene leaves it a freedom that is none of the part's
  /// symmetries.
  bool align(Pose& pose) const
  {
    const double diameter = this->Model.diameter;
    const double window = Window * diameter;
    const double margin = Margin * diameter;
    VisiblePart part;
    EdgeIndex::Neighbours neighbours;                           // of its edges
    double travelled = std::numeric_limits<double>::infinity(); // since they were looked up, at most
    NormalEquations::Result fit;
    Twist wanted, taken;      // in the step before
    bool isFollowing = false; // a step of the same kind
    double wide = WidestFirst;
    double stepLength = 0.0;
    int steps = 0;
    for (; steps < Steps && !(isFollowing && stepLength <= LeastMotion * diameter); ++steps)
    {
      if (steps < VisibilitySteps && this->Fitter.update(part, pose, 1))
      {
        isFollowing = false;
        travelled = std::numeric_limits<double>::infinity();
      }
      const double limit = wide * Across * diameter;
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
    return times > 0.0 ? Twist(foreseen * (std::min(times, Extrapolation) / times)) : step;
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
  PoseFitter Fitter;
};
}

Pose alignRobustly(const Pose& pose, const Scene& scene, const TrainedModel& model)
{
  const FinalAlignment alignment(scene, model);
  Pose aligned = pose;
  const bool isFixed = alignment.align(aligned);
  const bool isNear = rotationError(aligned.T_scene_model, pose.T_scene_model) < MostTurned &&
                      translationError(aligned.T_scene_model, pose.T_scene_model,
                        model.visibility->middle().cast<double>()) < Farthest * model.diameter;
  if (isFixed && isNear)
  {
    return aligned;
  }
  Pose same = pose;
  same.fit = fitInPlace(pose, pose.T_scene_model, scene, model);
  return same;
}

PoseFit fitInPlace(const Pose& pose, const Eigen::Isometry3d& T_aligned, const Scene& scene, const TrainedModel& model)
{
  const PoseFitter fitter(scene, model);
  PoseFit fit = fitter.fitAt(pose, InPlace * model.diameter);
  PoseFitter::Twist difference = fitter.twistOf(pose, T_aligned * pose.T_scene_model.inverse());
  difference.head<3>() /= 0.5 * model.diameter; // radians
  fit.covariance += difference * difference.transpose();
  return fit;
}
}
