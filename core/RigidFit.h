// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace meam
{
/// One Gauss-Newton step of a rigid motion: collects residuals along given directions and returns the
/// small motion about `centre` that reduces them.
class RigidFit
{
public:
  explicit RigidFit(const Eigen::Vector3d& centre)
    : Centre(centre)
  {
  }

  /// A point that is off by `residual` (mm) along the unit `direction`.
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double residual, double weight = 1.0)
  {
    Eigen::Matrix<double, 6, 1> row;
    row << (point - this->Centre).cross(direction), direction;
    this->A += weight * row * row.transpose();
    this->b -= weight * residual * row;
    this->Weights += weight;
    this->Squares += weight * residual * residual;
  }

  /// Of the motion (rotation vector, translation): the inverse of its covariance for residuals of variance 1.
  const Eigen::Matrix<double, 6, 6>& information() const { return this->A; }
  double weights() const { return this->Weights; }
  /// Sum of the squared residuals, weighted.
  double squares() const { return this->Squares; }

  /// The motion to apply on the left; the identity when nothing can be said.
  Eigen::Isometry3d motion() const
  {
    // A little damping keeps what the residuals do not fix where it is.
    const double damping = 1e-6 * this->A.diagonal().maxCoeff();
    const Eigen::Matrix<double, 6, 1> twist =
      (this->A + damping * Eigen::Matrix<double, 6, 6>::Identity()).ldlt().solve(this->b);
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    if (twist.allFinite())
    {
      const double angle = twist.head<3>().norm();
      if (angle > 0.0)
      {
        move.linear() = Eigen::AngleAxisd(angle, twist.head<3>() / angle).toRotationMatrix();
      }
      move.translation() = this->Centre + twist.tail<3>() - move.linear() * this->Centre;
    }
    return move;
  }

private:
  Eigen::Vector3d Centre;
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
  double Weights = 0.0;
  double Squares = 0.0;
};
}
