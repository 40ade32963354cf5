// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/UnmeasuredPoints.h"

#include "base/Error.h"
#include "base/sequences/Quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

namespace meam
{
namespace
{
constexpr std::size_t DepthSamples = 10000; // spread evenly, among which the constant depth is looked for
constexpr double FewestOfConstant = 0.02;   // share of the scan that has it: fewer are strays
constexpr double FewestOfOthers = 0.01;     // share that has not: a floor without noise may be all of one depth,
constexpr double MostBeside = 0.01;         // and its parts are near it: share of the others that may be
constexpr float FarBeyond = 10.0f;          // times how far half of the coordinates across it are from the axis
constexpr float Beside = 2.0f;              // times nearer or farther,
constexpr float BesideMany = 1.25f;         // and of one that many have, as where a sensor's range ends,
constexpr double ManyOfConstant = 0.1;      // which is such a share of the scan,
constexpr std::size_t FewestDepths = 50;    // in a scan of so many depths: a floor without noise has few beside its own
constexpr int FewestAtOrigin = 2;           // a single one may be a point of a robot's frame

std::string depthText(const char* form, double value)
{
  char text[32];
  std::snprintf(text, sizeof text, form, value);
  return text;
}

std::string shareText(std::size_t count, std::size_t all)
{
  const double percent = 100.0 * static_cast<double>(count) / static_cast<double>(all);
  return depthText(percent < 1.0 ? "%.2g" : "%.0f", percent) + " % of the points";
}

/// Blanks what the predicate takes, and tells how many these are.
template <typename Takes>
void remove(Points& points, const Takes& takes, const std::string& which, std::string& report)
{
  std::size_t count = 0;
  for (Eigen::Vector3f& point : points)
  {
    if (point.allFinite() && takes(point))
    {
      point.setConstant(std::numeric_limits<float>::quiet_NaN());
      ++count;
    }
  }
  if (count > 0)
  {
    appendSentence(report, shareText(count, points.size()) + " " + which + ": they are taken as not measured.");
  }
}

/// The depth that stands for none, if there is one. In another frame than the sensor's, where depths may be around 0,
/// it has to be far beyond what the points span.
std::optional<float> constantDepth(const Points& points, bool isInSensorFrame)
{
  std::vector<float> depths, sides;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / DepthSamples);
  for (std::size_t i = 0; i < points.size(); i += stride)
  {
    if (points[i].allFinite())
    {
      depths.push_back(points[i].z());
      sides.push_back(std::abs(points[i].x()));
      sides.push_back(std::abs(points[i].y()));
    }
  }
  if (depths.empty())
  {
    return std::nullopt;
  }
  const float far = isInSensorFrame ? 0.0f : FarBeyond * medianOf(sides);
  std::sort(depths.begin(), depths.end());
  const double all = static_cast<double>(depths.size());
  std::vector<float> distinct;
  std::unique_copy(depths.begin(), depths.end(), std::back_inserter(distinct));
  const bool isVaried = distinct.size() >= FewestDepths;
  for (auto first = depths.begin(); first != depths.end();)
  {
    const float depth = *first;
    const auto last = std::upper_bound(first, depths.end(), depth);
    const double same = static_cast<double>(last - first);
    first = last;
    if (std::abs(depth) < far || same < FewestOfConstant * all || all - same < FewestOfOthers * all)
    {
      continue;
    }
    const bool areMany = isInSensorFrame && isVaried && same >= ManyOfConstant * all;
    const float factor = areMany ? BesideMany : Beside;
    const float low = std::min(depth / factor, depth * factor), high = std::max(depth / factor, depth * factor);
    const auto near =
      std::upper_bound(depths.begin(), depths.end(), high) - std::lower_bound(depths.begin(), depths.end(), low);
    if (static_cast<double>(near) - same <= MostBeside * (all - same))
    {
      return depth;
    }
  }
  return std::nullopt;
}
void removeConstantDepth(Points& points, bool isInSensorFrame, std::string& report)
{
  if (const std::optional<float> depth = constantDepth(points, isInSensorFrame))
  {
    const auto hasIt = [&](const Eigen::Vector3f& point) { return point.z() == *depth; };
    remove(points, hasIt, "have the depth " + depthText("%.6g", *depth) + ", which no other comes near", report);
  }
}
}

std::string removeMarkers(Points& points)
{
  std::string report;
  const auto isAtOrigin = [](const Eigen::Vector3f& point) { return point.isZero(0.0f); };
  if (std::count_if(points.begin(), points.end(), isAtOrigin) >= FewestAtOrigin)
  {
    remove(points, isAtOrigin, "are (0, 0, 0)", report);
  }
  removeConstantDepth(points, false, report);
  return report;
}

std::string removeByDepth(Points& points)
{
  std::string report;
  removeConstantDepth(points, true, report);
  const auto isBehind = [](const Eigen::Vector3f& point) { return point.z() <= 0.0f; };
  const auto isInFront = [](const Eigen::Vector3f& point) { return point.z() > 0.0f; };
  const auto behind =
    std::count_if(points.begin(), points.end(), [](const Eigen::Vector3f& point) { return point.z() < 0.0f; });
  if (behind > 0 && std::count_if(points.begin(), points.end(), isInFront) > behind)
  {
    remove(points, isBehind, "have a depth of 0 or less", report);
  }
  return report;
}
}
