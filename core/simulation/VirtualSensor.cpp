// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/VirtualSensor.h"

#include "base/Range.h"
#include "base/sequences/Sequences.h"
#include "simulation/StereoMatching.h"
#include "simulation/TimeOfFlight.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
using Eigen::Vector3d;

constexpr double FlattestMeasured = 0.12; // cosine of 83 degrees: of flatter surface nothing comes back
// Depths that differ by more are not one surface for the sensor: as if its two eyes were a quarter of the distance
// apart and shifts of a pixel told surfaces apart. In pixels on the surface.
constexpr double PatchDepth = 4.0;

/// Which pixels are on the same surface: within PatchDepth of a pixel's tangent plane.
class Patches
{
public:
  Patches(const View& view, const Camera& camera)
    : Width(camera.width)
    , Height(camera.height)
  {
    for (std::size_t i = 0; i < view.depths.size(); ++i)
    {
      this->Places.push_back((view.depths[i] * rayThrough(i, camera)).cast<float>());
      this->Normals.push_back(view.normals[i].normalized().cast<float>());
      this->Reaches.push_back(static_cast<float>(PatchDepth * view.depths[i] / camera.fx));
    }
  }

  /// The share of a square of pixels, every `step`-th in both directions, that is on the surface at a pixel.
  double share(int column, int row, int radius, int step) const
  {
    const std::size_t i = static_cast<std::size_t>(row) * this->Width + column;
    int same = 0;
    int all = 0;
    for (int y = std::max(row - radius, row % step); y <= std::min(row + radius, this->Height - 1); y += step)
    {
      for (int x = std::max(column - radius, column % step); x <= std::min(column + radius, this->Width - 1); x += step)
      {
        const std::size_t k = static_cast<std::size_t>(y) * this->Width + x;
        same += std::abs(this->Normals[i].dot(this->Places[k] - this->Places[i])) <= this->Reaches[i];
        ++all;
      }
    }
    return static_cast<double>(same) / all;
  }

private:
  int Width;
  int Height;
  Points Places;
  Points Normals;
  std::vector<float> Reaches;
};

/// The numbers that are drawn for each pixel, always the same ones: a quality changes no other pixel's noise.
struct Draws
{
  std::vector<double> noise; ///< normal
  std::vector<double> drop;  ///< uniform
  std::vector<double> jump;  ///< uniform

  Draws(std::size_t pixels, Random& random)
  {
    for (std::size_t i = 0; i < pixels; ++i)
    {
      this->noise.push_back(random.normal());
      this->drop.push_back(random.uniform());
      this->jump.push_back(random.uniform());
    }
  }
};

/// Depths by way of disparities; `hidden` from the second eye are those that it gives none.
std::vector<double> stereoDepths(const std::vector<double>& depths, const Camera& camera, const SensorQuality& quality,
  const std::vector<double>& noise, std::vector<bool>& hidden)
{
  const double scale = camera.fx * quality.stereoBaseline;
  auto disparities = mapped<double>(depths, [&](const double depth) { return scale / depth; });
  hidden = halfOccluded(disparities, camera.width);
  disparities = boxMeans(disparities, camera.width, camera.height, quality.smoothingWindow);
  std::vector<double> measured;
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    double disparity = disparities[i] + quality.disparityNoise * noise[i];
    if (quality.disparityStep > 0.0)
    {
      disparity = quality.disparityStep * std::round(disparity / quality.disparityStep);
    }
    hidden[i] = hidden[i] || !(disparity > 0.0);
    measured.push_back(scale / disparity);
  }
  return measured;
}
}

SensorQuality sensorQuality(SensorKind kind)
{
  SensorQuality quality;
  if (kind == SensorKind::ActiveStereo)
  {
    quality.depthNoise = quality.depthStep = quality.jumpDropout = 0.0;
    quality.dropout = 0.005;
    quality.matchingWindow = 7;
    quality.glareAngle = 2.0;
    quality.noiseWindow = 5;
    quality.stereoBaseline = 55.0;
    quality.disparityNoise = 0.08;
    quality.disparityStep = 1.0 / 32.0;
    quality.smoothingWindow = 5;
  }
  else if (kind == SensorKind::TimeOfFlight)
  {
    quality.depthNoise = quality.depthStep = 0.0;
    quality.matchingWindow = 1;
    quality.rangeNoise = 1.0;
    quality.pixelBlur = 0.7;
    quality.multipath = 0.2;
  }
  return quality;
}

namespace
{
void requireOdd(const std::string& name, int window)
{
  requireWithin(name, window, 1, 101, " pixels");
  if (window % 2 == 0)
  {
    throw Error("The " + name + " has to be odd, not " + std::to_string(window) + " pixels.");
  }
}
}

