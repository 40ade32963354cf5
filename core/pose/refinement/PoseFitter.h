// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "pose/refinement/NormalEquations.h"
#include "scene/Scene.h"

#include <Eigen/Eigenvalues>

#include <memory>

namespace meam
{
/// What of the part the sensor should see at a pose, in the part's frame.
struct VisiblePart
{
  std::shared_ptr<const PredictedVisibility::Visible> visible;
  SoAOrientedPoints edges;   ///< with tangents
  SoAOrientedPoints surface; ///< with normals
};

/// What the steps of refinement share: visible points, correspondences, small motions, and how well a pose is fixed.
/// Keeps references; calls may run in parallel.
class PoseFitter
{
public:
  PoseFitter(const Scene& scene, const TrainedModel& model);

  static constexpr int FewestCorrespondences = 4; ///< fewer fix no pose

  /// Looks up every `stride`-th visible point of each kind at a pose; false when the direction to the sensor is the
  /// same as before.
  bool update(VisiblePart& part, const Pose& pose, int stride) const;

  /// Normal equations of all that something in the scene within `limit` (mm) corresponds to.
  NormalEquations::Result correspondences(
    const Eigen::Isometry3d& T_scene_model, const VisiblePart& part, double limit) const;

  /// How well the scene fixes a pose that stays where it is, by all that corresponds within `limit` (mm).
  PoseFit fitAt(const Pose& pose, double limit) const;
  /// What the last step says; `squares` are those of its residuals at the pose.
  PoseFit poseFit(const Pose& pose, const NormalEquations::Result& fit, double squares, int iterations) const;
  /// Whether something of the scene speaks for every motion but the part's continuous symmetries.
  bool isFixed(const NormalEquations::Result& fit) const;

  /// A small motion of a pose about its middle: the rotation vector, as what it moves half a diameter from there, and
  /// the translation, both in mm.
  using Twist = Eigen::Matrix<double, 6, 1>;
  Twist twistOf(const Pose& pose, const Eigen::Isometry3d& motion) const;
  Eigen::Isometry3d motionOf(const Pose& pose, const Twist& twist) const;
  /// Middle of the part at a pose, mm.
  Eigen::Vector3d middle(const Eigen::Isometry3d& T_scene_model) const;

private:
  Eigen::Matrix<double, 6, 1> scale() const;
  using Modes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>;
  Modes modes(const NormalEquations::Result& fit) const;

  const Scene& InScene;
  const TrainedModel& Model;
};

/// Tukey's weight: 1 at 0, 0 from the limit on.
inline double tukeyWeight(double squared, double limit)
{
  const double u = squared / (limit * limit);
  return u < 1.0 ? (1.0 - u) * (1.0 - u) : 0.0;
}
}
