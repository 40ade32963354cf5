// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/refinement/NormalEquations.h"

namespace meam
{
/// One Gauss-Newton step of a rigid motion and of the lengths along the part's three axes.
class SizeEquations
{
public:
  /// About `centre`, with the part's axes as the columns of `axes`.
  SizeEquations(const Eigen::Vector3d& centre, const Eigen::Matrix3d& axes)
    : Centre(centre)
    , Axes(axes)
  {
  }

  void add(const NormalEquations::Rows& rows)
  {
    for (int k = 0; k < rows.count; ++k)
    {
      const Eigen::Vector3d arm = Eigen::Vector3d(rows.x[k], rows.y[k], rows.z[k]) - this->Centre;
      const Eigen::Vector3d direction(rows.directionX[k], rows.directionY[k], rows.directionZ[k]);
      Vector row;
      row << arm.cross(direction), direction,
        (this->Axes.transpose() * arm).cwiseProduct(this->Axes.transpose() * direction);
      const double weight = rows.weight[k];
      this->Sums.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
      this->Right -= weight * rows.residual[k] * row;
    }
  }

  /// What is left for the lengths once the motion has done what it can.
  struct OfLengths
  {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
  };
  OfLengths ofLengths() const
  {
    const Eigen::Matrix<double, 3, 6> both = this->Sums.bottomLeftCorner<3, 6>();
    const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> motion = this->motion();
    const Eigen::Matrix3d lengths = this->Sums.bottomRightCorner<3, 3>().selfadjointView<Eigen::Lower>();
    return { lengths - both * motion.solve(both.transpose()),
      this->Right.tail<3>() - both * motion.solve(this->Right.head<6>()) };
  }

  /// The motion, to apply on the left, where the lengths change by `growth` (a share of each).
  Eigen::Isometry3d motionFor(const Eigen::Vector3d& growth) const
  {
    const Eigen::Matrix<double, 6, 1> twist =
      this->motion().solve(this->Right.head<6>() - this->Sums.bottomLeftCorner<3, 6>().transpose() * growth);
    const Eigen::Vector3d turn = twist.head<3>();
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    if (turn.norm() > 0.0)
    {
      motion.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    }
    motion.translation() = this->Centre + twist.tail<3>() - motion.linear() * this->Centre;
    return motion;
  }

private:
  using Vector = Eigen::Matrix<double, 9, 1>;
  static constexpr double Free = 1e-6; // added to the information of a motion that nothing fixes: it stays

  Eigen::LDLT<Eigen::Matrix<double, 6, 6>> motion() const
  {
    Eigen::Matrix<double, 6, 6> information = this->Sums.topLeftCorner<6, 6>().selfadjointView<Eigen::Lower>();
    information.diagonal() *= 1.0 + Free;
    information.diagonal().array() += Free;
    return information.ldlt();
  }

  Eigen::Vector3d Centre;
  Eigen::Matrix3d Axes;
  Eigen::Matrix<double, 9, 9> Sums = Eigen::Matrix<double, 9, 9>::Zero(); ///< the lower triangle
  Vector Right = Vector::Zero();
};
}
