// SPDX-License-Identifier: BSD-3-Clause
#include "features/PairFeature.h"

namespace meam
{
Eigen::Isometry3d alignFrames(const PairFrame& model, const PairFrame& scene, bool flip, double alpha)
{
  // A half turn about y reverses the tangent (x) and the sense of angles about it: beta becomes -beta.
  const Eigen::Matrix3d turn =
    flip ? Eigen::Vector3d(-1.0, 1.0, -1.0).asDiagonal().toDenseMatrix() : Eigen::Matrix3d::Identity().eval();
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  const Eigen::Matrix3d rotation = scene.Axes.cast<double>() *
                                   Eigen::AngleAxisd(alpha, Eigen::Vector3d::UnitX()).toRotationMatrix() * turn *
                                   model.Axes.cast<double>().transpose();
  // Axes are at right angles in single precision only.
  T_scene_model.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  T_scene_model.translation() = scene.Origin.cast<double>() - T_scene_model.linear() * model.Origin.cast<double>();
  return T_scene_model;
}
}
