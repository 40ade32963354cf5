// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/GridSurface.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double SlopesInJump = 3.0; // a surface that falls by three times the distance of its points: 72 degrees
constexpr double NoiseInJump = 5.0;  // standard deviations: what one point of a thousand pairs differs by
constexpr double SlopeError = 0.05;  // of the window that windowRadius() looks for
constexpr int SmallestWindow = 2;
constexpr int LargestWindow = 6;
constexpr std::size_t EnoughSamples = 100000;
constexpr int FewestPoints = 6;

double median(std::vector<float>& values)
{
  if (values.empty())
  {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}
}

double GridScale::depthJump() const { return SlopesInJump * this->pointDistance + NoiseInJump * this->noise; }

int GridScale::windowRadius() const
{
  int radius = SmallestWindow;
  while (radius < LargestWindow && this->slopeError(radius) > SlopeError)
  {
    ++radius;
  }
  return radius;
}

double GridScale::slopeError(int radius) const
{
  // Noise over the root of the sum of the squared distances from the middle.
  return this->noise / (this->pointDistance * (2.0 * radius + 1.0) * std::sqrt(radius * (radius + 1.0) / 3.0));
}

GridScale gridScale(const OrganizedCloud& cloud)
{
  std::vector<float> distances;
  std::vector<float> bends;
  const int stride = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(cloud.size()) / EnoughSamples)));
  for (int row = 0; row < cloud.height; row += std::max(stride, 1))
  {
    const Eigen::Vector3f* points = cloud.points.data() + static_cast<std::size_t>(row) * cloud.width;
    for (int column = 1; column < cloud.width; column += std::max(stride, 1))
    {
      const Eigen::Vector3f step = points[column] - points[column - 1];
      if (!step.allFinite())
      {
        continue;
      }
      distances.push_back(step.head<2>().norm());
      if (column + 1 < cloud.width && points[column + 1].allFinite())
      {
        bends.push_back(std::abs(points[column + 1].z() - points[column].z() - step.z()));
      }
    }
  }
  // Of a normal distribution half is within 0.6745 deviations; the second difference has the root of 6 of them.
  return { median(distances), median(bends) / (0.6745 * std::sqrt(6.0)) };
}

GridPlane fitPlane(const OrganizedCloud& cloud, int row, int column, const GridWindow& window, double jump)
{
  GridPlane plane;
  const Eigen::Vector3f& centre = cloud.points[static_cast<std::size_t>(row) * cloud.width + column];
  if (!centre.allFinite())
  {
    return plane;
  }
  // Half the sides of the box around the rectangle.
  const Eigen::Vector2f d = window.direction.cwiseAbs();
  const int columns = static_cast<int>(d.x() * window.along + d.y() * window.across + 0.5f);
  const int rows = static_cast<int>(d.y() * window.along + d.x() * window.across + 0.5f);
  const float limit = static_cast<float>(jump);
  const float along = window.along + 0.01f;
  const float across = window.across + 0.01f;
  // Least squares for P = middle + u alongColumn + v alongRow.
  float count = 0.0f, u1 = 0.0f, v1 = 0.0f, uu = 0.0f, uv = 0.0f, vv = 0.0f;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Vector3f sumU = Eigen::Vector3f::Zero();
  Eigen::Vector3f sumV = Eigen::Vector3f::Zero();
  for (int r = std::max(row - rows, 0); r <= std::min(row + rows, cloud.height - 1); ++r)
  {
    const Eigen::Vector3f* points = cloud.points.data() + static_cast<std::size_t>(r) * cloud.width;
    const float v = static_cast<float>(r - row);
    for (int c = std::max(column - columns, 0); c <= std::min(column + columns, cloud.width - 1); ++c)
    {
      const float u = static_cast<float>(c - column);
      const Eigen::Vector3f offset = points[c] - centre;
      const bool inside = std::abs(u * window.direction.x() + v * window.direction.y()) <= along &&
                          std::abs(v * window.direction.x() - u * window.direction.y()) <= across;
      if (!inside || !(std::abs(offset.z()) < limit) || !std::isfinite(offset.x() + offset.y()))
      {
        continue;
      }
      count += 1.0f;
      u1 += u;
      v1 += v;
      uu += u * u;
      uv += u * v;
      vv += v * v;
      sum += offset;
      sumU += u * offset;
      sumV += v * offset;
    }
  }
  Eigen::Matrix3f moments;
  moments << count, u1, v1, u1, uu, uv, v1, uv, vv;
  Eigen::Matrix3f inverse;
  bool solvable = false;
  moments.computeInverseWithCheck(inverse, solvable, 0.5f); // of whole numbers
  if (count < FewestPoints || !solvable)
  {
    return plane;
  }
  Eigen::Matrix3f sums;
  sums << sum, sumU, sumV;
  const Eigen::Matrix3f fit = sums * inverse;
  plane.middle = centre + fit.col(0);
  plane.alongColumn = fit.col(1);
  plane.alongRow = fit.col(2);
  return plane;
}
}
