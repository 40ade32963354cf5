// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace meam
{
struct OrganizedCloud;

/// How well a sensor measured a scan, as the scan itself shows.
struct ScanQuality
{
  double pointDistance = 0.0; ///< mm between neighbouring points across the line of sight, median; 0: not known
  double noise = 0.0;         ///< mm of depth, standard deviation
  double smoothing = 1.0;     ///< points in a row over which noise is alike; 1: each has its own
  double depthStep = 0.0;     ///< mm between depths that the sensor tells apart; 0: none seen
  double jumpGap = 0.0;       ///< points without depth between the two sides of a depth jump, on average
  double flying = 0.0;        ///< [0, 1], share of the depth jumps with a point that hangs between their two sides
  double coverage = 0.0;      ///< [0, 1], share of the grid that has depth

  bool isKnown() const { return this->pointDistance > 0.0; }
  /// Little was measured: likely a mask left no more than the parts. A bin fills more of the grid, also of a scan with
  /// many holes.
  bool isCutOut() const { return this->isKnown() && this->coverage < 0.3; }
};

// By how much the depths of neighbours differ at least that are of two surfaces, for all that slopes and noise do.
constexpr double JumpSlopes = 3.0; // point distances: a surface that falls by so many is steep, 72 degrees
constexpr double JumpNoises = 5.0; // standard deviations: what one point of a thousand pairs differs by

/// From the rows of a scan: noise from third differences of the depth, which bends of a surface leave out, of points
/// that are farther and farther apart until they share none. Not known without neighbours that have depth.
/// A cloud of height 1 says nothing.
/// Throws Error for a cloud whose points do not fill its grid.
ScanQuality measureQuality(const OrganizedCloud& cloud, int threads = 1);

/// In one sentence.
std::string describe(const ScanQuality& quality);
}
