// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace meam
{
/// One Gauss-Newton step of a rigid motion: collects residuals along given directions and returns the
/// small motion about `centre` that reduces them.
class NormalEquations
{
public:
  explicit NormalEquations(const Eigen::Vector3d& centre)
    : Centre(centre)
  {
  }

  /// A point that is off by `residual` (mm) along the unit `direction`.
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double residual, double weight = 1.0)
  {
    const Eigen::Vector3d turn = (point - this->Centre).cross(direction);
    const double values[Values] = { turn.x(), turn.y(), turn.z(), direction.x(), direction.y(), direction.z(), residual,
      weight };
    for (int i = 0; i < Values; ++i)
    {
      this->Waiting[i][this->Filled] = values[i];
    }
    if (++this->Filled == Lanes)
    {
      this->sum();
    }
  }

  /// Points with their directions, residuals and weights, column by column; what is beyond `count` is room.
  struct Rows
  {
    static constexpr int Most = SoABlock;
    int count = 0;
    float x[Most], y[Most], z[Most];
    float directionX[Most], directionY[Most], directionZ[Most];
    float residual[Most];
    float weight[Most];
  };
  /// The same as adding one by one.
  void add(const Rows& rows);

  /// What the residuals say.
  struct Result
  {
    /// Of the motion (rotation vector, translation): the inverse of its covariance for residuals of variance 1.
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Isometry3d motion =
      Eigen::Isometry3d::Identity(); ///< to apply on the left; the identity when nothing can be said
    double weights = 0.0;            ///< their sum
    double squares = 0.0;            ///< sum of the squared residuals, weighted
    double remaining = 0.0;          ///< the same after the motion, to first order
  };
  Result result();

private:
  static constexpr int Lanes = 8;         // residuals that are summed at once
  static constexpr int Values = 8;        // of a residual: its row of the Jacobian, itself, its weight
  static constexpr int Sums = 21 + 6 + 2; // lower triangle of the information, right side, squares, weights

  void sum();

  Eigen::Vector3d Centre;
  int Filled = 0;
  double Waiting[Values][Lanes];
  double Summed[Sums][Lanes] = {};
};
}
