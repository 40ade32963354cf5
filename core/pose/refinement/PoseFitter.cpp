// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseFitter.h"

#include "pose/refinement/PoseResiduals.h"

#include <cmath>

namespace meam
{
namespace
{
// Shares of what corresponds that have to speak for a motion
constexpr double ConstrainedShare = 0.01; // so that it counts as fixed
constexpr double FreeShare = 0.001;       // up to which it is a freedom, in which a pose would drift
constexpr double LeastShare = 1e-6;       // taken for the variance of one that nothing fixes
}

PoseFitter::PoseFitter(const Scene& scene, const TrainedModel& model)
  : InScene(scene)
  , Model(model)
{
}

/// Rotations count as what they move half a diameter from the middle, so all six are lengths.
Eigen::Matrix<double, 6, 1> PoseFitter::scale() const
{
  Eigen::Matrix<double, 6, 1> scale = Eigen::Matrix<double, 6, 1>::Ones();
  scale.head<3>().setConstant(2.0 / this->Model.diameter);
  return scale;
}

/// Independent motions, and the share of what corresponds that speaks for each.
PoseFitter::Modes PoseFitter::modes(const NormalEquations::Result& fit) const
{
  const Eigen::Matrix<double, 6, 1> scale = this->scale();
  return Modes(scale.asDiagonal() * fit.information * scale.asDiagonal() / fit.weights);
}

bool PoseFitter::isFixed(const NormalEquations::Result& fit) const
{
  const std::ptrdiff_t axes = this->Model.symmetries.continuous.size(); // turns about them are free, and equal
  return fit.weights >= FewestCorrespondences &&
         (this->modes(fit).eigenvalues().array() > FreeShare).count() >= 6 - axes;
}

PoseFit PoseFitter::poseFit(const Pose& pose, const NormalEquations::Result& fit, double squares, int iterations) const
{
  PoseFit result;
  result.iterations = iterations;
  const Eigen::Matrix<double, 6, 1> scale = this->scale();
  if (fit.weights < FewestCorrespondences)
  {
    result.covariance.diagonal() = (0.5 * this->Model.diameter * scale).array().square();
    return result;
  }
  result.residual = std::sqrt(squares / fit.weights);
  const Modes modes = this->modes(fit);
  const auto& values = modes.eigenvalues();
  const Eigen::Matrix3d axes = pose.T_scene_model.linear();
  for (int k = 0; k < 6; ++k)
  {
    if (values[k] > ConstrainedShare)
    {
      const Eigen::Matrix<double, 6, 1> mode = modes.eigenvectors().col(k);
      result.constrainedAxes.head<3>() += (axes.transpose() * mode.head<3>()).cwiseAbs2();
      result.constrainedAxes.tail<3>() += (axes.transpose() * mode.tail<3>()).cwiseAbs2();
      ++result.constrained;
    }
  }
  const Eigen::Matrix<double, 6, 1> variances =
    result.residual * result.residual / fit.weights * values.array().max(LeastShare).inverse();
  result.covariance = scale.asDiagonal() * modes.eigenvectors() * variances.asDiagonal() *
                      modes.eigenvectors().transpose() * scale.asDiagonal();
  return result;
}

PoseFit PoseFitter::fitAt(const Pose& pose, double limit) const
{
  VisiblePart part;
  this->update(part, pose, 1);
  const NormalEquations::Result fit = this->correspondences(pose.T_scene_model, part, limit);
  return this->poseFit(pose, fit, fit.squares, pose.fit.iterations);
}

bool PoseFitter::update(VisiblePart& part, const Pose& pose, int stride) const
{
  const auto visible =
    this->Model.visibility->visible(pose.T_scene_model, this->InScene.sensor, this->InScene.depth.pitch());
  if (part.visible && visible->from == part.visible->from)
  {
    return false;
  }
  part.visible = visible;
  const PointCloud& surface = this->Model.surface;
  const std::size_t step = stride;
  part.edges.resize((visible->edges.size() + step - 1) / step);
  for (std::size_t k = 0; k < part.edges.size(); ++k)
  {
    part.edges.set(k, visible->edges.points[k * step], visible->edges.directions[k * step]);
  }
  part.surface.resize((visible->surface.size() + step - 1) / step);
  for (std::size_t k = 0; k < part.surface.size(); ++k)
  {
    const int i = visible->surface[k * step];
    part.surface.set(k, surface.points[i], surface.normals[i]);
  }
  return true;
}

PoseFitter::Twist PoseFitter::twistOf(const Pose& pose, const Eigen::Isometry3d& motion) const
{
  const Eigen::Vector3d middle = this->middle(pose.T_scene_model);
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(motion.linear()));
  Twist twist;
  twist << 0.5 * this->Model.diameter * turn.angle() * turn.axis(), motion * middle - middle;
  return twist;
}

Eigen::Isometry3d PoseFitter::motionOf(const Pose& pose, const Twist& twist) const
{
  const Eigen::Vector3d middle = this->middle(pose.T_scene_model);
  const Eigen::Vector3d rotation = twist.head<3>() / (0.5 * this->Model.diameter);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (rotation.norm() > 0.0)
  {
    motion.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
  }
  motion.translation() = middle + twist.tail<3>() - motion.linear() * middle;
  return motion;
}

Eigen::Vector3d PoseFitter::middle(const Eigen::Isometry3d& T_scene_model) const
{
  return T_scene_model * this->Model.visibility->middle().cast<double>();
}

NormalEquations::Result PoseFitter::correspondences(
  const Eigen::Isometry3d& T, const VisiblePart& part, double limit) const
{
  const PointCloud& scene = this->InScene.edgePoints();
  const Eigen::Isometry3f Tf = T.cast<float>();
  const SoAOrientedPoints edges = moved(part.edges, Tf);
  SoAOrientedPoints lines;
  SoAPoints offsets;
  std::vector<float> weights;
  lines.resize(edges.size());
  offsets.resize(edges.size());
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    // Distance to the scene's tangent line, which counts, not to the point on it.
    const Eigen::Vector3f point = edges.points[k];
    const EdgeIndex::Match match = this->InScene.edgeIndex.nearest(point, edges.directions[k], limit);
    if (match.edge >= 0)
    {
      lines.set(weights.size(), point, scene.tangents[match.edge]);
      offsets.set(weights.size(), point - scene.points[match.edge]);
      weights.push_back(static_cast<float>(tukeyWeight(match.squaredDistance, limit)));
    }
  }
  lines.resize(weights.size());
  NormalEquations fit(this->middle(T));
  addLineResiduals(fit, lines, offsets, weights);
  const float farthest = static_cast<float>(std::hypot(limit, this->InScene.depth.cellSize()));
  addSurfaceResiduals(
    fit, this->InScene.depth, moved(part.surface, Tf), { static_cast<float>(limit), farthest, false });
  return fit.result();
}
}
