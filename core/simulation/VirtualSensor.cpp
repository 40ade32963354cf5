// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/VirtualSensor.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
using Eigen::Vector3d;

constexpr double GrazingCosine = 0.12; // of 83 degrees
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
      this->Places.push_back((view.depths[i] * Vector3d((static_cast<double>(i % camera.width) - camera.cx) / camera.fx,
                                                 (static_cast<double>(i / camera.width) - camera.cy) / camera.fy, 1.0))
                               .cast<float>());
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
}

void requireQuality(const SensorQuality& quality)
{
  const auto valid = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (!valid(quality.depthNoise) || !valid(quality.depthStep) || !valid(quality.imageNoise) ||
      !valid(quality.imageBlur))
  {
    throw Error("Noise, steps and blur of a simulated sensor must be 0 or more.");
  }
  if (!(quality.dropout >= 0.0 && quality.dropout <= 1.0) ||
      !(quality.jumpDropout >= 0.0 && quality.jumpDropout <= 1.0))
  {
    throw Error("Dropouts of a simulated sensor must be shares from 0 to 1.");
  }
  if (quality.matchingWindow < 1 || quality.matchingWindow > 101 || quality.imageBlur > 50.0)
  {
    throw Error("The matching window of a simulated sensor must be 1 to 101 pixels, its blur at most 50.");
  }
}

OrganizedCloud measureDepth(
  const View& view, const Camera& camera, const SensorQuality& quality, Random& random, const Progress& progress)
{
  const Patches patches(view, camera);
  const int radius = quality.matchingWindow / 2;
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
    // The same numbers are drawn for every pixel: a quality changes no other pixel's noise.
    const double noise = random.normal();
    const double drop = random.uniform();
    const double jump = random.uniform();
    const Vector3d ray((column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1.0);
    const double cosine = std::abs(view.normals[i].dot(ray)) / (view.normals[i].norm() * ray.norm());
    if (drop < quality.dropout || cosine < GrazingCosine ||
        (radius > 0 && patches.share(column, row, radius, radius > 3 ? 2 : 1) < 0.5) ||
        (jump < quality.jumpDropout && patches.share(column, row, 1, 1) < 1.0))
    {
      continue;
    }
    const double metres = view.depths[i] / 1000.0;
    double depth = view.depths[i] + quality.depthNoise * metres * metres * noise;
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
