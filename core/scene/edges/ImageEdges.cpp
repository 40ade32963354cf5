// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/ImageEdges.h"

#include "base/AllVectors.h"
#include "base/Parallel.h"
#include "base/Range.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

namespace meam
{
namespace
{
constexpr double EdgeShare = 0.18;     // the gradient that this share of the pixels exceeds
constexpr double GradientNoises = 5.0; // standard deviations of what noise does to the gradient
constexpr double LeastGradient = 12.0; // grey values
constexpr double LowShare = 0.4;       // of the high threshold
constexpr int Dark = 3;                // grey values: darker pixels hide their noise,
constexpr int Bright = 252;            // and so do brighter ones

// The gradient of pure noise is spread as Rayleigh found: half of it is below 1.18 standard deviations.
const double RayleighMedian = std::sqrt(2.0 * std::log(2.0)); // of that distribution

void check(const Image& image, const ImageEdgeSettings& settings)
{
  if (image.width < 1 || image.height < 1 || (image.channels != 1 && image.channels != 3) ||
      image.pixels.size() != static_cast<std::size_t>(image.width) * image.height * image.channels)
  {
    throw Error("The image must have pixels of one channel (grey) or three (red, green, blue), 8 bits each.");
  }
  requireWithin("smoothing of the image", settings.smoothing, 0.0, 50.0, " pixels");
  requireWithin("low threshold of the image's edges", settings.lowThreshold, 0.0, Unbounded);
  requireWithin("high threshold of the image's edges", settings.highThreshold, 0.0, Unbounded);
}

cv::Mat smoothGrey(const Image& image, double smoothing)
{
  // OpenCV wants a pointer that is not const; it only reads.
  cv::Mat grey(
    image.height, image.width, image.channels == 3 ? CV_8UC3 : CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
  if (image.channels == 3)
  {
    cv::cvtColor(cv::Mat(grey), grey, cv::COLOR_RGB2GRAY);
  }
  if (smoothing > 0.0)
  {
    cv::Mat smooth;
    cv::GaussianBlur(grey, smooth, cv::Size(), smoothing);
    grey = smooth;
  }
  return grey;
}

constexpr double GradientSteps = 4.0; // of a grey value, how finely gradients are counted
constexpr int GradientBins = 6144;    // more than Sobel makes of 8 bits, sqrt(2) times 4 times 255, in steps

/// How many pixels have each gradient.
using Histogram = std::array<std::size_t, GradientBins>;

/// The gradient below which a share of the pixels lies; 0 without pixels.
double quantile(const Histogram& histogram, double share)
{
  const std::size_t total = std::accumulate(histogram.begin(), histogram.end(), std::size_t{ 0 });
  if (total == 0)
  {
    return 0.0;
  }
  const double wanted = share * static_cast<double>(total);
  double below = 0.0;
  int bin = 0;
  while (bin < GradientBins && below + static_cast<double>(histogram[bin]) < wanted)
  {
    below += static_cast<double>(histogram[bin++]);
  }
  return (bin + 0.5) / GradientSteps;
}

/// The gradients' bins of a row, and GradientBins more for pixels that are nearly black or white.
MEAM_ALL_VECTORS
void binsOf(const std::uint8_t* value, const short* x, const short* y, int count, int* bins)
{
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float gradient = std::sqrt(static_cast<float>(x[k] * x[k] + y[k] * y[k]));
    const bool isSaturated = (value[k] < Dark) | (value[k] > Bright);
    bins[k] = static_cast<int>(static_cast<float>(GradientSteps) * gradient) + (isSaturated ? GradientBins : 0);
  }
}

double automaticThreshold(const cv::Mat& grey, const cv::Mat& dx, const cv::Mat& dy, int threads)
{
  Histogram all{}, unsaturated{};
  const int used = numberOfThreads(threads);
  std::vector<std::vector<std::uint32_t>> counts(used);
  parallelFor(grey.rows, used, {},
    [&](int begin, int end, int thread)
    {
      std::vector<std::uint32_t>& mine = counts[thread];
      mine.resize(2 * GradientBins);
      std::vector<int> bins(grey.cols);
      for (int row = begin; row < end; ++row)
      {
        binsOf(grey.ptr<std::uint8_t>(row), dx.ptr<short>(row), dy.ptr<short>(row), grey.cols, bins.data());
        for (const int bin : bins)
        {
          ++mine[bin];
        }
      }
    });
  for (const std::vector<std::uint32_t>& some : counts)
  {
    for (std::size_t bin = 0; bin < some.size(); ++bin)
    {
      all[bin % GradientBins] += some[bin];
      unsaturated[bin % GradientBins] += bin < GradientBins ? some[bin] : 0;
    }
  }
  const double noise = quantile(unsaturated, 0.5) / RayleighMedian;
  return std::max({ quantile(all, 1.0 - EdgeShare), GradientNoises * noise, LeastGradient });
}

/// Across the gradients around a pixel, summed so that opposite ones agree (the structure tensor).
Eigen::Vector2f edgeDirection(const cv::Mat& dx, const cv::Mat& dy, int row, int column)
{
  float xx = 0.0f;
  float xy = 0.0f;
  float yy = 0.0f;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, dx.rows - 1); ++r)
  {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, dx.cols - 1); ++c)
    {
      const float x = dx.at<short>(r, c);
      const float y = dy.at<short>(r, c);
      xx += x * x;
      xy += x * y;
      yy += y * y;
    }
  }
  const float angle = 0.5f * std::atan2(2.0f * xy, xx - yy);
  return { -std::sin(angle), std::cos(angle) };
}
}

std::vector<EdgePixel> findImageEdges(const Image& image, const ImageEdgeSettings& settings, int threads)
{
  check(image, settings);
  const cv::Mat grey = smoothGrey(image, settings.smoothing);
  cv::Mat dx, dy;
  inParallel(threads, { [&] { cv::Sobel(grey, dx, CV_16S, 1, 0, 3, 1.0, 0.0, cv::BORDER_REPLICATE); },
                        [&] { cv::Sobel(grey, dy, CV_16S, 0, 1, 3, 1.0, 0.0, cv::BORDER_REPLICATE); } });
  const double high = settings.highThreshold > 0.0 ? settings.highThreshold : automaticThreshold(grey, dx, dy, threads);
  const double low = settings.lowThreshold > 0.0 ? settings.lowThreshold : LowShare * high;
  cv::Mat edges;
  cv::Canny(dx, dy, edges, std::min(low, high), high, true);

  std::vector<EdgePixel> result;
  for (int row = 0; row < edges.rows; ++row)
  {
    const std::uint8_t* const begin = edges.ptr<std::uint8_t>(row);
    const std::uint8_t* const end = begin + edges.cols;
    constexpr int isEdge = 255; // a mark
    for (const void* at = begin; (at = std::memchr(at, isEdge, end - static_cast<const std::uint8_t*>(at)));)
    {
      const auto* pixel = static_cast<const std::uint8_t*>(at);
      result.push_back({ static_cast<int>(pixel - begin), row });
      at = pixel + 1;
    }
  }
  parallelForEach(static_cast<int>(result.size()), threads, {},
    [&](int i) { result[i].direction = edgeDirection(dx, dy, result[i].row, result[i].column); });
  return result;
}
}
