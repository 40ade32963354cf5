// SPDX-License-Identifier: BSD-3-Clause
#include "pose/EdgeLines.h"

#include "AllVectors.h"

#include <cstring>

namespace meam
{
namespace
{
constexpr float ParallelTangents = 0.85f; // cosine
constexpr float NearlyParallel = 0.8f;    // five degrees more
constexpr int Lanes = 8;                  // edge points looked at together
constexpr int MostRanges = 64;

struct Query
{
  Eigen::Vector3f point, tangent;
  float squaredRadius;
};

using Columns = std::array<std::vector<float>, 6>;

struct Range
{
  int begin, end;
};

/// The nearest of each lane so far.
struct Nearest
{
  float distances[Lanes];
  int places[Lanes];
};

MEAM_ALL_VECTORS
void search(const Columns& edges, const Range* ranges, int count, const Query& query, Nearest& nearest)
{
  const float *ex = edges[0].data(), *ey = edges[1].data(), *ez = edges[2].data();
  const float *tangentX = edges[3].data(), *tangentY = edges[4].data(), *tangentZ = edges[5].data();
  const float px = query.point.x(), py = query.point.y(), pz = query.point.z();
  const float qx = query.tangent.x(), qy = query.tangent.y(), qz = query.tangent.z();
  const float squaredRadius = query.squaredRadius;
  float distances[Lanes];
  int places[Lanes];
#pragma omp simd
  for (int lane = 0; lane < Lanes; ++lane)
  {
    distances[lane] = nearest.distances[lane];
    places[lane] = nearest.places[lane];
  }
  for (int r = 0; r < count; ++r)
  {
    const int end = ranges[r].end;
    for (int begin = ranges[r].begin; begin < end; begin += Lanes)
    {
#pragma omp simd
      for (int lane = 0; lane < Lanes; ++lane) // the last ones may be of the next range
      {
        const int k = begin + lane;
        const float tx = tangentX[k], ty = tangentY[k], tz = tangentZ[k];
        const float dx = px - ex[k], dy = py - ey[k], dz = pz - ez[k];
        const float cx = ty * dz - tz * dy, cy = tz * dx - tx * dz, cz = tx * dy - ty * dx;
        const float squared = dx * dx + dy * dy + dz * dz;
        const float across = cx * cx + cy * cy + cz * cz;
        const float cosine = std::abs(tx * qx + ty * qy + tz * qz);
        const bool nearer =
          (k < end) & (squared <= squaredRadius) & (cosine > ParallelTangents) & (across < distances[lane]);
        distances[lane] = nearer ? across : distances[lane];
        places[lane] = nearer ? k : places[lane];
      }
    }
  }
#pragma omp simd
  for (int lane = 0; lane < Lanes; ++lane)
  {
    nearest.distances[lane] = distances[lane];
    nearest.places[lane] = places[lane];
  }
}
}

EdgeLines::EdgeLines(const PointCloud& edges, const PointGrid& grid)
  : Grid(grid)
{
  for (std::vector<float>& column : this->Columns)
  {
    column.assign(grid.order().size() + Lanes, 0.0f);
  }
  for (std::size_t k = 0; k < grid.order().size(); ++k)
  {
    const int i = grid.order()[k];
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Columns[axis][k] = edges.points[i][axis];
      this->Columns[3 + axis][k] = edges.tangents[i][axis];
    }
  }
}

template <typename Visitor>
void EdgeLines::forEachRanges(const Eigen::Vector3f& point, double radius, Visitor&& visit) const
{
  Range ranges[MostRanges];
  int count = 0;
  this->Grid.forEachRange(point, radius,
    [&](int begin, int end)
    {
      if (begin < end)
      {
        ranges[count++] = { begin, end };
      }
      if (count == MostRanges)
      {
        visit(ranges, count);
        count = 0;
      }
    });
  if (count > 0)
  {
    visit(ranges, count);
  }
}

EdgeLines::Match EdgeLines::nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& tangent, double radius) const
{
  const Query query{ point, tangent, static_cast<float>(radius) * static_cast<float>(radius) };
  Nearest nearest;
  std::fill_n(nearest.distances, Lanes, query.squaredRadius);
  std::fill_n(nearest.places, Lanes, -1);
  this->forEachRanges(point, radius,
    [&](const Range* ranges, int count) { search(this->Columns, ranges, count, query, nearest); });
  // Without a branch: floats from 0 on are ordered as their bits are. What is not found is farther than all that is.
  std::uint64_t least = ~std::uint64_t(0);
  for (int lane = 0; lane < Lanes; ++lane)
  {
    std::uint32_t distance;
    std::memcpy(&distance, &nearest.distances[lane], sizeof(distance));
    least = std::min(least, std::uint64_t(distance) << 32 | static_cast<std::uint32_t>(nearest.places[lane]));
  }
  const int place = static_cast<int>(least & 0xffffffffu);
  Match match;
  if (place >= 0)
  {
    const auto distance = static_cast<std::uint32_t>(least >> 32);
    std::memcpy(&match.squaredDistance, &distance, sizeof(distance));
    match.edge = this->Grid.order()[place];
  }
  return match;
}

EdgeLines::Neighbours EdgeLines::neighbours(
  const PointCloud& points, double radius, double across, double margin) const
{
  const float squaredRadius = static_cast<float>((radius + margin) * (radius + margin));
  const float squaredAcross = static_cast<float>((across + margin) * (across + margin));
  const auto& [x, y, z, tangentX, tangentY, tangentZ] = this->Columns;
  Neighbours result;
  result.starts.push_back(0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3f& tangent = points.tangents[i];
    this->Grid.forEachRange(points.points[i], radius + margin,
      [&](int begin, int end)
      {
        for (int k = begin; k < end; ++k)
        {
          const Line line{ { x[k], y[k], z[k] }, { tangentX[k], tangentY[k], tangentZ[k] } };
          const Eigen::Vector3f d = points.points[i] - line.point;
          const float squared = d.squaredNorm();
          const float along = tangent.dot(d);
          if (squared <= squaredRadius && squared - along * along <= squaredAcross &&
            std::abs(tangent.dot(line.tangent)) > NearlyParallel)
          {
            result.lines.push_back(line);
          }
        }
      });
    result.starts.push_back(static_cast<int>(result.lines.size()));
  }
  return result;
}

EdgeLines::Mean EdgeLines::meanAround(const Neighbours& neighbours, std::size_t k, const Eigen::Vector3f& point,
  const Eigen::Vector3f& tangent, double radius, double across)
{
  const float inverseRadius = 1.0f / (static_cast<float>(radius) * static_cast<float>(radius));
  const float inverseAcross = 1.0f / (static_cast<float>(across) * static_cast<float>(across));
  constexpr float least = ParallelTangents * ParallelTangents;
  Mean mean;
  for (int i = neighbours.starts[k]; i < neighbours.starts[k + 1]; ++i)
  {
    const Line& line = neighbours.lines[i];
    const Eigen::Vector3f d = point - line.point;
    const Eigen::Vector3f beside = d - tangent.dot(d) * tangent;
    const float cosine = tangent.dot(line.tangent);
    const float near = std::max(0.0f, 1.0f - d.squaredNorm() * inverseRadius);
    const float close = std::max(0.0f, 1.0f - beside.squaredNorm() * inverseAcross);
    const float parallel = std::max(0.0f, (cosine * cosine - least) / (1.0f - least));
    const float weight = near * near * close * close * parallel;
    mean.weight += weight;
    mean.offset += weight * beside;
  }
  if (mean.weight > 0.0f)
  {
    mean.offset /= mean.weight;
  }
  return mean;
}
}
