// SPDX-License-Identifier: BSD-3-Clause
#include "scene/EdgeIndex.h"

#include "base/AllVectors.h"

#include <cstring>

namespace meam
{
namespace
{
constexpr float Parallel = 0.85f;      // cosine, 32 degrees: edges whose tangents are farther apart do not match
constexpr float NearlyParallel = 0.8f; // cosine, five degrees more: for points that turn before they look again

constexpr int Lanes = 8;       // edge points looked at together
constexpr int MostRanges = 64; // of columns looked at together

struct Query
{
  Eigen::Vector3f point, tangent;
  float squaredRadius;
  float leastCosine; ///< between tangents
};

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

/// Returns whether there is any.
MEAM_ALL_VECTORS
bool search(const SoAOrientedPoints& edges, const Range* ranges, int count, const Query& query, Nearest& nearest)
{
  const float *ex = edges.points.x.data(), *ey = edges.points.y.data(), *ez = edges.points.z.data();
  const float *tangentX = edges.directions.x.data(), *tangentY = edges.directions.y.data(),
              *tangentZ = edges.directions.z.data();
  const float px = query.point.x(), py = query.point.y(), pz = query.point.z();
  const float qx = query.tangent.x(), qy = query.tangent.y(), qz = query.tangent.z();
  const float squaredRadius = query.squaredRadius, leastCosine = query.leastCosine;
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
          (k < end) & (squared <= squaredRadius) & (cosine > leastCosine) & (across < distances[lane]);
        distances[lane] = nearer ? across : distances[lane];
        places[lane] = nearer ? k : places[lane];
      }
    }
  }
  int last = -1;
#pragma omp simd reduction(max : last)
  for (int lane = 0; lane < Lanes; ++lane)
  {
    nearest.distances[lane] = distances[lane];
    nearest.places[lane] = places[lane];
    last = std::max(last, places[lane]);
  }
  return last >= 0;
}

/// Writes which of the edges in the ranges lie within the query's radius and, across its tangent, within `across`, and
/// are as parallel as it asks. Returns their number.
MEAM_ALL_VECTORS
int select(
  const SoAOrientedPoints& edges, const Range* ranges, int count, const Query& query, float across, int* selected)
{
  const float *ex = edges.points.x.data(), *ey = edges.points.y.data(), *ez = edges.points.z.data();
  const float *tangentX = edges.directions.x.data(), *tangentY = edges.directions.y.data(),
              *tangentZ = edges.directions.z.data();
  const float px = query.point.x(), py = query.point.y(), pz = query.point.z();
  const float qx = query.tangent.x(), qy = query.tangent.y(), qz = query.tangent.z();
  const float squaredRadius = query.squaredRadius, squaredAcross = across * across, leastCosine = query.leastCosine;
  int passes[Lanes];
  int found = 0;
  for (int r = 0; r < count; ++r)
  {
    const int end = ranges[r].end;
    for (int begin = ranges[r].begin; begin < end; begin += Lanes)
    {
#pragma omp simd
      for (int lane = 0; lane < Lanes; ++lane)
      {
        const int k = begin + lane;
        const float dx = px - ex[k], dy = py - ey[k], dz = pz - ez[k];
        const float squared = dx * dx + dy * dy + dz * dz;
        const float along = qx * dx + qy * dy + qz * dz;
        const float cosine = std::abs(tangentX[k] * qx + tangentY[k] * qy + tangentZ[k] * qz);
        const bool isNear =
          (k < end) & (squared <= squaredRadius) & (squared - along * along <= squaredAcross) & (cosine > leastCosine);
        passes[lane] = isNear ? 1 : 0;
      }
      for (int lane = 0; lane < Lanes; ++lane)
      {
        selected[found] = begin + lane;
        found += passes[lane];
      }
    }
  }
  return found;
}

/// Sums of what has been added up in lanes, in a fixed order.
inline __attribute__((always_inline)) float sumOf(const float* lanes)
{
  static_assert(Lanes == 8, "four pairs");
  return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
}

struct MeanWeights
{
  float inverseRadius, inverseAcross; ///< squared
};

