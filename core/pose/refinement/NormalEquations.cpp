// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/NormalEquations.h"

#include "base/AllVectors.h"

#include <algorithm>
#include <numeric>

namespace meam
{
namespace
{
/// Several rows from `begin` on, as addProducts takes them.
template <int Lanes>
inline __attribute__((always_inline)) void widen(
  const NormalEquations::Rows& from, const double* centre, int begin, double (*rows)[Lanes])
{
#pragma omp simd
  for (int k = 0; k < Lanes; ++k)
  {
    const int i = begin + k;
    const double x = from.x[i] - centre[0], y = from.y[i] - centre[1], z = from.z[i] - centre[2];
    const double u = from.directionX[i], v = from.directionY[i], w = from.directionZ[i];
    rows[0][k] = y * w - z * v;
    rows[1][k] = z * u - x * w;
    rows[2][k] = x * v - y * u;
    rows[3][k] = u;
    rows[4][k] = v;
    rows[5][k] = w;
    rows[6][k] = from.residual[i];
    rows[7][k] = from.weight[i];
  }
}

/// rows: six of the Jacobian, residuals, weights.
template <int Lanes>
inline __attribute__((always_inline)) void addProducts(const double (*rows)[Lanes], double (*sums)[Lanes])
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

template <int Lanes>
MEAM_ALL_VECTORS void addRows(const double (*rows)[Lanes], double (*sums)[Lanes])
{
  addProducts<Lanes>(rows, sums);
}

/// `count` is a multiple of `Lanes`.
template <int Lanes>
MEAM_ALL_VECTORS void addAll(const NormalEquations::Rows& from, int count, const double* centre, double (*sums)[Lanes])
{
  double rows[8][Lanes];
  for (int begin = 0; begin < count; begin += Lanes)
  {
    widen<Lanes>(from, centre, begin, rows);
    addProducts<Lanes>(rows, sums);
  }
}
}

void NormalEquations::add(const Rows& rows)
{
  const int whole = rows.count / Lanes * Lanes;
  addAll<Lanes>(rows, whole, this->Centre.data(), this->Summed);
  for (int k = whole; k < rows.count; ++k)
  {
    this->add(Eigen::Vector3d(rows.x[k], rows.y[k], rows.z[k]),
      Eigen::Vector3d(rows.directionX[k], rows.directionY[k], rows.directionZ[k]), rows.residual[k], rows.weight[k]);
  }
}

void NormalEquations::sum()
{
  addRows<Lanes>(this->Waiting, this->Summed);
  this->Filled = 0;
}

NormalEquations::Result NormalEquations::result()
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
