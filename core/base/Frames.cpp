// SPDX-License-Identifier: BSD-3-Clause
#include "base/Frames.h"

#include "base/AllVectors.h"
#include "base/Bounds.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <limits>
#include <numeric>

namespace meam
{
namespace
{
static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double), "points are plain coordinates");

/// Sums over points: their number, x, y, z, xx, xy, xz, yy, yz, zz, and xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz,
/// zzz.
constexpr int Moments = 20;

/// Adds those of the finite points, as seen from `from`.
MEAM_ALL_VECTORS
void addMoments(const double* xyz, std::size_t count, const double* from, double (*sums)[PointLanes])
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double fromX = from[0], fromY = from[1], fromZ = from[2];
  for (std::size_t begin = 0; begin < count; begin += PointLanes)
  {
    const double* at = xyz + 3 * begin;
#pragma omp simd
    for (int k = 0; k < PointLanes; ++k)
    {
      const double u = at[3 * k] - fromX, v = at[3 * k + 1] - fromY, w = at[3 * k + 2] - fromZ;
      const double one = std::abs(u + v + w) < infinity ? 1.0 : 0.0;
      const double x = one > 0.0 ? u : 0.0, y = one > 0.0 ? v : 0.0, z = one > 0.0 ? w : 0.0;
      const double xx = x * x, xy = x * y, xz = x * z, yy = y * y, yz = y * z, zz = z * z;
      sums[0][k] += one;
      sums[1][k] += x;
      sums[2][k] += y;
      sums[3][k] += z;
      sums[4][k] += xx;
      sums[5][k] += xy;
      sums[6][k] += xz;
      sums[7][k] += yy;
      sums[8][k] += yz;
      sums[9][k] += zz;
      sums[10][k] += x * xx;
      sums[11][k] += y * xx;
      sums[12][k] += z * xx;
      sums[13][k] += x * yy;
      sums[14][k] += x * yz;
      sums[15][k] += x * zz;
      sums[16][k] += y * yy;
      sums[17][k] += z * yy;
      sums[18][k] += y * zz;
      sums[19][k] += z * zz;
    }
  }
}

constexpr double Spread = 1e4;        // mm, root mean square from the mean, of no bin: looked at for stray points
constexpr double StrayDistance = 1e3; // of the extent of the middle half of the points

/// The points that are not far beyond all measure from the middle half of them.
PrecisePoints withoutStrays(const PrecisePoints& points)
{
  Points rounded(points.size());
  std::transform(
    points.begin(), points.end(), rounded.begin(), [](const Eigen::Vector3d& point) { return point.cast<float>(); });
  const Eigen::AlignedBox3d middle = innerBounds(rounded, 0.25).cast<double>();
  PrecisePoints stay;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if ((rounded[i].cast<double>() - middle.center()).norm() <= StrayDistance * middle.diagonal().norm())
    {
      stay.push_back(points[i]);
    }
  }
  return stay;
}
}

bool isRigid(const Eigen::Matrix4d& matrix)
{
  constexpr double tolerance = 2e-3; // of columns' lengths and products: three decimals leave up to 0.00174
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  return matrix.allFinite() && R.isUnitary(tolerance) && R.determinant() > 0.0 &&
         matrix.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& matrix)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  U.col(2) *= (U * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return U * svd.matrixV().transpose();
}

std::optional<Eigen::Isometry3d> rigidOf(const Eigen::Matrix4d& matrix)
{
  constexpr double asWritten = 1e-6; // rounding of single precision: such a matrix stays the same to the last bit
  if (!isRigid(matrix))
  {
    return std::nullopt;
  }
  Eigen::Isometry3d T;
  T.matrix() = matrix;
  if (!T.linear().isUnitary(asWritten))
  {
    T.linear() = nearestRotation(T.linear());
  }
  return T;
}

Eigen::Isometry3d transformOf(const double* numbers)
{
  Eigen::Isometry3d T;
  T.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers);
  return T;
}

void appendNumbersOf(const Eigen::Isometry3d& T, std::vector<double>& numbers)
{
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = T.matrix();
  numbers.insert(numbers.end(), rows.data(), rows.data() + rows.size());
}

Eigen::Isometry3d principalFrame(const PrecisePoints& points)
{
  // Moments are about one of the points, so they keep their precision far from the origin.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const auto first =
    std::find_if(points.begin(), points.end(), [](const Eigen::Vector3d& point) { return point.allFinite(); });
  if (first == points.end())
  {
    return frame;
  }
  const Eigen::Vector3d from = *first;
  double lanes[Moments][PointLanes] = {};
  inLanes(points.front().data(), points.size(),
    [&](const double* some, std::size_t size) { addMoments(some, size, from.data(), lanes); });
  double m[Moments];
  for (int i = 0; i < Moments; ++i)
  {
    m[i] = std::accumulate(lanes[i], lanes[i] + PointLanes, 0.0);
  }
  const double n = m[0];
  const Eigen::Vector3d mean = Eigen::Vector3d(m[1], m[2], m[3]) / n;
  Eigen::Matrix3d squares;
  squares << m[4], m[5], m[6], m[5], m[7], m[8], m[6], m[8], m[9];
  squares /= n;
  if (squares.trace() - mean.squaredNorm() > Spread * Spread)
  {
    const PrecisePoints stay = withoutStrays(points);
    if (!stay.empty() && stay.size() < static_cast<std::size_t>(n))
    {
      return principalFrame(stay);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares - mean * mean.transpose());
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse();
  if (!axes.allFinite())
  {
    return frame; // coordinates beyond all measure
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    // The third moment along the axis, about the mean.
    const double a = axes(0, axis), b = axes(1, axis), c = axes(2, axis);
    const double cubes =
      a * a * a * m[10] + b * b * b * m[16] + c * c * c * m[19] +
      3.0 * (a * a * (b * m[11] + c * m[12]) + b * b * (a * m[13] + c * m[17]) + c * c * (a * m[15] + b * m[18])) +
      6.0 * a * b * c * m[14];
    const double along = mean.dot(axes.col(axis));
    const double skewness =
      cubes / n - 3.0 * along * axes.col(axis).dot(squares * axes.col(axis)) + 2.0 * along * along * along;
    if (skewness < 0.0)
    {
      axes.col(axis) *= -1.0;
    }
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  frame.linear() = axes.transpose();
  frame.translation() = -(axes.transpose() * (from + mean));
  return frame;
}

Eigen::Matrix3f frameAround(const Eigen::Vector3f& axis)
{
  // The coordinate axis that is farthest from `axis` gives the second direction.
  int least = 0;
  axis.cwiseAbs().minCoeff(&least);
  Eigen::Matrix3f frame;
  frame.col(0) = axis;
  frame.col(1) = axis.cross(Eigen::Vector3f::Unit(least)).normalized();
  frame.col(2) = axis.cross(frame.col(1));
  return frame;
}
}
