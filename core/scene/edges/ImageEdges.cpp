// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/ImageEdges.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
// The automatic high threshold: this share of the pixels has a stronger gradient...
constexpr double EdgeShare = 0.18;
// ...but never below what noise makes: some times its standard deviation, and this many grey values.
constexpr double NoiseDeviations = 5.0;
constexpr double LeastGradient = 12.0;
constexpr double LowShare = 0.4;
// The gradient of pure noise is spread as Rayleigh found: half of it is below 1.18 standard deviations.
const double RayleighMedian = std::sqrt(2.0 * std::log(2.0));
// Pixels that are nearly black or white hide their noise.
constexpr int Dark = 3;
constexpr int Bright = 252;

void check(const Image& image, const ImageEdgeSettings& settings)
{
  if (image.width < 1 || image.height < 1 || (image.channels != 1 && image.channels != 3) ||
      image.pixels.size() != static_cast<std::size_t>(image.width) * image.height * image.channels)
  {
    throw Error("The image must have pixels of one channel (grey) or three (red, green, blue), 8 bits each.");
  }
  const auto valid = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (!valid(settings.smoothing) || !valid(settings.lowThreshold) || !valid(settings.highThreshold) ||
      settings.smoothing > 50.0)
  {
    throw Error("Settings of the image's edges are out of range: smoothing is 0 to 50 pixels, thresholds are 0 or "
                "more.");
  }
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

/// Counts of whole numbers, and the number below which a share of them lies.
class Histogram
{
public:
  void add(float value)
  {
    const std::size_t bin = static_cast<std::size_t>(Steps * value);
    this->Counts.resize(std::max(this->Counts.size(), bin + 1));
    ++this->Counts[bin];
    ++this->Total;
  }
  double quantile(double share) const
  {
    const double wanted = share * static_cast<double>(this->Total);
    double below = 0.0;
    std::size_t bin = 0;
    while (bin < this->Counts.size() && below + static_cast<double>(this->Counts[bin]) < wanted)
    {
      below += static_cast<double>(this->Counts[bin++]);
    }
    return (static_cast<double>(bin) + 0.5) / Steps;
  }
  bool empty() const { return this->Total == 0; }

private:
  static constexpr double Steps = 4.0; // of a grey value
  std::vector<std::size_t> Counts;
  std::size_t Total = 0;
};

double automaticThreshold(const cv::Mat& grey, const cv::Mat& dx, const cv::Mat& dy)
{
  Histogram all;
  Histogram unsaturated;
  for (int row = 0; row < dx.rows; ++row)
  {
    const std::uint8_t* value = grey.ptr<std::uint8_t>(row);
    const short* x = dx.ptr<short>(row);
    const short* y = dy.ptr<short>(row);
    for (int column = 0; column < dx.cols; ++column)
    {
      const float gradient = std::sqrt(static_cast<float>(x[column] * x[column] + y[column] * y[column]));
      all.add(gradient);
      if (value[column] >= Dark && value[column] <= Bright)
      {
        unsaturated.add(gradient);
      }
    }
  }
  const double noise = unsaturated.empty() ? 0.0 : unsaturated.quantile(0.5) / RayleighMedian;
  return std::max({ all.quantile(1.0 - EdgeShare), NoiseDeviations * noise, LeastGradient });
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

std::vector<EdgePixel> findImageEdges(const Image& image, const ImageEdgeSettings& settings)
{
  check(image, settings);
  const cv::Mat grey = smoothGrey(image, settings.smoothing);
  cv::Mat dx, dy;
  cv::Sobel(grey, dx, CV_16S, 1, 0, 3, 1.0, 0.0, cv::BORDER_REPLICATE);
  cv::Sobel(grey, dy, CV_16S, 0, 1, 3, 1.0, 0.0, cv::BORDER_REPLICATE);
  const double high = settings.highThreshold > 0.0 ? settings.highThreshold : automaticThreshold(grey, dx, dy);
  const double low = settings.lowThreshold > 0.0 ? settings.lowThreshold : LowShare * high;
  cv::Mat edges;
  cv::Canny(dx, dy, edges, std::min(low, high), high, true);

  std::vector<EdgePixel> result;
  for (int row = 0; row < edges.rows; ++row)
  {
    const std::uint8_t* isEdge = edges.ptr<std::uint8_t>(row);
    for (int column = 0; column < edges.cols; ++column)
    {
      if (isEdge[column])
      {
        result.push_back({ column, row, edgeDirection(dx, dy, row, column) });
      }
    }
  }
  return result;
}
}
