// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/SearchRegion.h"

#include "base/Error.h"
#include "base/sequences/Quantiles.h"
#include "base/sequences/Sequences.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double PixelsOfCell = 2.0; // along a side: no cell of a measured surface is without a point
const char* const NothingThere =
  "Nothing of the scan lies in the region: give a box along the axes of the scan, in mm, or a mask of its pixels that "
  "leaves some of the measured ones.";

Eigen::AlignedBox3d checked(const Region& region)
{
  const Eigen::AlignedBox3d& box = region.box;
  const bool isNone = box.min() == Eigen::AlignedBox3d().min() && box.max() == Eigen::AlignedBox3d().max();
  if (!isNone && !(box.min().array() < box.max().array()).all())
  {
    throw Error("The box of the region is empty: give from and to along x, y and z, in mm, from before to.");
  }
  return box;
}

Eigen::AlignedBox3d grown(Eigen::AlignedBox3d box, double margin)
{
  const Eigen::Vector3d step = Eigen::Vector3d::Constant(margin);
  return box.isEmpty() ? box : Eigen::AlignedBox3d(box.min() - step, box.max() + step);
}

/// Median distance of points beside each other in a row, mm.
double spacingOf(const OrganizedCloud& cloud)
{
  std::vector<float> distances;
  for (std::size_t i = 1; i < cloud.size(); ++i)
  {
    const float distance = (cloud.points[i] - cloud.points[i - 1]).norm();
    if (i % static_cast<std::size_t>(cloud.width) != 0 && std::isfinite(distance) && distance > 0.0f)
    {
      distances.push_back(distance);
    }
  }
  return distances.empty() ? 1.0 : medianOf(distances);
}

/// Pixels no farther from one of those than so many.
cv::Mat1b around(const cv::Mat1b& chosen, double pixels)
{
  cv::Mat1f distances;
  cv::distanceTransform(chosen == 0, distances, cv::DIST_L2, cv::DIST_MASK_3);
  return distances <= pixels;
}

PointRaster rasterOf(const OrganizedCloud& cloud, const cv::Mat1b& chosen)
{
  const cv::Rect rows = cv::boundingRect(chosen);
  PointRaster raster{ rows.width, rows.height, {} };
  for (int row = rows.y; row < rows.y + rows.height; ++row)
  {
    for (int column = rows.x; column < rows.x + rows.width; ++column)
    {
      raster.points.push_back(chosen(row, column) ? row * cloud.width + column : -1);
    }
  }
  return raster;
}
}

SearchRegion::SearchRegion(const Region& region)
  : Box(checked(region))
{
  if (!region.mask.empty())
  {
    throw Error("A region as a mask is one of the scan's pixels, and the scan's edge points are given: give a box.");
  }
}

SearchRegion::SearchRegion(const Region& region, const PreparedScan& scan)
  : Box(checked(region))
  , T_sensor_scan(scan.T_sensor_scan)
{
  const Points& points = scan.cloud.points;
  if (region.mask.empty())
  {
    return;
  }
  this->View.perspective = scan.sensor.perspective;
  const Eigen::AlignedBox2d reach = reachOf(points, this->View);
  const double side = PixelsOfCell * std::sqrt(std::max(reach.volume(), 1e-12) / static_cast<double>(points.size()));
  this->View.pixels.setConstant(1.0 / side);
  this->View.offset = -reach.min() / side;
  this->Width = static_cast<int>(reach.sizes().x() / side) + 1;
  const int height = static_cast<int>(reach.sizes().y() / side) + 1;
  std::vector<int> balance(static_cast<std::size_t>(this->Width) * height, 0);
  this->Cells.assign(balance.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const int id = scan.pointIds.empty() ? static_cast<int>(i) : scan.pointIds[i];
    if (!points[i].allFinite() || id < 0)
    {
      continue;
    }
    const Eigen::Vector2d look = this->View.lookAt(points[i]).cwiseProduct(this->View.pixels) + this->View.offset;
    const int column = std::clamp(static_cast<int>(look.x()), 0, this->Width - 1);
    const int row = std::clamp(static_cast<int>(look.y()), 0, height - 1);
    const std::size_t cell = static_cast<std::size_t>(row) * this->Width + column;
    balance[cell] += region.mask[static_cast<std::size_t>(id)] != 0 ? 1 : -1;
    this->Cells[cell] = balance[cell] > 0 ? 1 : 0;
  }
  this->Cells = nearestPoints(std::move(this->Cells), this->Width);
}

