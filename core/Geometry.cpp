// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry.h"

#include "Error.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdio>

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
  return result;
}

void requirePoints(const Points& points, const std::string& what)
{
  if (points.empty())
  {
    throw Error(what + " has no points: check the file and the step before this one.");
  }
  if (std::none_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }))
  {
    throw Error(what + " has only invalid points (NaN): the sensor returned no depth, or the file's fields are not "
                       "x, y and z.");
  }
}

PointCloud finitePoints(const PointCloud& cloud)
{
  std::vector<int> finite;
  finite.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (cloud.points[i].allFinite())
    {
      finite.push_back(static_cast<int>(i));
    }
  }
  return finite.size() == cloud.size() ? cloud : cloud.subset(finite);
}

Eigen::AlignedBox3f bounds(const Points& points)
{
  Eigen::AlignedBox3f box;
  for (const auto& point : points)
  {
    if (point.allFinite())
    {
      box.extend(point);
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

Eigen::Isometry3d principalFrame(const Points& points)
{
  // Scans have a million points: one pass, of plain numbers. Moments are about one of the points, so they keep their
  // precision far from the origin.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const auto first = std::find_if(points.begin(), points.end(), [](const auto& point) { return point.allFinite(); });
  if (first == points.end())
  {
    return frame;
  }
  const Eigen::Vector3d from = first->cast<double>();
  const double fx = from.x(), fy = from.y(), fz = from.z();
  double n = 0.0, x = 0.0, y = 0.0, z = 0.0;
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  double xxx = 0.0, xxy = 0.0, xxz = 0.0, xyy = 0.0, xyz = 0.0, xzz = 0.0, yyy = 0.0, yyz = 0.0, yzz = 0.0, zzz = 0.0;
  for (const auto& point : points)
  {
    const double u = point.x() - fx, v = point.y() - fy, w = point.z() - fz;
    if (!std::isfinite(u + v + w))
    {
      continue;
    }
    const double uu = u * u, uv = u * v, uw = u * w, vv = v * v, vw = v * w, ww = w * w;
    n += 1.0;
    x += u, y += v, z += w;
    xx += uu, xy += uv, xz += uw, yy += vv, yz += vw, zz += ww;
    xxx += u * uu, xxy += v * uu, xxz += w * uu, xyy += u * vv, xyz += u * vw, xzz += u * ww;
    yyy += v * vv, yyz += w * vv, yzz += v * ww, zzz += w * ww;
  }
  const Eigen::Vector3d mean = Eigen::Vector3d(x, y, z) / n;
  Eigen::Matrix3d squares;
  squares << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  squares /= n;
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
    const double cubes = a * a * a * xxx + b * b * b * yyy + c * c * c * zzz +
      3.0 * (a * a * (b * xxy + c * xxz) + b * b * (a * xyy + c * yyz) + c * c * (a * xzz + b * yzz)) + 6.0 * a * b * c * xyz;
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
  const double extent = bounds(scene).diagonal().norm();
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
