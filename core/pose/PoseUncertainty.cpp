// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseUncertainty.h"

#include <Eigen/Eigenvalues>

namespace meam
{
Eigen::Affine3d uncertaintyEllipsoid(const Pose& pose, const Eigen::Vector3d& middle, double deviations)
{
  const Eigen::Matrix3d covariance = pose.fit.covariance.bottomRightCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  Eigen::Affine3d ellipsoid;
  ellipsoid.linear() = deviations * axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  ellipsoid.translation() = pose.T_scene_model * middle;
  return ellipsoid;
}
}
