// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// A small image of what a viewpoint sees of a part: the cells that the part covers, the background
/// around it, and background that it encloses, such as what shows through a hole.
class Silhouette
{
public:
  enum class Cell : unsigned char
  {
    Around,
    Part,
    Enclosed
  };

  /// `part` are evenly spaced samples, hidden ones or not; openings narrower than twice the settings'
  /// sample radius count as covered. `spacing` in mm.
  Silhouette(const Points& part, const Eigen::Vector3d& viewpoint, double spacing);

  /// What shows next to the part at a point of its edge, the way `outward` (unit) leads. Part: its own
  /// surface goes on there, or another one starts.
  Cell beyond(const Eigen::Vector3d& point, const Eigen::Vector3d& outward) const;

private:
  /// Column and row of a point.
  Eigen::Vector2i cellOf(const Eigen::Vector3d& point) const;
  bool isInside(const Eigen::Vector2i& cell) const;
  Cell& at(const Eigen::Vector2i& cell);
  Cell at(const Eigen::Vector2i& cell) const;
  void markDisc(const Eigen::Vector2i& middle, Cell mark);
  void markAround();

  Eigen::Vector3d Viewpoint;
  Eigen::Matrix3d Axes; ///< rows: depth, right, down
  double Spacing;
  double CellsPerSlope; ///< cells for each unit of right / depth
  Eigen::Vector2i Low = Eigen::Vector2i::Zero();
  Eigen::Vector2i Size = Eigen::Vector2i::Zero();
  std::vector<Cell> Cells;
};
}
