// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LocalCloud.h"
#include "scene/preparation/PointRaster.h"
#include "scene/preparation/Region.h"
#include "scene/preparation/ScanPreparation.h"

#include <vector>

namespace meam
{
/// Tells of places in a scan whether they belong to its region.
class SearchRegion
{
public:
  /// Throws Error for a box that is turned inside out.
  SearchRegion(const Region& region, const PreparedScan& scan);
  /// Of a scan whose edge points are given. Throws Error for such a box, and for a mask.
  explicit SearchRegion(const Region& region);

  /// `place`: in the scan's own coordinates. By a mask it does as the measured point does that the sensor sees next to
  /// it.
  bool contains(const Eigen::Vector3d& place) const;
  /// Whether it contains the place, or one so far from it (mm): of a mask, one of eight that the sensor sees around it.
  bool isNear(const Eigen::Vector3d& place, double distance) const;

  /// Leaves of a scan what is in the region, and so far around it (mm) as shows where a part ends that reaches out of
  /// it. Throws Error when nothing of the scan lies there.
  void crop(PreparedScan& scan, double margin) const;
  /// The same of the edge points of a scan, and of what was measured in their frame.
  void crop(LocalCloud& edges, Points& measured, double margin) const;

private:
  bool isInMask(const Eigen::Vector3d& place) const;

  Eigen::AlignedBox3d Box; ///< empty: everywhere
  // What the sensor looks at, in square cells: whether what was measured there belongs to the region. Empty: all does.
  std::vector<int> Cells;
  int Width = 0;
  RasterView View; ///< a pixel for each cell
  Eigen::Isometry3d T_sensor_scan = Eigen::Isometry3d::Identity();
};
}
