// SPDX-License-Identifier: BSD-3-Clause
#include "model/DistanceField.h"

#include "base/AllVectors.h"
#include "base/Bounds.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double MostCells = 2.0e7; // 20 MB; larger cells are taken for more

/// The cells of points, `outside` of those in none.
MEAM_ALL_VECTORS
void findCells(const Eigen::Matrix<float, 3, 4>& toCells, const Eigen::Array3i& size, const float* x, const float* y,
  const float* z, int count, int outside, int* cells)
{
  const float ux = toCells(0, 0), uy = toCells(0, 1), uz = toCells(0, 2), u0 = toCells(0, 3);
  const float vx = toCells(1, 0), vy = toCells(1, 1), vz = toCells(1, 2), v0 = toCells(1, 3);
  const float wx = toCells(2, 0), wy = toCells(2, 1), wz = toCells(2, 2), w0 = toCells(2, 3);
  const int columns = size.x(), rows = size.y();
  const float width = size.x(), height = size.y(), depth = size.z();
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float u = ux * x[k] + uy * y[k] + uz * z[k] + u0;
    const float v = vx * x[k] + vy * y[k] + vz * z[k] + v0;
    const float w = wx * x[k] + wy * y[k] + wz * z[k] + w0;
    const bool inside = (u >= 0.0f) & (v >= 0.0f) & (w >= 0.0f) & (u < width) & (v < height) & (w < depth);
    const int column = static_cast<int>(inside ? u : 0.0f);
    const int row = static_cast<int>(inside ? v : 0.0f);
    const int layer = static_cast<int>(inside ? w : 0.0f);
    cells[k] = inside ? (layer * rows + row) * columns + column : outside;
  }
}

constexpr int Lanes = 16; // cells of a row at once, which is a few of them long

/// A row of cells along x.
struct Row
{
  int begin, end; ///< of the cells, the last one not included
  float cell;     ///< mm, the side of one
  float y, z;     ///< mm, of their middles
  float step;     ///< mm, of one that is stored
  std::uint8_t* stored;
};

/// Lowers what a row stores to the distance from a point of a surface with its normal, or of an edge with its tangent:
/// between points that are `spacing` mm apart the surface goes on along its plane, the edge along its line.
MEAM_ALL_VECTORS
void lower(const Row& row, const Eigen::Vector3f& point, const Eigen::Vector3f& direction, bool isNormal, float spacing,
  float farthest)
{
  const float x = point.x(), dx = direction.x(), cell = row.cell, inverseStep = 1.0f / row.step;
  const float y = row.y - point.y(), z = row.z - point.z();
  const float alongYZ = direction.y() * y + direction.z() * z, squaredYZ = y * y + z * z;
  for (int first = row.begin; first < row.end; first += Lanes)
  {
    std::uint8_t found[Lanes];
#pragma omp simd
    for (int k = 0; k < Lanes; ++k)
    {
      const float offset = (static_cast<float>(first + k) + 0.5f) * cell - x;
      const float along = std::abs(dx * offset + alongYZ); // the direction
      const float across = std::sqrt(std::max(0.0f, offset * offset + squaredYZ - along * along));
      const float away = isNormal ? along : across;
      const float beyond = std::max(0.0f, (isNormal ? across : along) - spacing);
      const float steps = std::sqrt(away * away + beyond * beyond) * inverseStep;
      found[k] = static_cast<std::uint8_t>(static_cast<int>(steps < farthest ? steps : farthest));
    }
    std::uint8_t* stored = row.stored + first;
    const int count = std::min(Lanes, row.end - first);
    if (count == Lanes)
    {
#pragma omp simd
      for (int k = 0; k < Lanes; ++k)
      {
        stored[k] = std::min(found[k], stored[k]);
      }
    }
    else
    {
      for (int k = 0; k < count; ++k)
      {
        stored[k] = std::min(found[k], stored[k]);
      }
    }
  }
}
}

