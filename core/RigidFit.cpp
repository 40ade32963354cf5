// SPDX-License-Identifier: BSD-3-Clause
#include "RigidFit.h"

#include "AllVectors.h"

#include <algorithm>
#include <numeric>

namespace meam
{
namespace
{
/// rows: six of the Jacobian, residuals, weights.
template <int Lanes>
MEAM_ALL_VECTORS void addProducts(const double (*rows)[Lanes], double (*sums)[Lanes])
{
  const double* residuals = rows[6];
  const double* weights = rows[7];
  double weighted[Lanes];
  for (int i = 0; i < 6; ++i)
  {
#pragma omp simd
    for (int k = 0; k < Lanes; ++k)
    {
      weighted[k] = weights[k] * rows[i][k];
    }
    for (int j = 0; j <= i; ++j, ++sums)
    {
#pragma omp simd
      for (int k = 0; k < Lanes; ++k)
      {
        sums[0][k] += weighted[k] * rows[j][k];
      }
    }
#pragma omp simd
    for (int k = 0; k < Lanes; ++k)
    {
      sums[0][k] -= weighted[k] * residuals[k];
    }
    ++sums;
  }
#pragma omp simd
  for (int k = 0; k < Lanes; ++k)
  {
    sums[0][k] += weights[k] * residuals[k] * residuals[k];
    sums[1][k] += weights[k];
  }
}
}

void RigidFit::sum()
{
  addProducts(this->Waiting, this->Summed);
  this->Filled = 0;
}

RigidFit::Result RigidFit::result()
{
  while (this->Filled > 0)
  {
    this->add(this->Centre, Eigen::Vector3d::Zero(), 0.0, 0.0);
  }
  const double(*sums)[Lanes] = this->Summed;
  const auto next = [&sums]()
  {
    const double* lanes = *sums++;
    return std::accumulate(lanes, lanes + Lanes, 0.0);
  };
  Result result;
  Eigen::Matrix<double, 6, 1> right;
  for (int i = 0; i < 6; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      result.information(i, j) = result.information(j, i) = next();
    }
    right[i] = next();
  }
  result.squares = next();
  result.weights = next();
  // A little damping keeps what the residuals do not fix where it is.
  const double damping = 1e-6 * result.information.diagonal().maxCoeff();
  const Eigen::Matrix<double, 6, 1> twist =
    (result.information + damping * Eigen::Matrix<double, 6, 6>::Identity()).ldlt().solve(right);
  result.motion.setIdentity();
  result.remaining = result.squares;
  if (twist.allFinite())
  {
    result.remaining += twist.dot(result.information * twist - 2.0 * right);
    result.remaining = std::max(result.remaining, 0.0); // of what rounding leaves
    const double angle = twist.head<3>().norm();
    if (angle > 0.0)
    {
      result.motion.linear() = Eigen::AngleAxisd(angle, twist.head<3>() / angle).toRotationMatrix();
    }
    result.motion.translation() = this->Centre + twist.tail<3>() - result.motion.linear() * this->Centre;
  }
  return result;
}
}
