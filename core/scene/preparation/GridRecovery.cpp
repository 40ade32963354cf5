// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/GridRecovery.h"

#include "base/sequences/Quantiles.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace meam
{
namespace
{
constexpr std::size_t FewestOfGrid = 500;    // few points lie on some lattice by chance
constexpr std::size_t CombSamples = 100000;  // values that the spectrum is of, spread evenly
constexpr std::size_t RefineSamples = 10000; // and of these those that the step is refined by
constexpr int Bins = 1 << 16;                // of the histogram that is transformed:
constexpr int MostColumns = Bins / 4;        // four for each column and more,
constexpr int FewestColumns = 16;            // and fewer columns are no image of a bin
constexpr double Stray = 0.001;              // share of the values at each end that the histogram leaves out
constexpr double LeastPeak = 0.35;           // of a spectrum of 1 for equal values: half a bin beside one it is 0.64
constexpr double NearNode = 0.25;            // steps; of values on no lattice one half is so near,
constexpr double LeastOnNodes = 0.9;         // and of those that are jittered by a sixth of a step so many
constexpr double LeastFill = 1.0 / 3.0;      // of a grid that was found: of one with holes everywhere little is known
constexpr double EqualSteps = 0.01;          // share by which steps that are one may differ

/// Numbers that are multiples of a step.
struct Comb
{
  double frequency = 0.0; ///< of the step
  double phase = 0.0;     ///< steps, of the value 0
};

std::complex<double> coherence(const std::vector<double>& values, double frequency)
{
  std::complex<double> sum = 0.0;
  for (const double value : values)
  {
    sum += std::polar(1.0, 2.0 * M_PI * frequency * value);
  }
  return sum / static_cast<double>(values.size());
}

/// The frequency near this one at which the values agree best, by golden section.
double refined(const std::vector<double>& values, double frequency, double width)
{
  const double golden = (std::sqrt(5.0) - 1.0) / 2.0;
  double low = frequency - width, high = frequency + width;
  for (int step = 0; step < 30; ++step) // to a millionth of the width
  {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (std::abs(coherence(values, a)) > std::abs(coherence(values, b)))
    {
      high = b;
    }
    else
    {
      low = a;
    }
  }
  return 0.5 * (low + high);
}

std::vector<double> everySo(const std::vector<double>& values, std::size_t most)
{
  std::vector<double> some;
  const std::size_t count = std::min(values.size(), most);
  for (std::size_t i = 0; i < count; ++i)
  {
    some.push_back(values[i * values.size() / count]);
  }
  return some;
}

/// The largest step that the values are multiples of, by the spectrum of their histogram.
std::optional<Comb> findComb(const std::vector<double>& all)
{
  const std::vector<double> values = everySo(all, CombSamples), few = everySo(all, RefineSamples);
  if (values.empty())
  {
    return std::nullopt;
  }
  std::vector<double> sorted = values;
  const double low = quantileOf(sorted, Stray), high = quantileOf(sorted, 1.0 - Stray);
  if (!(high > low))
  {
    return std::nullopt;
  }
  cv::Mat histogram(1, Bins, CV_32F, cv::Scalar(0)), spectrum;
  for (const double value : values)
  {
    const double bin = (value - low) / (high - low) * Bins;
    if (bin >= 0.0 && bin < Bins)
    {
      histogram.at<float>(static_cast<int>(bin)) += 1.0f;
    }
  }
  cv::dft(histogram, spectrum, cv::DFT_COMPLEX_OUTPUT);
  const auto peak = [&](int k)
  { return std::abs(spectrum.at<std::complex<float>>(k)) / static_cast<double>(values.size()); };
  for (int k = FewestColumns; k < MostColumns; ++k)
  {
    if (peak(k) < LeastPeak || peak(k) < peak(k - 1) || peak(k) < peak(k + 1))
    {
      continue;
    }
    const double width = 1.0 / (high - low), frequency = refined(few, k * width, width);
    const double phase = std::arg(coherence(few, frequency)) / (2.0 * M_PI);
    const auto isNear = [&](double value)
    {
      const double place = frequency * value - phase;
      return std::abs(place - std::round(place)) < NearNode;
    };
    if (static_cast<double>(std::count_if(few.begin(), few.end(), isNear)) >=
        LeastOnNodes * static_cast<double>(few.size()))
    {
      return Comb{ frequency, -phase };
    }
  }
  return std::nullopt;
}

/// Of each finite point what the function says.
template <typename Value>
std::vector<double> valuesOf(const Points& points, const Value& value)
{
  std::vector<double> values;
  values.reserve(points.size());
  for (const Eigen::Vector3f& point : points)
  {
    if (point.allFinite())
    {
      values.push_back(value(point));
    }
  }
  return values;
}
}

std::optional<RasterView> recoverGrid(const Points& points, bool perspective)
{
  if (points.size() < FewestOfGrid)
  {
    return std::nullopt;
  }
  RasterView view;
  view.perspective = perspective;
  for (int k = 0; k < 2; ++k)
  {
    const auto comb = findComb(valuesOf(points, [&](const Eigen::Vector3f& point) { return view.lookAt(point)[k]; }));
    if (!comb)
    {
      return std::nullopt;
    }
    view.pixels[k] = comb->frequency;
    view.offset[k] = comb->phase;
  }
  if (!perspective)
  {
    // Coordinates that were rounded to so many digits are on a lattice in depth, too.
    const auto depth = findComb(valuesOf(points, [](const Eigen::Vector3f& point) { return point.z(); }));
    if (depth && std::abs(depth->frequency - view.pixels.x()) < EqualSteps * view.pixels.x())
    {
      return std::nullopt;
    }
  }
  return fillOf(rasterize(points, view)) < LeastFill ? std::nullopt : std::optional(view);
}

double offGrid(const Points& points, const RasterView& view)
{
  double sum = 0.0, count = 0.0;
  for (const Eigen::Vector3f& point : points)
  {
    const Eigen::Array2d pixel = view.lookAt(point).cwiseProduct(view.pixels) + view.offset;
    if (pixel.isFinite().all())
    {
      sum += (pixel - pixel.round()).abs().sum();
      count += 2.0;
    }
  }
  return sum / count;
}
}