DistanceField::DistanceField(
  const Points& points, const Points& directions, Kind kind, double spacing, double reach, double cellSize)
{
  this->tellUpTo(static_cast<float>(reach));
  const float step = this->Reach / Farthest;
  const Eigen::AlignedBox3f box = bounds(points);
  if (box.isEmpty())
  {
    return;
  }
  this->Middle = box.center();
  for (const auto& point : points)
  {
    this->Radius = std::max(this->Radius, (point - this->Middle).norm());
  }
  const Eigen::Array3d size = box.sizes().cast<double>().array() + 2.0 * reach;
  const double cell = std::max(cellSize, std::cbrt(size.prod() / MostCells));
  this->Origin = box.min().array() - static_cast<float>(reach);
  this->InverseCell = static_cast<float>(1.0 / cell);
  this->Size = (size / cell).floor().cast<int>() + 1;
  this->Extent = this->Size.cast<float>();
  this->Distances.assign(static_cast<std::size_t>(this->Size.prod()) + 1, Farthest);
  constexpr float margin = 1.001f; // for rounding
  const float width = static_cast<float>(cell), around = static_cast<float>(reach + spacing);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3f point = points[i] - this->Origin;
    if (!point.allFinite())
    {
      continue;
    }
    const Eigen::Array3i low = ((point.array() - around) * this->InverseCell).max(0.0f).cast<int>();
    const Eigen::Array3i high = ((point.array() + around) * this->InverseCell).cast<int>().min(this->Size - 1);
    const int middle = static_cast<int>(point.x() * this->InverseCell);
    for (int z = low.z(); z <= high.z(); ++z)
    {
      for (int y = low.y(); y <= high.y(); ++y)
      {
        Row row{ low.x(), high.x() + 1, width, (y + 0.5f) * width, (z + 0.5f) * width, step, nullptr };
        const float left =
          margin * around * around - Eigen::Vector2f(row.y - point.y(), row.z - point.z()).squaredNorm();
        if (left > 0.0f) // else all of it is out of reach
        {
          const int half = static_cast<int>(std::sqrt(left) * this->InverseCell) + 1;
          row.begin = std::max(row.begin, middle - half);
          row.end = std::min(row.end, middle + half + 1);
          const int whole = (row.end - row.begin + Lanes - 1) / Lanes * Lanes; // what lies beyond is out of reach
          row.end = std::min(row.begin + whole, this->Size.x());
          row.begin = std::max(row.end - whole, 0);
          row.stored = &this->Distances[(static_cast<std::size_t>(z) * this->Size.y() + y) * this->Size.x()];
          lower(row, point, directions[i], kind == Kind::Surface, static_cast<float>(spacing), Farthest);
        }
      }
    }
  }
}

void DistanceField::tellUpTo(float reach)
{
  this->Reach = reach;
  for (int stored = 0; stored <= Farthest; ++stored)
  {
    this->Told[stored] = stored == Farthest ? reach : reach / Farthest * stored;
  }
}

DistanceField::Stored DistanceField::stored() const
{
  const Eigen::Vector3f &o = this->Origin, &m = this->Middle;
  return { { o.x(), o.y(), o.z(), m.x(), m.y(), m.z(), this->InverseCell, this->Radius, this->Reach },
    { this->Size.x(), this->Size.y(), this->Size.z() }, this->Distances };
}

std::optional<DistanceField> DistanceField::of(Stored stored)
{
  constexpr std::size_t numbers = 9;     // of the frame
  constexpr std::int32_t most = 1 << 20; // cells along an axis, so that 64 bits count all
  const std::vector<float>& frame = stored.frame;
  const std::vector<std::int32_t>& size = stored.size;
  const auto isFinite = [](float value) { return std::isfinite(value); };
  const auto isCount = [](std::int32_t count) { return count >= 0 && count <= most; };
  if (frame.size() != numbers || !std::all_of(frame.begin(), frame.end(), isFinite) || !(frame[6] > 0.0f) ||
      size.size() != 3 || !std::all_of(size.begin(), size.end(), isCount) ||
      stored.distances.size() != std::uint64_t(size[0]) * size[1] * size[2] + 1)
  {
    return std::nullopt;
  }
  DistanceField field;
  field.Origin = Eigen::Vector3f(frame.data());
  field.Middle = Eigen::Vector3f(frame.data() + 3);
  field.InverseCell = frame[6];
  field.Radius = frame[7];
  field.tellUpTo(frame[8]);
  field.Size = Eigen::Array3i(size.data());
  field.Extent = field.Size.cast<float>();
  field.Distances = std::move(stored.distances);
  return field;
}

void DistanceField::at(
  const Eigen::Isometry3f& toPart, const SoAPoints& points, int begin, int count, float* distances) const
{
  Eigen::Matrix<float, 3, 4> toCells = this->InverseCell * toPart.matrix().topRows<3>();
  toCells.col(3) -= this->InverseCell * this->Origin;
  const int outside = static_cast<int>(this->Distances.size()) - 1;
  int cells[SoABlock];
  const float *x = points.x.data() + begin, *y = points.y.data() + begin, *z = points.z.data() + begin;
  for (int done = 0; done < count; done += SoABlock)
  {
    const int size = std::min(SoABlock, count - done);
    findCells(toCells, this->Size, x + done, y + done, z + done, size, outside, cells);
    for (int k = 0; k < size; ++k)
    {
      distances[done + k] = this->Told[this->Distances[cells[k]]];
    }
  }
}

DistanceField DistanceField::ofSurface(const PointCloud& samples, double spacing, double reach, double cellSize)
{
  return DistanceField(samples.points, samples.normals, Kind::Surface, spacing, reach, cellSize);
}

DistanceField DistanceField::ofEdges(const PointCloud& edges, double spacing, double reach, double cellSize)
{
  return DistanceField(edges.points, edges.tangents, Kind::Edges, spacing, reach, cellSize);
}
}