void requireQuality(const SensorQuality& quality)
{
  requireWithin("simulated sensor's depth noise", quality.depthNoise, 0.0, Unbounded, " mm");
  requireWithin("simulated sensor's depth step", quality.depthStep, 0.0, Unbounded, " mm");
  requireWithin("simulated sensor's glare angle", quality.glareAngle, 0.0, Unbounded, " degrees");
  requireWithin("simulated sensor's stereo baseline", quality.stereoBaseline, 0.0, Unbounded, " mm");
  requireWithin("simulated sensor's disparity noise", quality.disparityNoise, 0.0, Unbounded, " pixels");
  requireWithin("simulated sensor's disparity step", quality.disparityStep, 0.0, Unbounded, " pixels");
  requireWithin("simulated sensor's range noise", quality.rangeNoise, 0.0, Unbounded, " mm");
  requireWithin("simulated sensor's image noise", quality.imageNoise, 0.0, Unbounded);
  requireWithin("simulated sensor's dropout", quality.dropout, 0.0, 1.0);
  requireWithin("simulated sensor's dropout at jumps", quality.jumpDropout, 0.0, 1.0);
  requireWithin("simulated sensor's multipath", quality.multipath, 0.0, 1.0);
  requireWithin("simulated sensor's matching window", quality.matchingWindow, 1, 101, " pixels");
  requireOdd("simulated sensor's noise window", quality.noiseWindow);
  requireOdd("simulated sensor's smoothing window", quality.smoothingWindow);
  requireWithin("simulated sensor's pixel blur", quality.pixelBlur, 0.0, 50.0, " pixels");
  requireWithin("simulated sensor's image blur", quality.imageBlur, 0.0, 50.0, " pixels");
}

OrganizedCloud measureDepth(
  const View& view, const Camera& camera, const SensorQuality& quality, Random& random, const Progress& progress)
{
  const Patches patches(view, camera);
  const int radius = quality.matchingWindow / 2;
  Draws draws(view.depths.size(), random);
  if (quality.noiseWindow > 1)
  {
    draws.noise = correlated(draws.noise, camera.width, camera.height, quality.noiseWindow);
  }
  std::vector<double> depths = view.depths;
  std::vector<bool> hidden(depths.size(), false);
  if (quality.multipath > 0.0 || quality.pixelBlur > 0.0)
  {
    const std::vector<double> light = returnedLight(view, camera);
    depths = quality.multipath > 0.0 ? multipathDepths(view, camera, light, quality.multipath) : depths;
    depths = quality.pixelBlur > 0.0 ? mixedDepths(depths, light, camera, quality.pixelBlur) : depths;
  }
  if (quality.stereoBaseline > 0.0)
  {
    depths = stereoDepths(depths, camera, quality, draws.noise, hidden);
  }
  const double mirror = quality.glareAngle > 0.0 ? std::cos(quality.glareAngle * M_PI / 180.0) : 2.0;

  OrganizedCloud cloud;
  cloud.width = camera.width;
  cloud.height = camera.height;
  cloud.points.assign(view.depths.size(), Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
  {
    const int column = static_cast<int>(i % camera.width);
    const int row = static_cast<int>(i / camera.width);
    if (column == 0)
    {
      report(progress, static_cast<double>(row) / camera.height);
    }
    const Vector3d ray = rayThrough(i, camera);
    const double cosine = std::abs(view.normals[i].dot(ray)) / (view.normals[i].norm() * ray.norm());
    if (draws.drop[i] < quality.dropout || hidden[i] || cosine < FlattestMeasured || cosine > mirror ||
        (radius > 0 && patches.share(column, row, radius, radius > 3 ? 2 : 1) < 0.5) ||
        (draws.jump[i] < quality.jumpDropout && patches.share(column, row, 1, 1) < 1.0))
    {
      continue;
    }
    const double metres = view.depths[i] / 1000.0;
    double depth = depths[i] + quality.depthNoise * metres * metres * draws.noise[i];
    if (quality.rangeNoise > 0.0)
    {
      depth += quality.rangeNoise * metres / std::sqrt(cosine) * draws.noise[i]; // along the ray, at that range
    }
    if (quality.depthStep > 0.0)
    {
      depth = quality.depthStep * std::round(depth / quality.depthStep);
    }
    cloud.points[i] = (depth * ray).cast<float>();
  }
  return cloud;
}

Image takeImage(const std::vector<Eigen::Vector3f>& colors, const Camera& camera, bool colored,
  const SensorQuality& quality, Random& random)
{
  cv::Mat light(camera.height, camera.width, CV_32FC3);
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    light.at<cv::Vec3f>(static_cast<int>(i)) = { colors[i][0], colors[i][1], colors[i][2] };
  }
  if (quality.imageBlur > 0.0)
  {
    cv::GaussianBlur(light, light, cv::Size(), quality.imageBlur);
  }
  Image image;
  image.width = camera.width;
  image.height = camera.height;
  image.channels = colored ? 3 : 1;
  image.pixels.reserve(colors.size() * image.channels);
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    const cv::Vec3f& color = light.at<cv::Vec3f>(static_cast<int>(i));
    for (int channel = 0; channel < image.channels; ++channel)
    {
      const double share = colored ? color[channel] : 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
      const double value = 255.0 * share + quality.imageNoise * random.normal();
      image.pixels.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))));
    }
  }
  return image;
}
}
