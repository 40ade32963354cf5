// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/LongLines.h"

#include "base/Error.h"
#include "base/Parallel.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
struct Lengths
{
  float step, straight, tolerance; ///< mm
  float parallel;                  ///< cosine
  int mostMissing;
};

/// Where a line of edges goes on from a point, in steps, as long as there are edges. The direction follows them at
/// first.
Points walk(const PointCloud& edges, const EdgeIndex& index, const Eigen::Vector3f& start, Eigen::Vector3f& direction,
  const Lengths& lengths)
{
  Points line;
  int missing = 0;
  for (int k = 1; missing <= lengths.mostMissing; ++k)
  {
    const float along = static_cast<float>(k) * lengths.step;
    const Eigen::Vector3f expected = start + along * direction;
    const EdgeIndex::Match match = index.nearest(expected, direction, lengths.tolerance);
    if (match.edge < 0 || std::abs(edges.tangents[match.edge].dot(direction)) < lengths.parallel)
    {
      ++missing;
      continue;
    }
    missing = 0;
    const Eigen::Vector3f &point = edges.points[match.edge], &tangent = edges.tangents[match.edge];
    const Eigen::Vector3f found = point + tangent * tangent.dot(expected - point);
    line.push_back(found);
    if (along < lengths.straight)
    {
      direction = (found - start).normalized();
    }
  }
  return line;
}
}

std::vector<unsigned char> onLongLines(const PointCloud& edges, const EdgeIndex& index, double partDiameter,
  double tolerance, const LongLineSettings& settings, int threads)
{
  if (!(settings.step > 0.0))
  {
    throw Error("The step along lines of edges must be positive.");
  }
  const auto inMM = [&](double share) { return static_cast<float>(share * partDiameter); };
  const Lengths lengths{ inMM(settings.step), inMM(settings.straight), static_cast<float>(tolerance),
    static_cast<float>(settings.parallel), settings.mostMissing };
  const float least = inMM(settings.leastLength);
  const std::vector<int> seeds = thinPoints(edges.points, settings.seedCell * partDiameter);
  std::vector<Points> lines(seeds.size());
  parallelFor(static_cast<int>(lines.size()), threads, {},
    [&](int begin, int end, int)
    {
      for (int s = begin; s < end; ++s)
      {
        const Eigen::Vector3f& start = edges.points[seeds[s]];
        Eigen::Vector3f direction = edges.tangents[seeds[s]];
        const Points ahead = walk(edges, index, start, direction, lengths);
        direction = -direction;
        Points line = walk(edges, index, start, direction, lengths);
        std::reverse(line.begin(), line.end());
        line.push_back(start);
        line.insert(line.end(), ahead.begin(), ahead.end());
        if ((line.back() - line.front()).norm() >= least)
        {
          lines[s] = std::move(line);
        }
      }
    });
  std::vector<unsigned char> result(edges.size(), 0);
  const float reach = std::max(lengths.step, lengths.tolerance);
  for (const Points& line : lines)
  {
    if (line.empty())
    {
      continue;
    }
    const Eigen::Vector3f direction = (line.back() - line.front()).normalized();
    for (const Eigen::Vector3f& place : line)
    {
      index.grid().forEachWithin(place, reach,
        [&](int i, float)
        {
          const float across = (edges.points[i] - place).cross(direction).norm();
          const bool isOn =
            across <= lengths.tolerance && std::abs(edges.tangents[i].dot(direction)) >= lengths.parallel;
          result[i] |= isOn ? 1 : 0;
        });
    }
  }
  return result;
}
}
