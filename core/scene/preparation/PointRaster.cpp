// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/PointRaster.h"

#include "base/sequences/Sequences.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace meam
{
namespace
{
constexpr double MostOfPoint = 64.0;        // pixels for each point: of more a grid is not filled at any step
constexpr std::size_t ReachSamples = 20000; // points that tell how far all reach, spread evenly:
constexpr double StraysOfReach = 0.002;     // share of them at each end of each axis that may be strays,
constexpr double ReachMargin = 0.02;        // and by so much of its size the grid goes beyond the others

/// Lets a pixel see a point, unless it sees one that is nearer.
void see(std::vector<int>& seen, std::size_t pixel, int point, const Points& points)
{
  int& best = seen[pixel];
  if (best < 0 || points[point].z() < points[best].z())
  {
    best = point;
  }
}
}

Eigen::AlignedBox2d reachOf(const Points& points, const RasterView& view)
{
  std::array<std::vector<double>, 2> places;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / ReachSamples);
  std::size_t measured = 0; // gaps may come as regularly as samples of all would
  for (const Eigen::Vector3f& point : points)
  {
    if (!point.allFinite() || measured++ % stride != 0)
    {
      continue;
    }
    const Eigen::Vector2d place = view.lookAt(point);
    for (int k = 0; place.allFinite() && k < 2; ++k)
    {
      places[k].push_back(place[k]);
    }
  }
  Eigen::AlignedBox2d box;
  if (!places[0].empty())
  {
    const std::size_t strays = static_cast<std::size_t>(StraysOfReach * static_cast<double>(places[0].size()));
    for (std::vector<double>& each : places)
    {
      std::sort(each.begin(), each.end());
    }
    const std::size_t last = places[0].size() - 1 - strays;
    box.extend(Eigen::Vector2d(places[0][strays], places[1][strays]));
    box.extend(Eigen::Vector2d(places[0][last], places[1][last]));
  }
  return box;
}

PointRaster rasterize(const Points& points, const RasterView& view)
{
  const auto pixelOf = [&](const Eigen::Vector2d& place) -> Eigen::Vector2d
  { return (place.cwiseProduct(view.pixels) + view.offset).array().round(); };
  const Eigen::AlignedBox2d reach = reachOf(points, view);
  if (reach.isEmpty())
  {
    return {};
  }
  const Eigen::Vector2d margin = (ReachMargin * reach.sizes().cwiseProduct(view.pixels)).array().round() + 1.0;
  const Eigen::Vector2d least = pixelOf(reach.min()) - margin, most = pixelOf(reach.max()) + margin;
  const Eigen::Vector2d size = most - least + Eigen::Vector2d::Ones();
  const double few = 1000.0; // points, which have room whatever their number
  if (!size.allFinite() || !(size.prod() <= MostOfPoint * std::max(few, static_cast<double>(points.size()))))
  {
    return {};
  }
  std::vector<std::pair<Eigen::Vector2i, int>> places; // of those within
  Eigen::AlignedBox2i box;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector2d pixel = pixelOf(view.lookAt(points[i])) - least;
    if (pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < size.x() && pixel.y() < size.y())
    {
      places.emplace_back(pixel.cast<int>(), static_cast<int>(i));
      box.extend(places.back().first);
    }
  }
  PointRaster raster{ box.sizes().x() + 1, box.sizes().y() + 1, {} };
  raster.points.assign(static_cast<std::size_t>(raster.width) * raster.height, -1);
  for (const auto& [place, point] : places)
  {
    const Eigen::Vector2i pixel = place - box.min();
    see(raster.points, static_cast<std::size_t>(pixel.y()) * raster.width + pixel.x(), point, points);
  }
  return raster;
}

PointRaster coarser(const PointRaster& raster, const Points& points, int step)
{
  PointRaster result{ (raster.width + step - 1) / step, (raster.height + step - 1) / step, {} };
  result.points.assign(static_cast<std::size_t>(result.width) * result.height, -1);
  for (int row = 0; row < raster.height; ++row)
  {
    for (int column = 0; column < raster.width; ++column)
    {
      const int point = raster.points[static_cast<std::size_t>(row) * raster.width + column];
      if (point >= 0)
      {
        see(result.points, static_cast<std::size_t>(row / step) * result.width + column / step, point, points);
      }
    }
  }
  return result;
}

double fillOf(const PointRaster& raster)
{
  std::size_t neighbours = 0, filled = 0;
  for (int row = 1; row + 1 < raster.height; ++row)
  {
    const int* const points = raster.points.data() + static_cast<std::size_t>(row) * raster.width;
    for (int column = 1; column + 1 < raster.width; ++column)
    {
      if (points[column] >= 0)
      {
        neighbours += 4;
        for (const int other : { column - 1, column + 1, column - raster.width, column + raster.width })
        {
          filled += points[other] >= 0 ? 1 : 0;
        }
      }
    }
  }
  return neighbours > 0 ? static_cast<double>(filled) / static_cast<double>(neighbours) : 0.0;
}

OrganizedCloud cloudOf(const PointRaster& raster, const Points& points)
{
  OrganizedCloud cloud{ raster.width, raster.height, {} };
  cloud.points.reserve(raster.points.size());
  for (const int point : raster.points)
  {
    cloud.points.push_back(
      point < 0 ? Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()).eval() : points[point]);
  }
  return cloud;
}

std::vector<int> nearestPoints(std::vector<int> seen, int width)
{
  const int height = static_cast<int>(seen.size()) / width;
  std::vector<int> front = indicesWhere(seen.size(), [&](int pixel) { return seen[pixel] >= 0; });
  for (std::size_t i = 0; i < front.size(); ++i)
  {
    const int pixel = front[i];
    const int column = pixel % width;
    const int row = pixel / width;
    const std::pair<bool, int> neighbours[] = { { column > 0, pixel - 1 }, { column + 1 < width, pixel + 1 },
      { row > 0, pixel - width }, { row + 1 < height, pixel + width } };
    for (const auto& [inside, neighbour] : neighbours)
    {
      if (inside && seen[neighbour] < 0)
      {
        seen[neighbour] = seen[pixel];
        front.push_back(neighbour);
      }
    }
  }
  return seen;
}
}
