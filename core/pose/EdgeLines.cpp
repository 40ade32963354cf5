// SPDX-License-Identifier: BSD-3-Clause
#include "pose/EdgeLines.h"

#include "AllVectors.h"

namespace meam
{
namespace
{
constexpr float ParallelTangents = 0.85f; // cosine
constexpr int Lanes = 8;                  // edge points looked at together
constexpr int MostRanges = 64;

struct Query
{
  Eigen::Vector3f point, tangent;
  float squaredRadius;
};

struct Columns
{
  const float *x, *y, *z, *tangentX, *tangentY, *tangentZ;
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

MEAM_ALL_VECTORS
void search(const Columns& edges, const Range* ranges, int count, const Query& query, Nearest& nearest)
{
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
        const float tx = edges.tangentX[k], ty = edges.tangentY[k], tz = edges.tangentZ[k];
        const float dx = px - edges.x[k], dy = py - edges.y[k], dz = pz - edges.z[k];
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
  const std::size_t size = grid.order().size() + Lanes;
  for (std::vector<float>* column : { &this->X, &this->Y, &this->Z, &this->TangentX, &this->TangentY, &this->TangentZ })
  {
    column->assign(size, 0.0f);
  }
  for (std::size_t k = 0; k < grid.order().size(); ++k)
  {
    const Eigen::Vector3f& point = edges.points[grid.order()[k]];
    const Eigen::Vector3f& tangent = edges.tangents[grid.order()[k]];
    this->X[k] = point.x();
    this->Y[k] = point.y();
    this->Z[k] = point.z();
    this->TangentX[k] = tangent.x();
    this->TangentY[k] = tangent.y();
    this->TangentZ[k] = tangent.z();
  }
}

EdgeLines::Match EdgeLines::nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& tangent, double radius) const
{
  const Columns columns{ this->X.data(), this->Y.data(), this->Z.data(), this->TangentX.data(), this->TangentY.data(),
    this->TangentZ.data() };
  const Query query{ point, tangent, static_cast<float>(radius) * static_cast<float>(radius) };
  Nearest nearest;
  std::fill_n(nearest.distances, Lanes, query.squaredRadius);
  std::fill_n(nearest.places, Lanes, -1);
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
        search(columns, ranges, count, query, nearest);
        count = 0;
      }
    });
  if (count > 0)
  {
    search(columns, ranges, count, query, nearest);
  }
  Match match;
  int place = -1;
  for (int lane = 0; lane < Lanes; ++lane)
  {
    const bool nearer = nearest.places[lane] >= 0 &&
      (place < 0 || nearest.distances[lane] < match.squaredDistance ||
        (nearest.distances[lane] == match.squaredDistance && nearest.places[lane] < place));
    if (nearer)
    {
      place = nearest.places[lane];
      match.squaredDistance = nearest.distances[lane];
    }
  }
  match.edge = place < 0 ? -1 : this->Grid.order()[place];
  return match;
}
}
