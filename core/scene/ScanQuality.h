// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
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
};

/// By how much the depths of neighbours differ at least that are of two surfaces, for all that slopes and noise do.
struct DepthJump
{
  double slopes = 3.0; ///< point distances: a surface that falls by so many is steep, 72 degrees
  double noises = 5.0; ///< standard deviations: what one point of a thousand pairs differs by
};

struct ScanQualitySettings
{
  int samples = 100000;                            ///< points of the grid that are looked at, about
  std::array<int, 7> lags{ 1, 2, 3, 4, 6, 8, 12 }; ///< points in a row, one of these apart, that tell of the noise
  double growth = 1.0 / 3.0; ///< power of the distance with which noise grows at most over points that do not share it
  double ties = 0.03;        ///< share of neighbours of the same depth, from which on the sensor's steps are seen
  double jump = DepthJump().slopes;      ///< point distances between the two sides of a depth jump,
  double jumpNoise = DepthJump().noises; ///< and so many times the noise
  double longestGap = 0.02;              ///< of a row: a longer hole is not one that a jump made
};

/// From the rows of a scan: noise from third differences of the depth, which bends of a surface leave out, of points
/// that are farther and farther apart until they share none. Not known without neighbours that have depth.
/// A cloud of height 1 says nothing.
/// Throws Error for a cloud whose points do not fill its grid.
ScanQuality measureQuality(const OrganizedCloud& cloud, int threads = 1, const ScanQualitySettings& settings = {});

/// In one sentence.
std::string describe(const ScanQuality& quality);
}
