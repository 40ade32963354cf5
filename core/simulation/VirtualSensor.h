// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/Random.h"
#include "scene/OrganizedCloud.h"
#include "simulation/Rasterizer.h"

namespace meam
{
/// How well a sensor measures. The defaults are moderate: those of a good stereo camera with projector.
struct SensorQuality
{
  double depthNoise = 0.3;  ///< mm, standard deviation at a distance of 1 m; it grows with the square of the distance
  double depthStep = 0.05;  ///< mm between depths that the sensor can tell apart; 0: none
  double dropout = 0.002;   ///< share of the pixels without depth, wherever they look
  double jumpDropout = 0.5; ///< share of the pixels beside a depth jump that have no depth
  int matchingWindow = 17;  ///< pixels: a surface that fills less than half of such a square has no depth; 1: any has
  double imageNoise = 1.5;  ///< grey values, standard deviation
  double imageBlur = 0.7;   ///< pixels, sigma of a Gaussian
};

/// Throws Error for a quality out of range.
void requireQuality(const SensorQuality& quality);

/// What a sensor with `quality` measures of a view; no depth where it looks at a surface flatter than 7 degrees.
/// `camera` is at the origin of the scene.
OrganizedCloud measureDepth(
  const View& view, const Camera& camera, const SensorQuality& quality, Random& random, const Progress& progress = {});

/// The image that a camera with `quality` makes of shares of white: grey, or in colour.
Image takeImage(const std::vector<Eigen::Vector3f>& colors, const Camera& camera, bool colored,
  const SensorQuality& quality, Random& random);
}
