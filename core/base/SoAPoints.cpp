// SPDX-License-Identifier: BSD-3-Clause
#include "base/SoAPoints.h"

#include "base/AllVectors.h"

namespace meam
{
namespace
{
MEAM_ALL_VECTORS
void apply(const Eigen::Matrix<float, 3, 4>& T, const float* x, const float* y, const float* z, int count, float* toX,
  float* toY, float* toZ)
{
  const float ux = T(0, 0), uy = T(0, 1), uz = T(0, 2), u0 = T(0, 3);
  const float vx = T(1, 0), vy = T(1, 1), vz = T(1, 2), v0 = T(1, 3);
  const float wx = T(2, 0), wy = T(2, 1), wz = T(2, 2), w0 = T(2, 3);
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    toX[k] = ux * x[k] + uy * y[k] + uz * z[k] + u0;
    toY[k] = vx * x[k] + vy * y[k] + vz * z[k] + v0;
    toZ[k] = wx * x[k] + wy * y[k] + wz * z[k] + w0;
  }
}

void apply(const Eigen::Matrix<float, 3, 4>& T, const SoAPoints& from, SoAPoints& to)
{
  apply(T, from.x.data(), from.y.data(), from.z.data(), static_cast<int>(from.size()), to.x.data(), to.y.data(),
    to.z.data());
}
}

SoAOrientedPoints moved(const SoAOrientedPoints& columns, const Eigen::Isometry3f& motion)
{
  Eigen::Matrix<float, 3, 4> T = motion.matrix().topRows<3>();
  SoAOrientedPoints result;
  result.resize(columns.size());
  apply(T, columns.points, result.points);
  T.col(3).setZero();
  apply(T, columns.directions, result.directions);
  return result;
}
}
