// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/OrganizedCloud.h"

namespace meam
{
constexpr int FewestPoints = 6; // of a surface in a window, for a plane

/// How finely and how exactly a sensor sampled its scene.
struct GridScale
{
  double pointDistance = 0.0; ///< mm across the line of sight, median over neighbours in a row
  double noise = 0.0;         ///< mm, standard deviation of z, from its second differences along rows

  /// mm: neighbours that differ by more in z are of two surfaces, for all that slopes and noise do.
  double depthJump() const;
  /// Grid steps: of a window that is just large enough for the slope of a surface in spite of the noise.
  int windowRadius() const;
  /// What the noise makes of the slope (mm per mm) of a plane in a full window, as a standard deviation.
  double slopeError(int radius) const;
};

/// Zeros for a cloud without neighbours that both have depth.
GridScale gridScale(const OrganizedCloud& cloud, int threads = 1);

/// A plane through the surface around a grid point.
struct GridPlane
{
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();      ///< mm, the plane at the grid point
  Eigen::Vector3f alongColumn = Eigen::Vector3f::Zero(); ///< mm, one column to the right on the plane
  Eigen::Vector3f alongRow = Eigen::Vector3f::Zero();    ///< mm, one row down on the plane

  /// Where the surface has too few points, both are zero.
  bool valid() const { return !this->alongColumn.isZero() && !this->alongRow.isZero(); }
  /// Unit vector on the plane for a direction in columns and rows.
  Eigen::Vector3f lifted(const Eigen::Vector2f& direction) const
  {
    return (direction.x() * this->alongColumn + direction.y() * this->alongRow).normalized();
  }
};

/// A rectangle of the grid around a point.
struct GridWindow
{
  int along = 2;                                        ///< grid steps from the middle in `direction`
  int across = 2;                                       ///< and across it
  Eigen::Vector2f direction = Eigen::Vector2f::UnitX(); ///< unit, in columns and rows
};

/// The plane that fits the points in a window around a grid point best; those that are a jump (mm) or more
/// before or behind it in z are of another surface. Invalid for a point without depth, or with too few others.
GridPlane fitPlane(const OrganizedCloud& cloud, int row, int column, const GridWindow& window, double jump);
/// The same of `count` points of the grid, several at a time: planes[i] is that of points[i] in windows[i].
void fitPlanes(
  const OrganizedCloud& cloud, const int* points, const GridWindow* windows, int count, double jump, GridPlane* planes);
}
