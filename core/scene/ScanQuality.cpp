// SPDX-License-Identifier: BSD-3-Clause
#include "scene/ScanQuality.h"

#include "base/Error.h"
#include "base/Parallel.h"
#include "base/sequences/Quantiles.h"
#include "scene/OrganizedCloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <vector>

namespace meam
{
namespace
{
constexpr int Samples = 100000;                            // points of the grid that are looked at, about
constexpr std::array<int, 7> Lags{ 1, 2, 3, 4, 6, 8, 12 }; // points in a row, so far apart, tell of the noise
constexpr double Growth =
  1.0 / 3.0;                  // power of the distance with which noise of points that do not share it grows at most
constexpr double Ties = 0.03; // share of neighbours of the same depth, from which on the sensor's steps are seen
constexpr double LongestGap = 0.02; // of a row: a longer hole is not one that a jump made

// Standard deviations, the mean of the half of a normal distribution that is nearest to 0.
constexpr double SmallerHalf = 0.3247;          // of that distribution
const double ThirdDifference = std::sqrt(20.0); // standard deviations, of points that share no noise

/// Every so many rows.
int strideOf(const OrganizedCloud& cloud)
{
  return std::max(1, static_cast<int>(cloud.size() / static_cast<std::size_t>(Samples)));
}

const Eigen::Vector3f* rowOf(const OrganizedCloud& cloud, int row)
{
  return cloud.points.data() + static_cast<std::size_t>(row) * cloud.width;
}

/// What third differences of the depth of points `lag` apart say: their smaller half, the rest may be edges.
double noiseAt(const OrganizedCloud& cloud, int lag, int stride)
{
  std::vector<float> bends;
  for (int row = stride / 2; row < cloud.height; row += stride)
  {
    const Eigen::Vector3f* points = rowOf(cloud, row);
    for (int column = 3 * lag; column < cloud.width; ++column)
    {
      const float bend = points[column].z() - points[column - 3 * lag].z() +
                         3.0f * (points[column - 2 * lag].z() - points[column - lag].z());
      if (std::isfinite(bend))
      {
        bends.push_back(std::abs(bend));
      }
    }
  }
  if (bends.empty())
  {
    return 0.0;
  }
  const auto half = bends.begin() + static_cast<std::ptrdiff_t>((bends.size() + 1) / 2);
  std::nth_element(bends.begin(), half - 1, bends.end());
  return std::accumulate(bends.begin(), half, 0.0) / (half - bends.begin()) / (SmallerHalf * ThirdDifference);
}

struct Steps
{
  double pointDistance, depthStep;
};

Steps stepsOf(const OrganizedCloud& cloud, int stride)
{
  std::vector<float> distances, differences;
  for (int row = stride / 2; row < cloud.height; row += stride)
  {
    const Eigen::Vector3f* points = rowOf(cloud, row);
    for (int column = 1; column < cloud.width; ++column)
    {
      const Eigen::Vector3f step = points[column] - points[column - 1];
      if (step.allFinite())
      {
        distances.push_back(step.head<2>().norm());
        const float least = 1e-6f * std::abs(points[column].z()); // single precision, of equal depths
        differences.push_back(std::abs(step.z()) > least ? std::abs(step.z()) : 0.0f);
      }
    }
  }
  const auto firstStep = std::partition(differences.begin(), differences.end(), [](float d) { return d == 0.0f; });
  const auto equal = static_cast<double>(firstStep - differences.begin());
  const auto unequal = static_cast<double>(differences.end() - firstStep);
  const double least = Ties * static_cast<double>(differences.size());
  Steps steps{ quantileOf(distances, 0.5), 0.0 };
  if (equal > least && unequal > least) // few that differ are edges
  {
    std::vector<float> changes(firstStep, differences.end());
    steps.depthStep = quantileOf(changes, Ties); // there are about twice as many single steps as ties
  }
  return steps;
}

/// Counts depth jumps along the rows, the holes in them and the points that hang in them.
void lookAtJumps(const OrganizedCloud& cloud, int stride, ScanQuality& quality)
{
  const double jump = JumpSlopes * quality.pointDistance + JumpNoises * quality.noise;
  const int longest = std::max(1, static_cast<int>(LongestGap * cloud.width));
  int jumps = 0, gaps = 0, flying = 0, measured = 0, looked = 0;
  for (int row = stride / 2; row < cloud.height; row += stride)
  {
    const Eigen::Vector3f* points = rowOf(cloud, row);
    int last = -1;
    double before = 0.0; // the step to the last point, when that was a jump without a gap
    bool counted = false;
    for (int column = 0; column < cloud.width; ++column)
    {
      ++looked;
      if (!points[column].allFinite())
      {
        continue;
      }
      ++measured;
      const int gap = column - last - 1;
      const double step = last < 0 ? 0.0 : points[column].z() - points[last].z();
      if (last >= 0 && std::abs(step) > jump * (gap + 1) && gap <= longest)
      {
        const bool hangs = gap == 0 && before * step > 0.0;
        if (hangs)
        {
          flying += counted ? 0 : 1;
          counted = true;
        }
        else
        {
          ++jumps;
          counted = false;
        }
        gaps += gap;
        before = step;
      }
      else
      {
        before = 0.0;
      }
      last = column;
    }
  }
  quality.jumpGap = jumps > 0 ? static_cast<double>(gaps) / jumps : 0.0;
  quality.flying = jumps > 0 ? static_cast<double>(flying) / jumps : 0.0;
  quality.coverage = looked > 0 ? static_cast<double>(measured) / looked : 0.0;
}
}

ScanQuality measureQuality(const OrganizedCloud& cloud, int threads)
{
  if (cloud.size() != static_cast<std::size_t>(cloud.width) * static_cast<std::size_t>(cloud.height))
  {
    throw Error("A scan's quality is measured in the rows of its grid: the scan is not organized.");
  }
  if (cloud.height < 2)
  {
    return {};
  }
  const int stride = strideOf(cloud);
  std::vector<double> noise(Lags.size(), 0.0);
  Steps steps{};
  std::vector<std::function<void()>> works{ [&] { steps = stepsOf(cloud, stride); } };
  for (std::size_t i = 0; i < Lags.size(); ++i)
  {
    works.emplace_back([&, i] { noise[i] = noiseAt(cloud, Lags[i], stride); });
  }
  inParallel(threads, works);

  ScanQuality quality;
  quality.pointDistance = steps.pointDistance;
  quality.depthStep = steps.depthStep;
  const auto steady = [&](std::size_t i)
  { return noise[i + 1] <= noise[i] * std::pow(static_cast<double>(Lags[i + 1]) / Lags[i], Growth); };
  std::size_t apart = 0;
  while (apart + 1 < Lags.size() && !steady(apart))
  {
    ++apart;
  }
  apart = apart + 1 < Lags.size() ? apart : 0; // it never is: the surface's own bends
  quality.smoothing = Lags[apart];
  quality.noise = std::max(noise[apart], quality.depthStep / std::sqrt(12.0));
  lookAtJumps(cloud, stride, quality);
  return quality;
}

std::string describe(const ScanQuality& quality)
{
  if (!quality.isKnown())
  {
    return "The scan has no neighbouring points: how well it was measured is not known.";
  }
  const auto number = [](double value, int digits)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return std::string(text);
  };
  std::string text =
    "Points " + number(quality.pointDistance, 2) + " mm apart; noise " + number(quality.noise, 2) + " mm";
  if (quality.smoothing > 1.0)
  {
    text += ", alike over " + number(quality.smoothing, 0) + " points";
  }
  if (quality.depthStep > 0.0)
  {
    text += "; depth in steps of " + number(quality.depthStep, 3) + " mm";
  }
  return text + "; depth at " + number(100.0 * quality.coverage, 0) + " % of the points; at depth jumps " +
         number(quality.jumpGap, 1) + " points without depth, and in " + number(100.0 * quality.flying, 0) +
         " % of them a stray point between.";
}
}
