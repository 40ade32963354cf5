// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/OrganizedCloud.h"

namespace meam
{
/// Why a point of the scene does not count; of several reasons the first.
enum class Background : unsigned char
{
  Kept,
  Masked,  ///< black in the mask
  Outside, ///< of the region
  Plane    ///< on a large plane that nothing is behind: the floor, or a wall
};

struct BackgroundRemovalSettings
{
  Eigen::AlignedBox3f region; ///< mm, scene coordinates; points outside are removed; empty: all are inside
  int planes = 1;             ///< at most so many planes are removed, the largest first
  double tolerance = 0.0;     ///< mm from a plane; 0: by point distance and noise
  double leastShare = 10.0;   ///< % of the points that are left; a smaller plane stays
};

struct BackgroundRemoval
{
  OrganizedCloud cloud;                            ///< what is removed is NaN
  std::vector<Background> reasons;                 ///< of every grid point; points without depth are kept as they are
  std::vector<Eigen::Hyperplane<float, 3>> planes; ///< mm, that were removed; normals point to the sensor
};

/// Takes away what is not worth looking for parts in: points outside a region, points that a mask hides, and
/// the bin's floor and walls, found as planes by RANSAC among points spread over the scene. A plane goes
/// only when it is large and when next to nothing lies behind it, as seen from the sensor at the origin, so
/// that the faces of large parts stay. Parts that lie flat on the floor keep what stands out of it by more than
/// the tolerance. The same input gives the same result.
///
/// `mask` may be null; it has the size of the cloud, 0 hides. Throws Error for a cloud that is not organized or
/// has no valid depth, for a mask of another size, and for settings out of range. That nothing is left is no
/// error.
BackgroundRemoval removeBackground(const OrganizedCloud& cloud, const Image* mask = nullptr,
  const BackgroundRemovalSettings& settings = {}, const Progress& progress = {});
}
