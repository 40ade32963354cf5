// SPDX-License-Identifier: BSD-3-Clause
#include "pick/BinDetection.h"

#include "base/Bounds.h"
#include "base/sequences/Sequences.h"
#include "scene/edges/GridSurface.h"
#include "scene/preparation/BackgroundRemoval.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meam
{
namespace
{
constexpr const char* WithoutRim =
  "the place and the size of the bin, or do without one (--no-bin; bin='none' in Python, Bin "
  "in ParaView, Workplace in C++).";
constexpr double MostTilt = 30.0;      // degrees between the floor's normal and the sensor's direction
constexpr double FullSides = 60.0;     // % of each side of the rim that must have been measured
constexpr double LeastSize = 10.0;     // % of the scan's extent: a smaller rectangle is none
constexpr double SideTolerance = 0.02; // of the rectangle's shorter side: so near a side is on it
constexpr double PointsInLevel = 2.0;  // point distances in the height of a level
constexpr double NoiseInLevel = 4.0;   // standard deviations of the noise besides
constexpr double LowestShare = 0.02;   // of the points inside may be lower than the floor: wrong ones
constexpr double ThinnestWall = 2.0;   // point distances
constexpr double MiddleShare = 0.7;    // of the sides: what lies there is inside of any wall
constexpr double MostInside = 0.5;     // of the points there may be as high as the rim: it is no solid block
constexpr double SameArea = 0.05;      // rectangles that differ by less are of one rim
constexpr double ThickestWall = 0.25;  // of the rim's shorter side

constexpr std::size_t EnoughPoints = 60000;
constexpr int SideBins = 25; // pieces of a side that are looked at for points
constexpr int FewestInLevel = 4 * SideBins / 2;

/// A rectangle in the plane.
struct Rectangle
{
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX(); ///< unit, its first side
  Eigen::Vector2d size = Eigen::Vector2d::Zero();   ///< along it and across

  /// From the middle, along the sides.
  Eigen::Vector2d local(const Eigen::Vector2d& point) const
  {
    const Eigen::Vector2d d = point - this->middle;
    return { d.dot(this->along), d.y() * this->along.x() - d.x() * this->along.y() };
  }
};

using PlanePoints = std::vector<Eigen::Vector2d>;

Rectangle smallestAround(const PlanePoints& points)
{
  const auto flat = mapped<cv::Point2f>(points,
    [&](const auto& point) { return cv::Point2f(static_cast<float>(point.x()), static_cast<float>(point.y())); });
  const cv::RotatedRect found = cv::minAreaRect(flat);
  const double angle = found.angle * M_PI / 180.0;
  return { { found.center.x, found.center.y }, { std::cos(angle), std::sin(angle) },
    { found.size.width, found.size.height } };
}

/// Of each side the share of its pieces with a point at most `depth` inside and at least `from`; the least of them.
double leastFullSide(const Rectangle& rectangle, const PlanePoints& points, double from, double depth)
{
  std::vector<bool> full(4 * SideBins, false);
  for (const auto& point : points)
  {
    const Eigen::Vector2d at = rectangle.local(point);
    for (int axis = 0; axis < 2; ++axis)
    {
      const double inside = 0.5 * rectangle.size[axis] - std::abs(at[axis]);
      const double along = at[1 - axis] / rectangle.size[1 - axis] + 0.5;
      if (inside >= from && inside <= depth && along >= 0.0 && along < 1.0)
      {
        full[(2 * axis + (at[axis] > 0.0)) * SideBins + static_cast<int>(along * SideBins)] = true;
      }
    }
  }
  std::ptrdiff_t least = SideBins;
  for (int side = 0; side < 4; ++side)
  {
    const auto begin = full.begin() + side * SideBins;
    least = std::min(least, std::count(begin, begin + SideBins, true));
  }
  return static_cast<double>(least) / SideBins;
}

/// How many points lie in the middle of a rectangle, a share of its sides.
std::ptrdiff_t countInside(const Rectangle& rectangle, const PlanePoints& points, double share)
{
  return std::count_if(points.begin(), points.end(),
    [&](const Eigen::Vector2d& point)
    { return (rectangle.local(point).cwiseAbs().array() < 0.5 * share * rectangle.size.array()).all(); });
}
}

Bin detectBin(const OrganizedCloud& cloud, const Progress& progress)
{
  if (cloud.height < 2)
  {
    throw Error(std::string("The bin is found in an organized scan: give one, or ") + WithoutRim);
  }
  const BackgroundRemoval background = removeBackground(cloud, nullptr, {}, subProgress(progress, 0.0, 0.6));
  Eigen::Vector3d up = -Eigen::Vector3d::UnitZ();
  std::optional<double> floor;
  for (const auto& plane : background.planes)
  {
    const Eigen::Vector3d normal = plane.normal().cast<double>();
    if (-normal.z() >= std::cos(MostTilt * M_PI / 180.0))
    {
      up = normal;
      floor = -plane.offset();
    }
  }
  up.normalize();
  const Eigen::Quaterniond toUp = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), up);
  const Eigen::Matrix3d axes = toUp.toRotationMatrix(); // first axis: up
  const double spread = std::max(1.0, std::sqrt(static_cast<double>(cloud.size()) / EnoughPoints));
  const Points points = everyNth(cloud, static_cast<int>(spread));
  const GridScale scale = gridScale(cloud);
  const double distance = scale.pointDistance * spread;
  const double level = PointsInLevel * scale.pointDistance + NoiseInLevel * scale.noise;
  std::vector<std::pair<double, Eigen::Vector2d>> highest; // height, and place across
  for (const auto& point : points)
  {
    const Eigen::Vector3d at = axes.transpose() * point.cast<double>();
    highest.emplace_back(at.x(), at.tail<2>());
  }
  std::sort(highest.begin(), highest.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  PlanePoints all;
  std::transform(
    highest.begin(), highest.end(), std::back_inserter(all), [](const auto& point) { return point.second; });
  const double leastSize = LeastSize / 100.0 * bounds(points).cast<double>().sizes().minCoeff();

  // Levels from the top on, each half a level lower than the last one: the largest rectangle, of levels of about the
  // same one the fullest.
  Rectangle rim{};
  std::vector<double> heights; ///< of the rim's points
  PlanePoints rimPoints;
  const double lowest = highest.empty() ? 0.0 : (floor ? *floor + 2.0 * level : highest.back().first);
  for (double top = highest.empty() ? 0.0 : highest.front().first; top > lowest; top -= 0.5 * level)
  {
    report(progress, 0.6 + 0.4 * (highest.front().first - top) / (highest.front().first - lowest));
    const auto isAbove = [](const auto& point, double height) { return point.first > height; };
    const auto begin = std::lower_bound(highest.begin(), highest.end(), top, isAbove);
    const auto end = std::lower_bound(begin, highest.end(), top - level, isAbove);
    if (end - begin < FewestInLevel)
    {
      continue;
    }
    PlanePoints inLevel;
    std::transform(begin, end, std::back_inserter(inLevel), [](const auto& point) { return point.second; });
    const Rectangle outside = smallestAround(inLevel);
    const double tolerance = std::max(SideTolerance * outside.size.minCoeff(), 2.0 * distance);
    const double area = outside.size.prod();
    if (area < (1.0 - SameArea) * rim.size.prod() ||
        (area < (1.0 + SameArea) * rim.size.prod() && inLevel.size() <= rimPoints.size()) ||
        outside.size.minCoeff() < std::max(leastSize, 4.0 * tolerance) ||
        100.0 * leastFullSide(outside, inLevel, 0.0, tolerance) < FullSides ||
        static_cast<double>(countInside(outside, inLevel, MiddleShare)) >
          MostInside * static_cast<double>(countInside(outside, all, MiddleShare)))
    {
      continue;
    }
    rim = outside;
    rimPoints = std::move(inLevel);
    heights.clear();
    std::transform(begin, end, std::back_inserter(heights), [](const auto& point) { return point.first; });
  }
  Bin bin;
  if (!rimPoints.empty())
  {
    bin.wall = ThinnestWall * scale.pointDistance;
    while (bin.wall < ThickestWall * rim.size.minCoeff() &&
           100.0 * leastFullSide(rim, rimPoints, bin.wall, bin.wall + 2.0 * distance) >= FullSides)
    {
      bin.wall += 0.5 * distance;
    }
    if (!floor)
    {
      std::vector<double> inside{ heights.back() };
      for (const auto& [height, place] : highest)
      {
        if (((rim.local(place).cwiseAbs() - 0.5 * rim.size).array() < -bin.wall).all())
        {
          inside.push_back(height);
        }
      }
      floor = inside[static_cast<std::size_t>((1.0 - LowestShare) * static_cast<double>(inside.size() - 1))];
    }
    bin.size << rim.size.x() - 2.0 * bin.wall, rim.size.y() - 2.0 * bin.wall, heights[heights.size() / 2] - *floor;
  }
  if (!(bin.size.minCoeff() > 0.0))
  {
    throw Error(std::string("No bin was found in the scan: its rim has to be in view all around. Give ") + WithoutRim);
  }
  bin.T_scene_bin.linear().col(2) = up;
  bin.T_scene_bin.linear().col(0) = axes.rightCols<2>() * rim.along;
  bin.T_scene_bin.linear().col(1) = up.cross(bin.T_scene_bin.linear().col(0));
  bin.T_scene_bin.translation() = axes.rightCols<2>() * rim.middle + *floor * up;
  report(progress, 1.0);
  return bin;
}
}