MEAM_ALL_VECTORS
void average(const EdgeIndex::Neighbours& neighbours, const SoAOrientedPoints& points, const MeanWeights& weights,
  EdgeIndex::Means& means)
{
  const SoAOrientedPoints& lines = neighbours.lines;
  const float *ex = lines.points.x.data(), *ey = lines.points.y.data(), *ez = lines.points.z.data();
  const float *lx = lines.directions.x.data(), *ly = lines.directions.y.data(), *lz = lines.directions.z.data();
  const float* shares = neighbours.weights.data();
  const float inverseRadius = weights.inverseRadius, inverseAcross = weights.inverseAcross;
  const float least = Parallel * Parallel;
  const float inverseRest = 1.0f / (1.0f - least);
  const int count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i)
  {
    const float px = points.points.x[i], py = points.points.y[i], pz = points.points.z[i];
    const float tx = points.directions.x[i], ty = points.directions.y[i], tz = points.directions.z[i];
    const int end = neighbours.starts[i + 1];
    float sums[Lanes] = {}, x[Lanes] = {}, y[Lanes] = {}, z[Lanes] = {};
    for (int begin = neighbours.starts[i]; begin < end; begin += Lanes)
    {
#pragma omp simd
      for (int lane = 0; lane < Lanes; ++lane)
      {
        const int k = begin + lane;
        const float dx = px - ex[k], dy = py - ey[k], dz = pz - ez[k];
        const float along = tx * dx + ty * dy + tz * dz;
        const float besideX = dx - along * tx, besideY = dy - along * ty, besideZ = dz - along * tz;
        const float cosine = tx * lx[k] + ty * ly[k] + tz * lz[k];
        const float near = std::max(0.0f, 1.0f - (dx * dx + dy * dy + dz * dz) * inverseRadius);
        const float close =
          std::max(0.0f, 1.0f - (besideX * besideX + besideY * besideY + besideZ * besideZ) * inverseAcross);
        const float parallel = std::max(0.0f, (cosine * cosine - least) * inverseRest);
        const float weight = k < end ? shares[k] * near * near * close * close * parallel : 0.0f;
        sums[lane] += weight;
        x[lane] += weight * besideX;
        y[lane] += weight * besideY;
        z[lane] += weight * besideZ;
      }
    }
    const float sum = sumOf(sums);
    const float share = sum > 0.0f ? 1.0f / sum : 0.0f;
    means.weights[i] = sum;
    means.offsets.x[i] = sumOf(x) * share;
    means.offsets.y[i] = sumOf(y) * share;
    means.offsets.z[i] = sumOf(z) * share;
  }
}

void gather(const std::vector<float>& from, const std::vector<int>& places, int count, std::vector<float>& to)
{
  for (int k = 0; k < count; ++k)
  {
    to[k] = from[places[k]];
  }
}
}

EdgeIndex::EdgeIndex(const PointCloud& edges, double cellSize)
  : Grid(edges.points, cellSize)
{
  const std::vector<int>& order = this->Grid.order();
  this->Lines.resize(order.size() + Lanes);
  this->Weights.assign(this->Lines.size(), 1.0f);
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    this->Lines.set(k, edges.points[order[k]], edges.tangents[order[k]]);
    this->Weights[k] = edges.weights.empty() ? 1.0f : edges.weights[order[k]];
  }
}

template <typename Visitor>
void EdgeIndex::forEachGroupOfRanges(const Eigen::Vector3f& point, double radius, Visitor&& visit) const
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

EdgeIndex::Match EdgeIndex::nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& tangent, double radius) const
{
  const Query query{ point, tangent, static_cast<float>(radius) * static_cast<float>(radius), Parallel };
  Nearest nearest;
  std::fill_n(nearest.distances, Lanes, query.squaredRadius);
  std::fill_n(nearest.places, Lanes, -1);
  bool isAny = false;
  this->forEachGroupOfRanges(point, radius,
    [&](const Range* ranges, int count) { isAny |= search(this->Lines, ranges, count, query, nearest); });
  if (!isAny)
  {
    return {};
  }
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

EdgeIndex::Neighbours EdgeIndex::neighbours(
  const SoAOrientedPoints& points, double radius, double across, double margin) const
{
  const double reach = radius + margin;
  std::vector<int> selected;
  int found = 0;
  Neighbours result;
  result.starts.push_back(0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Query query{ points.points[i], points.directions[i], static_cast<float>(reach * reach), NearlyParallel };
    this->forEachGroupOfRanges(query.point, reach,
      [&](const Range* ranges, int count)
      {
        std::size_t most = found + Lanes;
        for (int r = 0; r < count; ++r)
        {
          most += ranges[r].end - ranges[r].begin;
        }
        if (selected.size() < most)
        {
          selected.resize(2 * most);
        }
        found += select(this->Lines, ranges, count, query, static_cast<float>(across + margin), &selected[found]);
      });
    result.starts.push_back(found);
  }
  result.lines.resize(found + Lanes);
  const auto gathered = [&](const SoAPoints& from, SoAPoints& to)
  {
    gather(from.x, selected, found, to.x);
    gather(from.y, selected, found, to.y);
    gather(from.z, selected, found, to.z);
  };
  gathered(this->Lines.points, result.lines.points);
  gathered(this->Lines.directions, result.lines.directions);
  result.weights.resize(result.lines.size());
  gather(this->Weights, selected, found, result.weights);
  return result;
}

EdgeIndex::Means EdgeIndex::meansAround(
  const Neighbours& neighbours, const SoAOrientedPoints& points, double radius, double across)
{
  Means means;
  means.weights.resize(points.size());
  means.offsets.resize(points.size());
  average(neighbours, points,
    { static_cast<float>(1.0 / (radius * radius)), static_cast<float>(1.0 / (across * across)) }, means);
  return means;
}
}
