// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/BackgroundRemoval.h"

#include "features/PCLConversion.h"
#include "base/Range.h"
#include "base/sequences/Sequences.h"
#include "scene/Enclosure.h"
#include "scene/edges/GridSurface.h"

#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace meam
{
namespace
{
constexpr double PointsInTolerance = 2.0; // point distances,
constexpr double NoiseInTolerance = 3.0;  // and standard deviations of the noise
constexpr double MostBehind = 0.03;       // share of these points: dirt and wrong points behind a floor
constexpr int PlaneSamples = 10000;       // points that planes are found among, spread evenly
constexpr int Tries = 3;                  // planes looked at for each one that may go
constexpr int MostTriples = 2000;         // of points whose planes RANSAC counts for, and fewer
constexpr double Missed = 0.001;          // when the probability that none of them lies on the largest plane is this

void check(const OrganizedCloud& cloud, const Image* mask, const BackgroundRemovalSettings& settings)
{
  requirePoints(cloud.points, "The scene");
  if (cloud.height <= 1 || cloud.width <= 1 || cloud.size() != static_cast<std::size_t>(cloud.width) * cloud.height)
  {
    throw Error("The scene is not organized: its background is removed from a grid of width x height points.");
  }
  if (mask && (mask->width != cloud.width || mask->height != cloud.height ||
                mask->pixels.size() != cloud.size() * static_cast<std::size_t>(mask->channels)))
  {
    throw Error("The mask is " + std::to_string(mask->width) + " x " + std::to_string(mask->height) +
                " pixels but the cloud is " + std::to_string(cloud.width) + " x " + std::to_string(cloud.height) +
                " points: give a mask with a pixel for each point.");
  }
  requireWithin("number of planes of the background", settings.planes, 0, 20);
  requireWithin("tolerance of the background", settings.tolerance, 0.0, Unbounded, " mm");
  requireWithin("least share of the background", settings.leastShare, 0.0, 100.0, " %");
}

/// Up to `most` of the indices, spread evenly over them.
std::vector<int> spread(const std::vector<int>& indices, std::size_t most)
{
  const std::size_t count = std::min(indices.size(), most);
  return ofIndices<int>(count, [&](int i) { return indices[i * indices.size() / count]; });
}

/// The plane with the most points within the tolerance (RANSAC, then least squares); none of points on a line.
std::optional<Plane> largestPlane(const Points& points, double tolerance)
{
  constexpr std::size_t leastPoints = 3; // of a plane
  if (points.size() < leastPoints)
  {
    return {};
  }
  pcl::RandomSampleConsensus<pcl::PointXYZ> search(
    pcl::make_shared<pcl::SampleConsensusModelPlane<pcl::PointXYZ>>(toPCL(points)), tolerance);
  search.setMaxIterations(MostTriples);
  search.setProbability(1.0 - Missed);
  std::vector<int> inliers;
  if (!search.computeModel() || (search.getInliers(inliers), inliers.size() < leastPoints))
  {
    return {};
  }
  const auto on = mapped<Eigen::Vector3f>(inliers, [&](const int i) { return points[i]; });
  return fitPlane(on, {}).plane;
}
}

BackgroundRemoval removeBackground(
  const OrganizedCloud& cloud, const Image* mask, const BackgroundRemovalSettings& settings, const Progress& progress)
{
  check(cloud, mask, settings);
  report(progress, 0.0);
  BackgroundRemoval result{ cloud, std::vector<Background>(cloud.size(), Background::Kept), {} };
  std::vector<int> left;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (!cloud.points[i].allFinite())
    {
      continue;
    }
    const std::size_t pixel = mask ? i * static_cast<std::size_t>(mask->channels) : 0;
    if (mask && std::all_of(&mask->pixels[pixel], &mask->pixels[pixel] + mask->channels, [](int v) { return v == 0; }))
    {
      result.reasons[i] = Background::Masked;
    }
    else if (!settings.region.isEmpty() && !settings.region.contains(cloud.points[i]))
    {
      result.reasons[i] = Background::Outside;
    }
    else
    {
      left.push_back(static_cast<int>(i));
    }
  }

  const GridScale scale = gridScale(cloud);
  const double tolerance = settings.tolerance > 0.0
                             ? settings.tolerance
                             : PointsInTolerance * scale.pointDistance + NoiseInTolerance * scale.noise;
  const double fewest = std::max(3.0, settings.leastShare / 100.0 * static_cast<double>(left.size()));
  // Those of a plane that stays are not looked at again.
  std::vector<int> candidates = spread(left, static_cast<std::size_t>(PlaneSamples));
  const auto on = [&](const Plane& plane) {
    return [&plane, &cloud, tolerance](int i) { return std::abs(plane.signedDistance(cloud.points[i])) <= tolerance; };
  };
  const int tries = Tries * settings.planes;
  for (int k = 0; k < tries && static_cast<int>(result.planes.size()) < settings.planes; ++k)
  {
    report(progress, static_cast<double>(k) / tries);
    Points points;
    for (const int i : candidates)
    {
      points.push_back(cloud.points[i]);
    }
    const std::optional<Plane> plane = largestPlane(points, tolerance);
    if (!plane)
    {
      break;
    }
    const auto size = static_cast<double>(std::count_if(left.begin(), left.end(), on(*plane)));
    const auto behind = static_cast<double>(std::count_if(
      left.begin(), left.end(), [&](int i) { return plane->signedDistance(cloud.points[i]) < -tolerance; }));
    eraseIf(candidates, on(*plane));
    if (size < fewest || behind > MostBehind * static_cast<double>(left.size()))
    {
      continue;
    }
    result.planes.push_back(*plane);
    for (const int i : left)
    {
      if (on(*plane)(i))
      {
        result.reasons[i] = Background::Plane;
      }
    }
    eraseIf(left, on(*plane));
  }
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (result.reasons[i] != Background::Kept)
    {
      result.cloud.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
    }
  }
  report(progress, 1.0);
  return result;
}
}
