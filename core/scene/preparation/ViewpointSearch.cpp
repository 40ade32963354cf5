// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/ViewpointSearch.h"

#include "base/sequences/Quantiles.h"
#include "base/Random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace meam
{
namespace
{
constexpr std::size_t SeenPointSamples = 20000; // points that are looked at
constexpr std::size_t FewestPointsSeen = 1000;  // of fewer too few share a pixel
constexpr double SeenStraysBeyond = 4.0;        // times the median distance from the middle; farther ones are strays
constexpr double SeenPixelSize = 1.5;           // of the points' distance, so that nearly each pixel has one
constexpr double HiddenBehind = 4.0;     // pixels behind the nearest of a pixel: a slope of 76 degrees is not hidden
constexpr int StartDirections = 100;     // about 20 degrees apart, as near as the local search needs
constexpr int SearchStarts = 3;          // of the local search, from the best of these
constexpr double SearchStartsAway = 4.0; // of the sensor, times the points' root mean square distance
constexpr double FirstPlaceStep = 0.3;   // of the distance, 17 degrees
constexpr double LastPlaceStep = 0.02;   // 1 degree
constexpr double AsFew = 0.002;          // share of the points, of those hidden from either side of flat parts
constexpr double HidesMore = 2.0;        // times as many as from the place that was found: the guess is wrong

using SeenPlaces = std::vector<Eigen::Vector3d>;

/// Some of the points without strays, from their middle.
struct CentredPoints
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  SeenPlaces places;
  double extent = 0.0; ///< mm, root mean square distance from the middle
};

CentredPoints centredPoints(const Points& points)
{
  CentredPoints result;
  const std::size_t count = std::min(points.size(), SeenPointSamples);
  Random random(1); // one of each stretch: at even steps those of a scan in rows would be in columns
  SeenPlaces sampled;
  for (std::size_t k = 0; k < count; ++k)
  {
    const double at = (static_cast<double>(k) + random.uniform()) / static_cast<double>(count);
    const Eigen::Vector3f& point =
      points[std::min(static_cast<std::size_t>(at * static_cast<double>(points.size())), points.size() - 1)];
    if (point.allFinite())
    {
      sampled.push_back(point.cast<double>());
    }
  }
  if (sampled.size() < FewestPointsSeen)
  {
    return result;
  }
  std::vector<double> values(sampled.size());
  for (int axis = 0; axis < 3; ++axis)
  {
    std::transform(sampled.begin(), sampled.end(), values.begin(), [&](const auto& place) { return place[axis]; });
    result.middle[axis] = medianOf(values);
  }
  std::transform(
    sampled.begin(), sampled.end(), values.begin(), [&](const auto& place) { return (place - result.middle).norm(); });
  std::vector<double> unordered = values; // which the median puts in another order
  const double most = SeenStraysBeyond * medianOf(unordered);
  double squares = 0.0;
  for (std::size_t k = 0; k < sampled.size(); ++k)
  {
    if (values[k] <= most)
    {
      result.places.push_back(sampled[k] - result.middle);
      squares += values[k] * values[k];
    }
  }
  result.extent = std::sqrt(squares / static_cast<double>(result.places.size()));
  return result;
}

/// What looks along a direction, which is its last row.
Eigen::Matrix3d rotationLooking(const Eigen::Vector3d& forward)
{
  Eigen::Index least = 0;
  forward.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d side = Eigen::Vector3d::Unit(least);
  Eigen::Matrix3d rotation;
  rotation.row(0) = (side - side.dot(forward) * forward).normalized().transpose();
  rotation.row(1) = forward.cross(rotation.row(0).transpose()).transpose();
  rotation.row(2) = forward.transpose();
  return rotation;
}

/// [0, 1], share of the points that lie behind others for a sensor, whose place is counted from their middle.
double hiddenFrom(const CentredPoints& points, const Sensor& sensor)
{
  const Eigen::Vector3d forward = sensor.perspective ? (-sensor.position).normalized() : sensor.direction;
  const double distance = sensor.perspective ? sensor.position.norm() : 0.0; // of the middle
  const Eigen::Matrix3d rotation = rotationLooking(forward);
  SeenPlaces seen; // across at the distance of the middle, mm, and away from the sensor
  seen.reserve(points.places.size());
  Eigen::AlignedBox2d reach;
  for (const Eigen::Vector3d& place : points.places)
  {
    Eigen::Vector3d point = rotation * place;
    if (sensor.perspective)
    {
      point.z() += distance;
      if (point.z() < 0.1 * distance)
      {
        return 1.0; // the sensor is amid the points
      }
      const double away = point.norm();
      point *= distance / point.z();
      point.z() = away;
    }
    reach.extend(point.head<2>());
    seen.push_back(point);
  }
  const double size = SeenPixelSize * std::sqrt(reach.volume() / static_cast<double>(seen.size()));
  if (!(size > 0.0))
  {
    return 1.0;
  }
  const int width = static_cast<int>(reach.sizes().x() / size) + 1,
            height = static_cast<int>(reach.sizes().y() / size) + 1;
  std::vector<double> nearest(static_cast<std::size_t>(width) * height, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> pixelOf(seen.size());
  for (std::size_t k = 0; k < seen.size(); ++k)
  {
    const Eigen::Vector2i pixel = ((seen[k].head<2>() - reach.min()) / size).cast<int>();
    pixelOf[k] = static_cast<std::size_t>(pixel.y()) * width + pixel.x();
    nearest[pixelOf[k]] = std::min(nearest[pixelOf[k]], seen[k].z());
  }
  std::size_t hidden = 0;
  for (std::size_t k = 0; k < seen.size(); ++k)
  {
    hidden += seen[k].z() > nearest[pixelOf[k]] + HiddenBehind * size;
  }
  return static_cast<double>(hidden) / static_cast<double>(seen.size());
}

struct SeenPlace
{
  double hidden = 1.0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< from the points' middle
};

SeenPlace seenPlaceAt(const CentredPoints& points, const Eigen::Vector3d& place)
{
  return { hiddenFrom(points, { true, place, {} }), place };
}

/// Pattern search across and along the line of sight to the middle.
SeenPlace improvedPlace(const CentredPoints& points, SeenPlace best)
{
  for (double step = FirstPlaceStep; step > LastPlaceStep;)
  {
    const Eigen::Matrix3d rotation = rotationLooking(-best.place.normalized());
    const double across = step * best.place.norm();
    const std::array<Eigen::Vector3d, 6> others{ best.place + across * rotation.row(0).transpose(),
      best.place - across * rotation.row(0).transpose(), best.place + across * rotation.row(1).transpose(),
      best.place - across * rotation.row(1).transpose(), best.place * (1.0 + step), best.place / (1.0 + step) };
    SeenPlace better = best;
    for (std::size_t k = 0; k < others.size() && !(better.hidden < best.hidden); ++k)
    {
      better = seenPlaceAt(points, others[k]);
    }
    if (better.hidden < best.hidden)
    {
      best = better;
    }
    else
    {
      step /= 2.0;
    }
  }
  return best;
}
}

std::optional<Sensor> searchViewpoint(const Points& points, const Sensor& guess, double mayHide)
{
  const CentredPoints from = centredPoints(points);
  if (!(from.extent > 0.0))
  {
    return std::nullopt;
  }
  Sensor there = guess;
  there.position -= from.middle;
  const double hidden = hiddenFrom(from, there);
  if (hidden <= mayHide)
  {
    return std::nullopt;
  }
  std::vector<SeenPlace> all;
  for (int k = 0; k < StartDirections; ++k) // a Fibonacci sphere
  {
    const double z = 1.0 - 2.0 * (k + 0.5) / StartDirections, across = std::sqrt(1.0 - z * z);
    const double angle = M_PI * (1.0 + std::sqrt(5.0)) * (k + 0.5);
    const Eigen::Vector3d direction(across * std::cos(angle), across * std::sin(angle), z);
    all.push_back(seenPlaceAt(from, SearchStartsAway * from.extent * direction));
  }
  const auto isBetter = [](const SeenPlace& a, const SeenPlace& b) { return a.hidden < b.hidden; };
  std::stable_sort(all.begin(), all.end(), isBetter);
  SeenPlace best;
  for (int k = 0; k < SearchStarts; ++k)
  {
    best = std::min(best, improvedPlace(from, all[static_cast<std::size_t>(k)]), isBetter);
  }
  // From the other side of flat parts as few points are hidden: the side of the guess is more likely then.
  const Eigen::Vector3d side = guess.perspective ? there.position : Eigen::Vector3d(-guess.direction);
  if (best.place.dot(side) < 0.0)
  {
    const SeenPlace across = improvedPlace(from, seenPlaceAt(from, -best.place));
    best = across.hidden <= best.hidden + AsFew ? across : best;
  }
  if (best.hidden > HiddenByNoise || hidden < HidesMore * best.hidden)
  {
    return std::nullopt;
  }
  Sensor found;
  found.position = from.middle + best.place;
  found.direction = -best.place.normalized();
  return found;
}
}
