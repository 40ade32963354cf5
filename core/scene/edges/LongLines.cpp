// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/LongLines.h"

#include "base/Parallel.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
// Lengths as shares of the part's diameter. Without long lines 50 poses of flat parts in four bins are between 0.3 and
// 0.7 likely instead of 8.
constexpr double LeastLength = 1.25; // no straight edge of the part is longer than its diameter
constexpr double Step = 0.05;        // from one point of a line to the next
constexpr double Straight = 0.4;     // so far from a line's first point its direction is told; from there on it stays
constexpr float Parallel = 0.95f;    // cosine between line and tangents
constexpr int MostMissing = 1;       // steps in a row without an edge
constexpr double SeedCell = 0.1;     // of the edge points in a cube of this side a line is looked for from one

struct Lengths
{
  float step, straight, tolerance; ///< mm
};

/// Where a line of edges goes on from a point, in steps, as long as there are edges. The direction follows them at
/// first.
Points walk(const PointCloud& edges, const EdgeIndex& index, const Eigen::Vector3f& start, Eigen::Vector3f& direction,
  const Lengths& lengths)
{
  Points line;
  int missing = 0;
  for (int k = 1; missing <= MostMissing; ++k)
  {
    const float along = static_cast<float>(k) * lengths.step;
    const Eigen::Vector3f expected = start + along * direction;
    const EdgeIndex::Match match = index.nearest(expected, direction, lengths.tolerance);
    if (match.edge < 0 || std::abs(edges.tangents[match.edge].dot(direction)) < Parallel)
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

std::vector<unsigned char> onLongLines(
  const PointCloud& edges, const EdgeIndex& index, double partDiameter, double tolerance, int threads)
{
  const auto inMM = [&](double share) { return static_cast<float>(share * partDiameter); };
  const Lengths lengths{ inMM(Step), inMM(Straight), static_cast<float>(tolerance) };
  const float least = inMM(LeastLength);
  const std::vector<int> seeds = thinPoints(edges.points, SeedCell * partDiameter);
  std::vector<Points> lines(seeds.size());
  parallelForEach(static_cast<int>(lines.size()), threads, {},
    [&](int s)
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
          const bool isOn = across <= lengths.tolerance && std::abs(edges.tangents[i].dot(direction)) >= Parallel;
          result[i] |= isOn ? 1 : 0;
        });
    }
  }
  return result;
}
}
