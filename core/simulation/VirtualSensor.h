// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/Random.h"
#include "scene/OrganizedCloud.h"
#include "simulation/Rasterizer.h"

namespace meam
{
/// How a sensor measures depth.
enum class SensorKind
{
  StructuredLight, ///< one depth from a sequence of patterns: sharp edges, little noise
  ActiveStereo,    ///< two eyes and a projector of dots: steps of disparity, rounded edges, shadows on one side
  TimeOfFlight     ///< the phase of modulated light: noise, flying pixels, corners that are rounded by multipath
};
constexpr int SensorKinds = 3;

/// How well a sensor measures. The defaults are moderate: those of structured light, a good stereo camera with
/// projected patterns. 0 leaves an effect of the other kinds out. The sensor's pixels are those of the image.
struct SensorQuality
{
  double depthNoise = 0.3;  ///< mm, standard deviation at a distance of 1 m; it grows with the square of the distance
  double depthStep = 0.05;  ///< mm between depths that the sensor can tell apart; 0: none
  double dropout = 0.002;   ///< share of the pixels without depth, wherever they look
  double jumpDropout = 0.5; ///< share of the pixels beside a depth jump that have no depth
  int matchingWindow = 17;  ///< pixels: a surface that fills less than half of such a square has no depth; 1: any has
  double glareAngle = 0.0;  ///< degrees: surfaces that face the sensor to within this angle mirror its light: no depth
  int noiseWindow = 1;      ///< pixels: noise is alike within such a square; 1: each pixel has its own

  // Stereo: depth = focal length (pixels) * baseline / disparity.
  double stereoBaseline = 0.0; ///< mm to the second eye, on the right; 0: no stereo, what follows has no effect
  double disparityNoise = 0.0; ///< pixels, standard deviation
  double disparityStep = 0.0;  ///< pixels between disparities that the sensor can tell apart; 0: none
  int smoothingWindow = 1;     ///< pixels: a disparity is the mean over such a square; 1: its own

  // Time of flight.
  double rangeNoise = 0.0; ///< mm, standard deviation at 1 m of a surface that is seen at a right angle
  double pixelBlur = 0.0;  ///< pixels, sigma of a Gaussian: how far the light of neighbours mixes into a pixel's range
  double multipath = 0.0;  ///< share of its light that a surface throws on, [0, 1]; 0: no light takes two ways

  double imageNoise = 1.5; ///< gray values, standard deviation
  double imageBlur = 0.7;  ///< pixels, sigma of a Gaussian
};

/// What a kind of sensor measures like. Figures:
/// - Active stereo is of the class of Intel's RealSense D415: 55 mm between its eyes (Intel, D400 series data sheet);
///   steps of 1/32 pixel (Grunnet-Jepsen et al., Subpixel linearity improvement for Intel RealSense depth cameras
///   D400 series, 2019); errors of the disparity that do not depend on it, a matching window of 7 x 7 pixels
///   (Keselman et al., Intel RealSense stereoscopic depth cameras, CVPR workshops 2017, of the R200); 0.08 pixels of
///   noise (Grunnet-Jepsen in IntelRealSense/librealsense, issue 3904, 2019: 0.032 at best, 0.08 in practice).
/// - Time of flight is of the class of Microsoft's Azure Kinect at short range: data sheet (2019), random error 17 mm
///   or less and systematic error below 11 mm + 0.1 % over the whole range, both confirmed by Tölgyessy et al.,
///   Evaluation of the Azure Kinect (Sensors 21, 2021), who also show its flying pixels and multipath. Its noise grows
///   as the root of the light lost (Lange and Seitz, Solid-state time-of-flight range camera, IEEE J. Quantum
///   Electronics 37, 2001): with the distance, and over the root of the cosine of incidence.
/// What these sources do not say is chosen: smoothing and correlation of 5 pixels, 2 degrees of glare; 1 mm of range
/// noise at 1 m, 0.7 pixels of blur, a fifth of the light thrown on, half of the flying pixels filtered out.
SensorQuality sensorQuality(SensorKind kind);

/// Throws Error for a quality out of range.
void requireQuality(const SensorQuality& quality);

/// What a sensor with `quality` measures of a view; no depth where it looks at a surface flatter than 7 degrees.
/// `camera` is at the origin of the scene.
OrganizedCloud measureDepth(
  const View& view, const Camera& camera, const SensorQuality& quality, Random& random, const Progress& progress = {});

/// The image that a camera with `quality` makes of shares of white: gray, or in color.
Image takeImage(const std::vector<Eigen::Vector3f>& colors, const Camera& camera, bool colored,
  const SensorQuality& quality, Random& random);
}