bool SearchRegion::isInMask(const Eigen::Vector3d& place) const
{
  const Eigen::Vector3f seen = (this->T_sensor_scan * place).cast<float>();
  if (this->Cells.empty() || !seen.allFinite())
  {
    return this->Cells.empty();
  }
  const Eigen::Vector2d look = this->View.lookAt(seen).cwiseProduct(this->View.pixels) + this->View.offset;
  const int height = static_cast<int>(this->Cells.size()) / this->Width;
  const int column = static_cast<int>(std::clamp(look.x(), 0.0, this->Width - 1.0));
  const int row = static_cast<int>(std::clamp(look.y(), 0.0, height - 1.0));
  return this->Cells[static_cast<std::size_t>(row) * this->Width + column] > 0;
}

bool SearchRegion::contains(const Eigen::Vector3d& place) const
{
  return (this->Box.isEmpty() || this->Box.contains(place)) && this->isInMask(place);
}

bool SearchRegion::isNear(const Eigen::Vector3d& place, double distance) const
{
  if (!this->Box.isEmpty() && this->Box.exteriorDistance(place) > distance)
  {
    return false;
  }
  bool isSeen = false;
  const Eigen::Isometry3d T_scan_sensor = this->T_sensor_scan.inverse();
  for (int k = 0; k < 9 && !isSeen; ++k)
  {
    const Eigen::Vector3d aside = Eigen::Vector3d(k % 3 - 1, k / 3 - 1, 0.0).stableNormalized();
    isSeen = this->isInMask(T_scan_sensor * (this->T_sensor_scan * place + distance * aside));
  }
  return isSeen;
}

void SearchRegion::crop(PreparedScan& scan, double margin) const
{
  const Eigen::AlignedBox3d box = grown(this->Box, margin);
  const Eigen::Isometry3d T_scan_sensor = this->T_sensor_scan.inverse();
  const OrganizedCloud& cloud = scan.cloud;
  cv::Mat1b isIn(cloud.height, cloud.width, uchar(0)), isMeasured(cloud.height, cloud.width, uchar(0));
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (!cloud.points[i].allFinite())
    {
      continue;
    }
    const Eigen::Vector3d place = T_scan_sensor * cloud.points[i].cast<double>();
    isIn.data[i] = this->isInMask(place) ? 255 : 0;
    isMeasured.data[i] = box.isEmpty() || box.contains(place) ? 255 : 0;
  }
  if (cv::countNonZero(isIn & isMeasured) == 0)
  {
    throw Error(NothingThere);
  }
  const cv::Mat1b kept = this->Cells.empty() ? isMeasured : around(isIn, margin / spacingOf(cloud)) & isMeasured;
  const PointRaster raster = rasterOf(cloud, kept);
  if (scan.image.width == cloud.width && scan.image.height == cloud.height)
  {
    const cv::Rect part = cv::boundingRect(kept);
    Image image{ part.width, part.height, scan.image.channels, {} };
    for (int row = part.y; row < part.y + part.height; ++row)
    {
      const auto from =
        scan.image.pixels.begin() + (static_cast<std::ptrdiff_t>(row) * cloud.width + part.x) * scan.image.channels;
      image.pixels.insert(
        image.pixels.end(), from, from + static_cast<std::ptrdiff_t>(part.width) * scan.image.channels);
    }
    scan.image = std::move(image);
  }
  std::vector<int> ids(raster.points.size(), -1);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const int point = raster.points[i];
    ids[i] = point < 0 || scan.pointIds.empty() ? point : scan.pointIds[static_cast<std::size_t>(point)];
  }
  scan.cloud = cloudOf(raster, cloud.points);
  scan.pointIds = std::move(ids);
  scan.isAsGiven = false;
}

void SearchRegion::crop(LocalCloud& edges, Points& measured, double margin) const
{
  const Eigen::AlignedBox3d box = grown(this->Box, margin);
  const Eigen::Isometry3d T_scene_local = edges.T_local_scene.inverse();
  const auto isOut = [&](const Eigen::Vector3f& point) { return !box.contains(T_scene_local * point.cast<double>()); };
  const std::vector<int> kept = indicesWhere(edges.cloud.size(), [&](int i) { return !isOut(edges.cloud.points[i]); });
  edges.cloud = edges.cloud.subset(kept);
  eraseIf(measured, isOut);
  if (kept.empty())
  {
    throw Error(NothingThere);
  }
}
}
