// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/symmetry/SampleIndex.h"

#include "base/AllVectors.h"

#include <algorithm>
#include <limits>

namespace meam
{
namespace
{
constexpr int Lanes = 8; // samples looked at together

struct Query
{
  Eigen::Vector3f point, normal;
  float squaredRadius;
  float sameSide;
};

/// The nearest of each lane so far.
struct Nearest
{
  float distances[Lanes];
  int places[Lanes];
};

MEAM_ALL_VECTORS
void search(const SoAOrientedPoints& samples, int begin, int end, const Query& query, Nearest& nearest)
{
  const float *sx = samples.points.x.data(), *sy = samples.points.y.data(), *sz = samples.points.z.data();
  const float *nx = samples.directions.x.data(), *ny = samples.directions.y.data(), *nz = samples.directions.z.data();
  const float px = query.point.x(), py = query.point.y(), pz = query.point.z();
  const float qx = query.normal.x(), qy = query.normal.y(), qz = query.normal.z();
  const float squaredRadius = query.squaredRadius, sameSide = query.sameSide;
  for (; begin < end; begin += Lanes)
  {
#pragma omp simd
    for (int lane = 0; lane < Lanes; ++lane) // the last ones may be of the next range
    {
      const int k = begin + lane;
      const float dx = sx[k] - px, dy = sy[k] - py, dz = sz[k] - pz;
      const float squared = dx * dx + (dy * dy + dz * dz);
      const float cosine = nx[k] * qx + (ny[k] * qy + nz[k] * qz);
      const bool nearer =
        (k < end) & (squared <= squaredRadius) & (cosine > sameSide) & (squared < nearest.distances[lane]);
      nearest.distances[lane] = nearer ? squared : nearest.distances[lane];
      nearest.places[lane] = nearer ? k : nearest.places[lane];
    }
  }
}
}

SampleIndex::SampleIndex(const PointCloud& surface, double cellSize, double sameSide)
  : Grid(surface.points, cellSize)
  , SameSide(static_cast<float>(sameSide))
{
  const std::vector<int>& order = this->Grid.order();
  this->Samples.resize(order.size() + Lanes);
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    this->Samples.set(k, surface.points[order[k]], surface.normals[order[k]]);
  }
}

int SampleIndex::nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, double radius) const
{
  const Query query{ point, normal, static_cast<float>(radius) * static_cast<float>(radius), this->SameSide };
  Nearest nearest;
  std::fill_n(nearest.distances, Lanes, std::numeric_limits<float>::infinity());
  std::fill_n(nearest.places, Lanes, -1);
  this->Grid.forEachRange(
    point, radius, [&](int begin, int end) { search(this->Samples, begin, end, query, nearest); });
  int best = 0; // lane
  for (int lane = 1; lane < Lanes; ++lane)
  {
    const bool isNearer = nearest.distances[lane] < nearest.distances[best];
    const bool isFirst =
      nearest.distances[lane] == nearest.distances[best] && nearest.places[lane] < nearest.places[best];
    best = isNearer || isFirst ? lane : best;
  }
  const int place = nearest.places[best];
  return place >= 0 ? this->Grid.order()[place] : -1;
}
}
