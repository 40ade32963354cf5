// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/CloudEdges.h"

#include "base/AllVectors.h"
#include "base/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace meam
{
namespace
{
// Depth edges
constexpr int WidestShadow = 20;   // grid steps from the end of a surface to the one behind, the shadow between them
constexpr int FewestOfSurface = 3; // of the eight neighbours, within the jump: a point that flies alone is no edge
constexpr int DirectionWindow = 2; // grid steps: where the surface goes on in it tells how its border runs
// Creases
constexpr double CreaseNoises = 4.0;     // standard deviations of the angle that noise makes: a crease has no less
constexpr double BendWithin = 0.35;      // of the crease's angle: a piece that bends by more behind its window is round
constexpr double MeetingDistance = 0.75; // grid steps from the point to where the two pieces meet
constexpr float LeastSpread = 1e-3f; // of points in a window, 1: in both directions alike; less is a line, and no plane

/// Columns, rows.
using GridStep = std::pair<int, int>;
const std::array<GridStep, 4> Across{ { { 1, 0 }, { 0, 1 }, { 1, 1 }, { 1, -1 } } }; // all ways across

constexpr float CosineError = 1e-4f; // more than what rounding makes of a cosine
constexpr int BandRows = 96;         // rows of the grid that are worked on together, so that they stay in the cache

using GridEdges = std::vector<GridEdge>;

/// Eight neighbours in a row.
using Floats = float __attribute__((vector_size(32)));
using Bits = int __attribute__((vector_size(32)));
constexpr int Lanes = 8; // of these vectors

/// A row's points coordinate by coordinate; depths of those that are not finite are no numbers. `x` and `y` may be
/// null.
MEAM_ALL_VECTORS
void split(const float* xyz, int count, float* x, float* y, float* z)
{
  constexpr float infinity = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
  for (int k = 0; x && k < count; ++k)
  {
    x[k] = xyz[3 * k];
    y[k] = xyz[3 * k + 1];
  }
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const bool isFinite =
      (std::abs(xyz[3 * k]) < infinity) & (std::abs(xyz[3 * k + 1]) < infinity) & (std::abs(xyz[3 * k + 2]) < infinity);
    z[k] = isFinite ? xyz[3 * k + 2] : none;
  }
}

/// Rows of the grid coordinate by coordinate, with a margin on all sides. Depths are no numbers where nothing was
/// measured, and in the margin.
class GridRows
{
public:
  enum Coordinates
  {
    Depths,
    All
  };
  GridRows(const OrganizedCloud& cloud, int firstRow, int lastRow, int margin, Coordinates coordinates)
    : First(firstRow - margin)
    , Margin(margin)
    , Stride(cloud.width + 2 * margin + Lanes)
  {
    const std::size_t size = static_cast<std::size_t>(lastRow - firstRow + 2 * margin) * this->Stride;
    this->Z.assign(size, std::numeric_limits<float>::quiet_NaN());
    if (coordinates == All)
    {
      this->X.resize(size);
      this->Y.resize(size);
    }
    for (int row = std::max(this->First, 0); row < std::min(lastRow + margin, cloud.height); ++row)
    {
      const std::size_t to = this->placeOf(row);
      split(cloud.points[static_cast<std::size_t>(row) * cloud.width].data(), cloud.width,
        coordinates == All ? &this->X[to] : nullptr, coordinates == All ? &this->Y[to] : nullptr, &this->Z[to]);
    }
  }

  std::ptrdiff_t stride() const { return this->Stride; }
  const float* x(int row) const { return this->X.data() + this->placeOf(row); }
  const float* y(int row) const { return this->Y.data() + this->placeOf(row); }
  const float* z(int row) const { return this->Z.data() + this->placeOf(row); }

private:
  std::size_t placeOf(int row) const
  {
    return static_cast<std::size_t>(row - this->First) * this->Stride + this->Margin;
  }

  int First, Margin, Stride;
  std::vector<float> X, Y, Z;
};

/// Calls work(row begin, row end, edges of each row) for bands of the grid, which threads share.
template <typename Work>
GridEdges inBands(const OrganizedCloud& cloud, int threads, const Progress& progress, const Work& work)
{
  std::vector<GridEdges> ofRow(cloud.height);
  parallelForEach((cloud.height + BandRows - 1) / BandRows, threads, progress,
    [&](int band) { work(band * BandRows, std::min((band + 1) * BandRows, cloud.height), ofRow); });
  GridEdges all;
  for (const GridEdges& edges : ofRow)
  {
    all.insert(all.end(), edges.begin(), edges.end());
  }
  return all;
}

/// Calls visit(column) for the candidates of a row.
template <typename Visit>
void forEachCandidate(const std::vector<std::uint8_t>& isCandidate, const Visit& visit)
{
  const std::uint8_t* const begin = isCandidate.data();
  const std::uint8_t* const end = begin + isCandidate.size();
  for (const std::uint8_t* at = begin; (at = std::find(at, end, 1)) != end; ++at)
  {
    visit(static_cast<int>(at - begin));
  }
}

/// The point in a direction, or null outside the grid.
const Eigen::Vector3f* pointAt(const OrganizedCloud& cloud, int row, int column)
{
  const bool inside = row >= 0 && column >= 0 && row < cloud.height && column < cloud.width;
  return inside ? &cloud.points[static_cast<std::size_t>(row) * cloud.width + column] : nullptr;
}

/// Whether the surface ends at a point in a direction, in front of another one: farther away than its slope leads.
bool endsInFront(const OrganizedCloud& cloud, int row, int column, int down, int right, float jump)
{
  const float z = pointAt(cloud, row, column)->z();
  const Eigen::Vector3f* before = pointAt(cloud, row - down, column - right);
  const float slope = before && before->allFinite() ? std::max(0.0f, z - before->z()) : 0.0f;
  for (int step = 1; step <= WidestShadow; ++step)
  {
    const Eigen::Vector3f* next = pointAt(cloud, row + step * down, column + step * right);
    if (!next)
    {
      return false;
    }
    if (next->allFinite())
    {
      return next->z() - z > (jump + slope) * static_cast<float>(step);
    }
  }
  return false;
}

/// Along the border of the surface that a point is on; zero when it has none nearby.
Eigen::Vector2f borderDirection(const OrganizedCloud& cloud, int row, int column, float jump)
{
  const float z = pointAt(cloud, row, column)->z();
  Eigen::Vector2f inwards = Eigen::Vector2f::Zero();
  for (int v = -DirectionWindow; v <= DirectionWindow; ++v)
  {
    for (int u = -DirectionWindow; u <= DirectionWindow; ++u)
    {
      const Eigen::Vector3f* other = pointAt(cloud, row + v, column + u);
      const bool cut = !pointAt(cloud, row - v, column - u); // the window is even on all sides, also beside the grid
      if (other && !cut && std::abs(other->z() - z) <= jump)
      {
        inwards += Eigen::Vector2f(u, v);
      }
    }
  }
  return inwards.isZero() ? inwards : Eigen::Vector2f(-inwards.y(), inwards.x()).normalized();
}

/// Which points of a row, with depths about it, may be at the end of a surface: a neighbour is missing or farther by
/// `jump`.
MEAM_ALL_VECTORS
void findEnds(const float* z, std::ptrdiff_t stride, int width, float jump, std::uint8_t* isCandidate)
{
#pragma omp simd
  for (int k = 0; k < width; ++k)
  {
    const float depth = z[k], left = z[k - 1], right = z[k + 1], above = z[k - stride], below = z[k + stride];
    // False for no numbers.
    const bool goesOn =
      (left - depth <= jump) & (right - depth <= jump) & (above - depth <= jump) & (below - depth <= jump);
    isCandidate[k] = (depth == depth) & !goesOn ? 1 : 0;
  }
}

/// Planes through the surface around the points of some rows, coordinate by coordinate.
class PlaneRows
{
public:
  PlaneRows(int firstRow, int lastRow, int width, int margin)
    : First(firstRow)
    , Margin(margin)
    , Width(width)
    , Stride(width + 2 * margin + Lanes)
  {
    const std::size_t size = static_cast<std::size_t>(lastRow - firstRow) * this->Stride;
    for (std::vector<float>& values : this->Values)
    {
      values.assign(size, std::numeric_limits<float>::quiet_NaN());
    }
  }

  enum Value
  {
    NormalX, ///< unit; not a number where there is no plane
    NormalY,
    NormalZ,
    Depth,       ///< mm, at the grid point
    ColumnSlope, ///< mm of depth for one column to the right
    RowSlope     ///< and for one row down
  };
  float* row(Value value, int row) { return this->Values[value].data() + this->placeOf(row, 0); }
  const float* row(Value value, int row) const { return this->Values[value].data() + this->placeOf(row, 0); }

  struct Plane
  {
    Eigen::Vector3f normal;
    float depth, columnSlope, rowSlope;
    bool valid() const { return this->normal.x() == this->normal.x(); }
  };
  Plane plane(int row, int column) const
  {
    const std::size_t at = this->placeOf(row, column);
    const auto value = [&](Value which) { return this->Values[which][at]; };
    return { { value(NormalX), value(NormalY), value(NormalZ) }, value(Depth), value(ColumnSlope), value(RowSlope) };
  }

  /// Fits planes in square windows to the points of a row; those that are `jump` before or behind the middle are of
  /// another surface. Planes of a full window depend on its points alone.
  void fit(const GridRows& grid, int row, int radius, float jump);

private:
  std::size_t placeOf(int row, int column) const
  {
    return static_cast<std::size_t>(row - this->First) * this->Stride + this->Margin + column;
  }

  int First, Margin, Width, Stride;
  std::vector<float> Values[6];
};

inline __attribute__((always_inline)) Floats load(const float* from)
{
  Floats values;
  std::memcpy(&values, from, sizeof(values));
  return values;
}

inline __attribute__((always_inline)) Floats kept(const Floats& values, const Bits& which)
{
  return (Floats)((Bits)values & which);
}

/// Least squares for P = middle + u alongColumn + v alongRow in square windows, for the points of a row. `to` are rows
/// of PlaneRows.
MEAM_ALL_VECTORS
void fitRow(const float* x, const float* y, const float* z, std::ptrdiff_t stride, int width, int radius, float jump,
  float* const* to)
{
  const Bits magnitude = Bits{} + 0x7fffffff;
  constexpr float fewestPoints = FewestPoints;
  const Floats ones = Floats{} + 1.0f, limit = Floats{} + jump,
               none = Floats{} + std::numeric_limits<float>::quiet_NaN();
  for (int begin = 0; begin < width; begin += Lanes)
  {
    const Floats atX = load(x + begin), atY = load(y + begin), atZ = load(z + begin);
    Floats n{}, u{}, v{}, uu{}, uv{}, vv{};
    Floats sumX{}, sumY{}, sumZ{}, sumUX{}, sumUY{}, sumUZ{}, sumVX{}, sumVY{}, sumVZ{};
    for (int r = -radius; r <= radius; ++r)
    {
      const std::ptrdiff_t from = r * stride + begin;
      Floats rowN{}, rowU{}, rowUU{}, rowX{}, rowY{}, rowZ{}, rowUX{}, rowUY{}, rowUZ{};
      for (int c = -radius; c <= radius; ++c)
      {
        const float column = static_cast<float>(c);
        const Floats dz = load(z + from + c) - atZ;
        const Bits in = (Floats)((Bits)dz & magnitude) < limit; // false for no numbers
        const Floats px = kept(load(x + from + c) - atX, in), py = kept(load(y + from + c) - atY, in),
                     pz = kept(dz, in);
        const Floats one = kept(ones, in), uOne = column * one;
        rowN += one;
        rowU += uOne;
        rowUU += column * uOne;
        rowX += px;
        rowY += py;
        rowZ += pz;
        rowUX += column * px;
        rowUY += column * py;
        rowUZ += column * pz;
      }
      const float row = static_cast<float>(r);
      n += rowN;
      u += rowU;
      v += row * rowN;
      uu += rowUU;
      uv += row * rowU;
      vv += row * row * rowN;
      sumX += rowX;
      sumY += rowY;
      sumZ += rowZ;
      sumUX += rowUX;
      sumUY += rowUY;
      sumUZ += rowUZ;
      sumVX += row * rowX;
      sumVY += row * rowY;
      sumVZ += row * rowZ;
    }
    // About the mean of the points.
    const Floats meanU = u / n, meanV = v / n;
    const Floats spreadU = uu - u * meanU, spreadUV = uv - u * meanV, spreadV = vv - v * meanV;
    const Floats determinant = spreadU * spreadV - spreadUV * spreadUV, inverse = ones / determinant;
    const auto along = [&](const Floats& sum, const Floats& sumU, const Floats& sumV, Floats& column, Floats& row)
      __attribute__((always_inline))
    {
      const Floats byU = sumU - sum * meanU, byV = sumV - sum * meanV;
      column = (byU * spreadV - byV * spreadUV) * inverse;
      row = (byV * spreadU - byU * spreadUV) * inverse;
    };
    Floats columnX, columnY, columnZ, rowX, rowY, rowZ;
    along(sumX, sumUX, sumVX, columnX, rowX);
    along(sumY, sumUY, sumVY, columnY, rowY);
    along(sumZ, sumUZ, sumVZ, columnZ, rowZ);
    const Bits isPlane = (n >= fewestPoints) & (determinant > LeastSpread * spreadU * spreadV); // false for no numbers
    const Floats values[6] = { columnY * rowZ - columnZ * rowY, columnZ * rowX - columnX * rowZ,
      columnX * rowY - columnY * rowX, atZ + sumZ / n - columnZ * meanU - rowZ * meanV, columnZ, rowZ };
    for (int k = 0; k < 6; ++k)
    {
      const Floats value = (Floats)(((Bits)values[k] & isPlane) | ((Bits)none & ~isPlane));
      std::memcpy(to[k] + begin, &value, sizeof(value)); // up to 7 in the margin, where nothing was measured
    }
  }
}

MEAM_ALL_VECTORS
void normalize(float* x, float* y, float* z, int count)
{
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float inverse = 1.0f / std::sqrt(x[k] * x[k] + y[k] * y[k] + z[k] * z[k]);
    x[k] *= inverse;
    y[k] *= inverse;
    z[k] *= inverse;
  }
}

