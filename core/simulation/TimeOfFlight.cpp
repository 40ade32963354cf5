// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/TimeOfFlight.h"

#include "base/sequences/Sequences.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
using Eigen::Vector3d;

// Pixels: the light of surfaces within this distance is looked at, one pixel of so many in both directions.
constexpr int Reach = 28;
constexpr int PixelStep = 4;

/// A piece of surface that throws light on.
struct Reflector
{
  Vector3d place;
  Vector3d normal;   ///< unit, towards the camera
  double area;       ///< mm^2
  double irradiance; ///< by the light of the sensor
};
}

std::vector<double> returnedLight(const View& view, const Camera& camera)
{
  std::vector<double> light;
  for (std::size_t i = 0; i < view.depths.size(); ++i)
  {
    const Vector3d ray = rayThrough(i, camera);
    const double cosine = std::abs(view.normals[i].dot(ray)) / (view.normals[i].norm() * ray.norm());
    light.push_back(1e6 * cosine / (view.depths[i] * view.depths[i] * ray.squaredNorm()));
  }
  return light;
}

std::vector<double> multipathDepths(
  const View& view, const Camera& camera, const std::vector<double>& light, double share)
{
  std::vector<Reflector> reflectors;
  const int across = (camera.width + PixelStep - 1) / PixelStep;
  for (int row = 0; row < camera.height; row += PixelStep)
  {
    for (int column = 0; column < camera.width; column += PixelStep)
    {
      const std::size_t i = static_cast<std::size_t>(row) * camera.width + column;
      const Vector3d ray = rayThrough(i, camera);
      const Vector3d normal = view.normals[i].normalized() * (view.normals[i].dot(ray) > 0.0 ? -1.0 : 1.0);
      const double z = view.depths[i];
      // A pixel's share of a slanted surface; as flat a view as the sensor measures at most.
      const double cosine = std::max(-normal.dot(ray.normalized()), 0.12);
      reflectors.push_back(
        { z * ray, normal, PixelStep * PixelStep * z * z / (camera.fx * camera.fy) / cosine, light[i] });
    }
  }
  std::vector<double> depths = view.depths;
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    const int column = static_cast<int>(i % camera.width);
    const int row = static_cast<int>(i / camera.width);
    const Vector3d ray = rayThrough(i, camera);
    const Vector3d place = view.depths[i] * ray;
    const Vector3d normal = view.normals[i].normalized() * (view.normals[i].dot(ray) > 0.0 ? -1.0 : 1.0);
    double sum = 0.0; // of light that came over a reflector
    double detour = 0.0;
    for (int y = std::max(row - Reach, 0) / PixelStep; y <= std::min(row + Reach, camera.height - 1) / PixelStep; ++y)
    {
      for (int x = std::max(column - Reach, 0) / PixelStep; x <= std::min(column + Reach, camera.width - 1) / PixelStep;
           ++x)
      {
        const Reflector& from = reflectors[static_cast<std::size_t>(y) * across + x];
        const Vector3d way = from.place - place;
        const double in = normal.dot(way);
        const double out = -from.normal.dot(way);
        if (in > 0.0 && out > 0.0)
        {
          // Form factor; a piece that is nearer than it is large counts as if it were as far as that.
          const double square = std::max(way.squaredNorm(), from.area);
          const double part = share * from.irradiance * from.area * in * out / (M_PI * square * square);
          sum += part;
          detour += part * 0.5 * (from.place.norm() + way.norm() - place.norm());
        }
      }
    }
    // The sensor sees the light that falls on the surface, straight and over others.
    if (sum > 0.0)
    {
      depths[i] += detour / (light[i] + sum) / ray.norm();
    }
  }
  return depths;
}

std::vector<double> mixedDepths(
  const std::vector<double>& depths, const std::vector<double>& light, const Camera& camera, double sigma)
{
  cv::Mat weights(camera.height, camera.width, CV_64F);
  cv::Mat ranges(camera.height, camera.width, CV_64F);
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    weights.at<double>(static_cast<int>(i)) = light[i];
    ranges.at<double>(static_cast<int>(i)) = light[i] * depths[i];
  }
  cv::GaussianBlur(weights, weights, cv::Size(), sigma);
  cv::GaussianBlur(ranges, ranges, cv::Size(), sigma);
  return ofIndices<double>(depths.size(), [&](int i) { return ranges.at<double>(i) / weights.at<double>(i); });
}
}
