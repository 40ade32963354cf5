// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry.h"

#include "AllVectors.h"
#include "Error.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>

namespace meam
{
namespace
{
std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

// Scans have a million points: bounds and moments look at several at a time, in lanes, so that the width of vectors has
// no part in the result.
constexpr int Lanes = 8;

static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float), "points are plain coordinates");
static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double), "points are plain coordinates");

/// Calls work(coordinates, count) with all points and a count that is a multiple of Lanes: the last ones are filled up
/// with points that are no numbers.
template <typename Scalar, typename Work>
void inLanes(const Scalar* xyz, std::size_t count, Work&& work)
{
  const std::size_t whole = count / Lanes * Lanes;
  if (whole > 0)
  {
    work(xyz, whole);
  }
  if (whole < count)
  {
    Scalar rest[3 * Lanes];
    std::fill_n(rest, 3 * Lanes, std::numeric_limits<Scalar>::quiet_NaN());
    std::copy_n(xyz + 3 * whole, 3 * (count - whole), rest);
    work(rest, Lanes);
  }
}

/// Extends the bounds of each lane by the finite points.
MEAM_ALL_VECTORS
void extend(const float* xyz, std::size_t count, float (*low)[Lanes], float (*high)[Lanes])
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (std::size_t begin = 0; begin < count; begin += Lanes)
  {
    const float* from = xyz + 3 * begin;
#pragma omp simd
    for (int k = 0; k < Lanes; ++k)
    {
      const float x = from[3 * k], y = from[3 * k + 1], z = from[3 * k + 2];
      const bool isFinite = (std::abs(x) < infinity) & (std::abs(y) < infinity) & (std::abs(z) < infinity);
      low[0][k] = std::min(low[0][k], isFinite ? x : infinity);
      low[1][k] = std::min(low[1][k], isFinite ? y : infinity);
      low[2][k] = std::min(low[2][k], isFinite ? z : infinity);
      high[0][k] = std::max(high[0][k], isFinite ? x : -infinity);
      high[1][k] = std::max(high[1][k], isFinite ? y : -infinity);
      high[2][k] = std::max(high[2][k], isFinite ? z : -infinity);
    }
  }
}

/// Sums over points: their number, x, y, z, xx, xy, xz, yy, yz, zz, and xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz.
constexpr int Moments = 20;

/// Adds those of the finite points, as seen from `from`.
template <typename Scalar>
inline __attribute__((always_inline)) void addEachMoment(
  const Scalar* xyz, std::size_t count, const double* from, double (*sums)[Lanes])
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double fromX = from[0], fromY = from[1], fromZ = from[2];
  for (std::size_t begin = 0; begin < count; begin += Lanes)
  {
    const Scalar* at = xyz + 3 * begin;
#pragma omp simd
    for (int k = 0; k < Lanes; ++k)
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

MEAM_ALL_VECTORS
void addMoments(const float* xyz, std::size_t count, const double* from, double (*sums)[Lanes])
{
  addEachMoment(xyz, count, from, sums);
}

MEAM_ALL_VECTORS
void addMoments(const double* xyz, std::size_t count, const double* from, double (*sums)[Lanes])
{
  addEachMoment(xyz, count, from, sums);
}

constexpr double Spread = 1e4;     // mm, root mean square from the mean, of no bin: looked at for stray points
constexpr double StrayDistance = 1e3; // of the extent of the middle half of the points

/// The points that are not far beyond all measure from the middle half of them.
template <typename Scalar>
std::vector<Scalar> withoutStrays(const Scalar* xyz, std::size_t count)
{
  Points points(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    points[i] = Eigen::Matrix<Scalar, 3, 1>(xyz + 3 * i).template cast<float>();
  }
  const Eigen::AlignedBox3d middle = innerBounds(points, 0.25).cast<double>();
  std::vector<Scalar> stay;
  for (std::size_t i = 0; i < count; ++i)
  {
    if ((points[i].cast<double>() - middle.center()).norm() <= StrayDistance * middle.diagonal().norm())
    {
      stay.insert(stay.end(), xyz + 3 * i, xyz + 3 * i + 3);
    }
  }
  return stay;
}

template <typename Scalar>
Eigen::Isometry3d frameOf(const Scalar* xyz, std::size_t count)
{
  // Moments are about one of the points, so they keep their precision far from the origin.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const auto at = [xyz](std::size_t i) { return Eigen::Matrix<Scalar, 3, 1>(xyz + 3 * i).template cast<double>().eval(); };
  std::size_t first = 0;
  while (first < count && !at(first).allFinite())
  {
    ++first;
  }
  if (first == count)
  {
    return frame;
  }
  const Eigen::Vector3d from = at(first);
  double lanes[Moments][Lanes] = {};
  inLanes(xyz, count, [&](const Scalar* some, std::size_t size) { addMoments(some, size, from.data(), lanes); });
  double m[Moments];
  for (int i = 0; i < Moments; ++i)
  {
    m[i] = std::accumulate(lanes[i], lanes[i] + Lanes, 0.0);
  }
  const double n = m[0];
  const Eigen::Vector3d mean = Eigen::Vector3d(m[1], m[2], m[3]) / n;
  Eigen::Matrix3d squares;
  squares << m[4], m[5], m[6], m[5], m[7], m[8], m[6], m[8], m[9];
  squares /= n;
  if (squares.trace() - mean.squaredNorm() > Spread * Spread)
  {
    const std::vector<Scalar> stay = withoutStrays(xyz, count);
    if (!stay.empty() && stay.size() < 3 * static_cast<std::size_t>(n))
    {
      return frameOf(stay.data(), stay.size() / 3);
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
    const double cubes = a * a * a * m[10] + b * b * b * m[16] + c * c * c * m[19] +
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
}

PointCloud PointCloud::subset(const std::vector<int>& indices) const
{
  PointCloud result;
  const auto take = [&](const auto& from, auto& to)
  {
    if (!from.empty())
    {
      to.reserve(indices.size());
      for (const int index : indices)
      {
        to.push_back(from[index]);
      }
    }
  };
  take(this->points, result.points);
  take(this->normals, result.normals);
  take(this->tangents, result.tangents);
  take(this->pointIds, result.pointIds);
  take(this->edgeTypes, result.edgeTypes);
  take(this->weights, result.weights);
  return result;
}

void requirePoints(std::size_t count, std::size_t finite, const std::string& what)
{
  if (count == 0)
  {
    throw Error(what + " has no points: check the file and the step before this one.");
  }
  if (finite == 0)
  {
    throw Error(what + " has only invalid points (NaN, infinite or beyond single precision): the sensor returned no "
                       "depth, or the file's fields are not x, y and z.");
  }
}

void requirePoints(const Points& points, const std::string& what)
{
  const bool isAnyFinite = std::any_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); });
  requirePoints(points.size(), isAnyFinite ? 1 : 0, what);
}