void PlaneRows::fit(const GridRows& grid, int row, int radius, float jump)
{
  float* to[6];
  for (int k = 0; k < 6; ++k)
  {
    to[k] = this->row(static_cast<Value>(k), row);
  }
  fitRow(grid.x(row), grid.y(row), grid.z(row), grid.stride(), this->Width, radius, jump, to);
  normalize(to[NormalX], to[NormalY], to[NormalZ], this->Width);
}

/// Adds those of a row's points on whose two sides planes with these normals meet at an angle of this cosine or less.
MEAM_ALL_VECTORS
void findBends(
  const float* const* before, const float* const* after, int width, float cosine, std::uint8_t* isCandidate)
{
  const float *ax = before[0], *ay = before[1], *az = before[2], *bx = after[0], *by = after[1], *bz = after[2];
#pragma omp simd
  for (int k = 0; k < width; ++k)
  {
    const bool bends = ax[k] * bx[k] + ay[k] * by[k] + az[k] * bz[k] <= cosine; // false for no numbers
    isCandidate[k] = isCandidate[k] | (bends ? 1 : 0);
  }
}

/// The angle in radians between two planes.
float angleBetween(const PlaneRows::Plane& a, const PlaneRows::Plane& b)
{
  return std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
}
}

std::vector<GridEdge> findDepthEdges(const OrganizedCloud& cloud, double jump, int threads, const Progress& progress)
{
  const float limit = static_cast<float>(jump);
  const auto isEdge = [&](int row, int column, GridEdge& edge)
  {
    const auto ends = [&](int down, int right) { return endsInFront(cloud, row, column, down, right, limit); };
    if (!ends(0, 1) && !ends(0, -1) && !ends(1, 0) && !ends(-1, 0))
    {
      return false;
    }
    int sameSurface = -1; // itself
    for (int k = 0; k < 9; ++k)
    {
      const Eigen::Vector3f* other = pointAt(cloud, row + k / 3 - 1, column + k % 3 - 1);
      sameSurface += other && std::abs(other->z() - cloud.points[edge.point].z()) <= limit;
    }
    edge.direction = borderDirection(cloud, row, column, limit);
    return sameSurface >= FewestOfSurface && !edge.direction.isZero();
  };
  return inBands(cloud, threads, progress,
    [&](int begin, int end, std::vector<GridEdges>& ofRow)
    {
      const GridRows grid(cloud, begin, end, 1, GridRows::Depths);
      std::vector<std::uint8_t> isCandidate(cloud.width);
      for (int row = begin; row < end; ++row)
      {
        findEnds(grid.z(row), grid.stride(), cloud.width, limit, isCandidate.data());
        forEachCandidate(isCandidate,
          [&](int column)
          {
            GridEdge edge;
            edge.point = row * cloud.width + column;
            if (isEdge(row, column, edge))
            {
              ofRow[row].push_back(edge);
            }
          });
      }
    });
}

