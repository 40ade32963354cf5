// SPDX-License-Identifier: BSD-3-Clause
#include "scene/SceneEdgeExtraction.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
// The automatic high threshold: this share of the pixels has a stronger gradient...
constexpr double EdgeShare = 0.18;
// ...but never below what noise makes: some times the median, and this many grey values.
constexpr double NoiseInMedians = 4.0;
constexpr double LeastGradient = 20.0;
constexpr double LowShare = 0.4;
constexpr double JumpInPointDistances = 3.0;

std::string sizeOf(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

void check(const OrganizedCloud& cloud, const Image& image, const SceneEdgeExtractionSettings& settings)
{
  requirePoints(cloud.points, "The scene");
  if (cloud.height <= 1 || cloud.width <= 1 || cloud.size() != static_cast<std::size_t>(cloud.width) * cloud.height)
  {
    throw Error("The scene is not organized (it is " + sizeOf(cloud.width, cloud.height) +
                " points): edges of an image need a cloud with one point for each pixel.");
  }
  if (image.width != cloud.width || image.height != cloud.height)
  {
    throw Error("The image is " + sizeOf(image.width, image.height) + " pixels but the cloud is " +
                sizeOf(cloud.width, cloud.height) + " points: give the image that is registered with the cloud.");
  }
  if ((image.channels != 1 && image.channels != 3) || image.pixels.size() != cloud.size() * image.channels)
  {
    throw Error("The image must have one channel (grey) or three (red, green, blue), 8 bits each.");
  }
  const auto valid = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (!valid(settings.smoothing) || !valid(settings.lowThreshold) || !valid(settings.highThreshold) ||
      !valid(settings.depthJump) || settings.smoothing > 50.0 || settings.searchRadius < 0 ||
      settings.searchRadius > 50)
  {
    throw Error("Settings of the scene edges are out of range: smoothing and search radius are 0 "
                "to 50 pixels, "
                "thresholds and depth jump 0 or more.");
  }
}

double automaticThreshold(const cv::Mat& dx, const cv::Mat& dy)
{
  std::vector<float> gradients;
  gradients.reserve(dx.total());
  for (int row = 0; row < dx.rows; ++row)
  {
    const short* x = dx.ptr<short>(row);
    const short* y = dy.ptr<short>(row);
    for (int column = 0; column < dx.cols; ++column)
    {
      gradients.push_back(std::hypot(static_cast<float>(x[column]), static_cast<float>(y[column])));
    }
  }
  const auto quantile = [&](double share)
  {
    const auto at = gradients.begin() + static_cast<long>(share * static_cast<double>(gradients.size() - 1));
    std::nth_element(gradients.begin(), at, gradients.end());
    return static_cast<double>(*at);
  };
  return std::max({ quantile(1.0 - EdgeShare), NoiseInMedians * quantile(0.5), LeastGradient });
}

cv::Mat edgePixels(const Image& image, const SceneEdgeExtractionSettings& settings)
{
  // OpenCV wants a pointer that is not const; it only reads.
  cv::Mat grey(
    image.height, image.width, image.channels == 3 ? CV_8UC3 : CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
  if (image.channels == 3)
  {
    cv::cvtColor(cv::Mat(grey), grey, cv::COLOR_RGB2GRAY);
  }
  if (settings.smoothing > 0.0)
  {
    cv::Mat smooth;
    cv::GaussianBlur(grey, smooth, cv::Size(), settings.smoothing);
    grey = smooth;
  }
  cv::Mat dx, dy;
  cv::Sobel(grey, dx, CV_16S, 1, 0, 3, 1.0, 0.0, cv::BORDER_REPLICATE);
  cv::Sobel(grey, dy, CV_16S, 0, 1, 3, 1.0, 0.0, cv::BORDER_REPLICATE);
  const double high = settings.highThreshold > 0.0 ? settings.highThreshold : automaticThreshold(dx, dy);
  const double low = settings.lowThreshold > 0.0 ? settings.lowThreshold : LowShare * high;
  cv::Mat edges;
  cv::Canny(dx, dy, edges, std::min(low, high), high, true);
  return edges;
}

/// The median distance across the line of sight between neighbours in a row, in mm.
double pointDistance(const OrganizedCloud& cloud)
{
  std::vector<float> distances;
  for (std::size_t i = 0; i + 1 < cloud.size(); ++i)
  {
    const Eigen::Vector3f d = cloud.points[i + 1] - cloud.points[i];
    if (d.allFinite() && (i + 1) % cloud.width != 0)
    {
      distances.push_back(d.head<2>().norm());
    }
  }
  if (distances.empty())
  {
    return 0.0;
  }
  const auto middle = distances.begin() + static_cast<long>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

/// The grid point of an edge pixel, or -1: the closest pixel that is on the nearest surface around
/// it.
int pointOfPixel(const OrganizedCloud& cloud, int row, int column, int radius, float jump)
{
  const int top = std::max(row - radius, 0);
  const int bottom = std::min(row + radius, cloud.height - 1);
  const int left = std::max(column - radius, 0);
  const int right = std::min(column + radius, cloud.width - 1);
  const auto forEach = [&](const auto& visit)
  {
    for (int r = top; r <= bottom; ++r)
    {
      for (int c = left; c <= right; ++c)
      {
        const int index = r * cloud.width + c;
        if (cloud.points[index].allFinite())
        {
          visit(index, cloud.points[index].z(), (r - row) * (r - row) + (c - column) * (c - column));
        }
      }
    }
  };
  float nearest = std::numeric_limits<float>::infinity();
  forEach([&](int, float z, int) { nearest = std::min(nearest, z); });
  int best = -1;
  int bestPixels = 0;
  forEach(
    [&](int index, float z, int pixels)
    {
      if (z <= nearest + jump &&
          (best < 0 || pixels < bestPixels || (pixels == bestPixels && z < cloud.points[best].z())))
      {
        best = index;
        bestPixels = pixels;
      }
    });
  return best;
}
}

PointCloud extractSceneEdges(const OrganizedCloud& cloud, const Image& image,
  const SceneEdgeExtractionSettings& settings, const Progress& progress)
{
  check(cloud, image, settings);
  report(progress, 0.0);
  const cv::Mat edges = edgePixels(image, settings);
  report(progress, 0.6);

  const double jump = settings.depthJump > 0.0 ? settings.depthJump : JumpInPointDistances * pointDistance(cloud);
  std::vector<bool> taken(cloud.size(), false);
  for (int row = 0; row < cloud.height; ++row)
  {
    const std::uint8_t* isEdge = edges.ptr<std::uint8_t>(row);
    for (int column = 0; column < cloud.width; ++column)
    {
      const int point =
        isEdge[column] ? pointOfPixel(cloud, row, column, settings.searchRadius, static_cast<float>(jump)) : -1;
      if (point >= 0)
      {
        taken[point] = true;
      }
    }
  }
  PointCloud result;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (taken[i])
    {
      result.points.push_back(cloud.points[i]);
      result.pointIds.push_back(static_cast<int>(i));
    }
  }
  report(progress, 1.0);
  return result;
}
}