PointCloud finitePoints(PointCloud cloud)
{
  std::vector<int> finite;
  finite.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (cloud.points[i].allFinite() && (cloud.tangents.empty() || cloud.tangents[i].allFinite()))
    {
      finite.push_back(static_cast<int>(i));
    }
  }
  return finite.size() == cloud.size() ? cloud : cloud.subset(finite);
}

Eigen::AlignedBox3f bounds(const Points& points)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  float low[3][Lanes], high[3][Lanes];
  std::fill_n(low[0], 3 * Lanes, infinity);
  std::fill_n(high[0], 3 * Lanes, -infinity);
  if (!points.empty())
  {
    inLanes(points.front().data(), points.size(),
      [&](const float* xyz, std::size_t count) { extend(xyz, count, low, high); });
  }
  Eigen::AlignedBox3f box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const float least = *std::min_element(low[axis], low[axis] + Lanes);
    if (least < infinity)
    {
      box.min()[axis] = least;
      box.max()[axis] = *std::max_element(high[axis], high[axis] + Lanes);
    }
  }
  return box;
}

Eigen::AlignedBox3f innerBounds(const Points& points, double share)
{
  Eigen::AlignedBox3f box;
  std::vector<float> values;
  Eigen::Vector3f low;
  Eigen::Vector3f high;
  for (int axis = 0; axis < 3; ++axis)
  {
    values.clear();
    for (const auto& point : points)
    {
      if (point.allFinite())
      {
        values.push_back(point[axis]);
      }
    }
    if (values.empty())
    {
      return box;
    }
    const auto left = static_cast<std::ptrdiff_t>(share * values.size());
    std::nth_element(values.begin(), values.begin() + left, values.end());
    low[axis] = values[left];
    const auto right = static_cast<std::ptrdiff_t>(values.size()) - 1 - left;
    std::nth_element(values.begin(), values.begin() + right, values.end());
    high[axis] = values[right];
  }
  return { low, high };
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

Eigen::Isometry3d principalFrame(const float* xyz, std::size_t count) { return frameOf(xyz, count); }
Eigen::Isometry3d principalFrame(const double* xyz, std::size_t count) { return frameOf(xyz, count); }

Points moved(const Points& points, const Eigen::Isometry3d& motion)
{
  Points result;
  result.reserve(points.size());
  for (const auto& point : points)
  {
    result.push_back((motion * point.cast<double>()).cast<float>());
  }
  return result;
}

std::string unitsWarning(const Points& scene, double partDiameter)
{
  // A scene spans a part or more, and mostly some tens of them.
  const double parts = bounds(scene).diagonal().norm() / partDiameter;
  if (parts >= 0.7 && parts <= 200.0)
  {
    return {};
  }
  const int factor = parts < 1.0 ? (10.0 * parts >= 1.5 ? 10 : 1000) : (parts / 10.0 <= 100.0 ? 10 : 1000);
  return "The scene spans " + number(parts * partDiameter) + " and the part's diameter is " + number(partDiameter) +
    ": if their units differ, the likely factor is " + std::to_string(factor) + ". Scale the " +
    (parts < 1.0 ? "scene" : "part") + " by it.";
}

void requireSameUnits(const Points& scene, double partDiameter)
{
  constexpr double StrayShare = 0.02; // of the points, at each end of each axis
  double extent = bounds(scene).diagonal().norm();
  if (extent > 1000.0 * partDiameter)
  {
    extent = innerBounds(scene, StrayShare).diagonal().norm(); // stray points are no other unit
  }
  if (extent < 0.2 * partDiameter)
  {
    throw Error("The scene spans " + number(extent) + " but the part's diameter is " + number(partDiameter) +
      ": their units differ (a scene in metres and a part in millimetres differ by 1000). Scale the scene to the "
      "part's unit.");
  }
  if (extent > 1000.0 * partDiameter)
  {
    throw Error("The scene spans " + number(extent) + " but the part's diameter is only " + number(partDiameter) +
      ": their units differ (a part in metres and a scene in millimetres differ by 1000). Scale the part to the "
      "scene's unit.");
  }
}
}