std::vector<GridEdge> findCreases(
  const OrganizedCloud& cloud, const GridScale& scale, double angle, int threads, const Progress& progress)
{
  const int radius = scale.windowRadius();
  const float jump = static_cast<float>(scale.depthJump());
  const int reach = radius + 1; // a window whose middle is so far away ends beside the point
  const float limit =
    static_cast<float>(std::max(angle * M_PI / 180.0, CreaseNoises * std::sqrt(2.0) * scale.slopeError(radius)));
  const float cosine = std::cos(std::min(limit, static_cast<float>(M_PI))) + CosineError;
  const auto isInside = [&](int row, int column)
  { return row >= 0 && column >= 0 && row < cloud.height && column < cloud.width; };
  const auto isEdge = [&](const PlaneRows& planes, int row, int column, GridEdge& edge)
  {
    float best = 0.0f;
    for (const auto& [right, down] : Across)
    {
      if (!isInside(row - reach * down, column - reach * right) ||
          !isInside(row + reach * down, column + reach * right))
      {
        continue;
      }
      const PlaneRows::Plane before = planes.plane(row - reach * down, column - reach * right);
      const PlaneRows::Plane after = planes.plane(row + reach * down, column + reach * right);
      if (!(before.normal.dot(after.normal) <= cosine)) // most of them; and what is no plane
      {
        continue;
      }
      // Both planes as depths over columns and rows around the point: they meet where the depths agree.
      const Eigen::Vector2f slope(after.columnSlope - before.columnSlope, after.rowSlope - before.rowSlope);
      const Eigen::Vector2f step(right, down);
      const float depthBefore = before.depth + reach * (right * before.columnSlope + down * before.rowSlope);
      const float depthAfter = after.depth - reach * (right * after.columnSlope + down * after.rowSlope);
      const float rate = slope.dot(step);
      if (!(std::abs(depthAfter - depthBefore) <= MeetingDistance * std::abs(rate)) ||
          !(std::abs(depthAfter - cloud.points[edge.point].z()) <= jump))
      {
        continue;
      }
      const float bend = angleBetween(before, after);
      if (!(bend >= limit) || bend <= best)
      {
        continue;
      }
      // A piece that bends on behind its window is round; one that ends there is not, but for the end of the grid.
      const auto round = [&, right = right, down = down](const PlaneRows::Plane& near, int side)
      {
        const int farRow = row + 2 * side * reach * down, farColumn = column + 2 * side * reach * right;
        if (!isInside(farRow, farColumn))
        {
          return true;
        }
        const PlaneRows::Plane far = planes.plane(farRow, farColumn);
        const float expected = near.depth + side * reach * (right * near.columnSlope + down * near.rowSlope);
        return far.valid() && std::abs(far.depth - expected) <= jump && angleBetween(far, near) > BendWithin * bend;
      };
      if (round(before, -1) || round(after, 1))
      {
        continue;
      }
      best = bend;
      edge.direction = Eigen::Vector2f(-slope.y(), slope.x()).normalized();
    }
    return best > 0.0f;
  };
  return inBands(cloud, threads, progress,
    [&](int begin, int end, std::vector<GridEdges>& ofRow)
    {
      const int first = std::max(begin - 2 * reach, 0), last = std::min(end + 2 * reach, cloud.height);
      PlaneRows planes(first, last, cloud.width, reach);
      {
        const GridRows grid(cloud, first, last, radius, GridRows::All);
        for (int row = first; row < last; ++row)
        {
          planes.fit(grid, row, radius, jump);
        }
      }
      std::vector<std::uint8_t> isCandidate(cloud.width);
      for (int row = begin; row < end; ++row)
      {
        std::fill(isCandidate.begin(), isCandidate.end(), 0);
        for (const auto& [right, down] : Across)
        {
          if (isInside(row - reach * down, 0) && isInside(row + reach * down, 0))
          {
            const float *before[3], *after[3];
            for (int k = 0; k < 3; ++k)
            {
              const auto axis = static_cast<PlaneRows::Value>(k);
              before[k] = static_cast<const PlaneRows&>(planes).row(axis, row - reach * down) - reach * right;
              after[k] = static_cast<const PlaneRows&>(planes).row(axis, row + reach * down) + reach * right;
            }
            findBends(before, after, cloud.width, cosine, isCandidate.data());
          }
        }
        forEachCandidate(isCandidate,
          [&](int column)
          {
            GridEdge edge;
            edge.point = row * cloud.width + column;
            if (cloud.points[edge.point].allFinite() && isEdge(planes, row, column, edge))
            {
              ofRow[row].push_back(edge);
            }
          });
      }
    });
}
}
