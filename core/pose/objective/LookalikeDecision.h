// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace meam
{
/// What contradicts a pose that all else speaks for: a part that looks alike, longer, shorter or mirrored, fits as well
/// but there.
struct Contradictions
{
  double continuing = 0.0; ///< patches of surface that go on smoothly and no pose explains (SurfaceContinuation)
  double past = 0.0;       ///< patches of predicted surface that the sensor saw past
  double misfit = 0.0; ///< how far the surface lies off the part, in what is expected of a right pose (SurfaceMisfit)

  int missing = 0;       ///< patches of the part that are missing on most of the likely poses (CommonDifferences)
  int surplus = 0;       ///< and patches of surface beside it that are there on most
  double mirrored = 0.0; ///< probability that what a mirror shows of the part lies there (allowForMirrorImage)
  double resized = 0.0;  ///< probability that what lies there is longer or shorter along an axis (allowForOtherSize)
  /// Of the likely poses together, along the axes of the CAD file, as shares of its lengths; NaN where not measured.
  Eigen::Vector3d lengths = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  /// Times as thick as in the CAD file by the floor (thicknessByFloor): nothing is less likely for it, for sensors see
  /// parts and floors at different depths; 1 where the floor does not tell of another.
  double thickness = 1.0;

  /// Logarithm of how much likelier they are of the part than of one that looks alike. `excused`: [0, 1), by what the
  /// scan itself may make of them.
  double logRatio(double excused) const;
};

/// Of poses, how likely each is of the part and not of one that looks alike, [0, 1]. What a scan holds is decided for
/// all together, for a bin is nearly always filled with one or the other: where most of what is in full sight
/// contradicts the poses there, what is half hidden is none of the part either. `weights`: [0, 1], how likely something
/// is there at all. `excused`: as above.
std::vector<double> sharesOfPart(
  const std::vector<Contradictions>& poses, const std::vector<double>& weights, double excused);
}
