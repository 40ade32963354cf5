// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/OrganizedCloud.h"

namespace meam
{
/// Which point of a cloud each pixel of a grid sees.
struct PointRaster
{
  int width = 0;
  int height = 0;
  std::vector<int> points; ///< row by row; -1: none
};

/// Where a sensor in whose frame the points are (mm) sees them, along z.
struct RasterView
{
  bool perspective = true;                          ///< x / z and y / z count, otherwise x and y
  Eigen::Vector2d pixels = Eigen::Vector2d::Ones(); ///< for a step of 1 in these
  Eigen::Vector2d offset = Eigen::Vector2d::Zero(); ///< pixels, of what is straight ahead

  Eigen::Vector2d lookAt(const Eigen::Vector3f& point) const
  {
    const Eigen::Vector2d across = point.head<2>().cast<double>();
    return this->perspective ? Eigen::Vector2d(across / point.z()) : across;
  }
};

/// Of the points that are finite, each pixel keeps the nearest one. The grid reaches as far as they do, strays left
/// out; it is empty when none is finite, or when it would have more than 64 pixels for each.
PointRaster rasterize(const Points& points, const RasterView& view);

/// How far the points reach in what the view looks at, strays left out; empty when none is finite.
Eigen::AlignedBox2d reachOf(const Points& points, const RasterView& view);

/// The same grid with pixels `step` times as large.
PointRaster coarser(const PointRaster& raster, const Points& points, int step);

/// [0, 1], share of the four neighbours of pixels with a point that have one, too.
double fillOf(const PointRaster& raster);

/// The points that the pixels see, NaN for none.
OrganizedCloud cloudOf(const PointRaster& raster, const Points& points);

/// For each pixel the point of the nearest pixel that has one, counted in steps to the four neighbours.
std::vector<int> nearestPoints(std::vector<int> seen, int width);
}
