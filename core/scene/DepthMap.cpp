// SPDX-License-Identifier: BSD-3-Clause
#include "scene/DepthMap.h"

#include "base/AllVectors.h"
#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "base/Bounds.h"
#include "base/Frames.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace meam
{
namespace
{
constexpr float LargestSide = 2048.0f; // cells; a wider scene gets coarser cells
constexpr double StrayShare = 0.001;   // of the points, at each end of each axis
constexpr double MiddleShare = 0.49;   // as that leaves next to the medians
constexpr double FarDepths = 1.9;      // times the mean depth: farther than any point of a bin
constexpr double LayerCells = 2.0;     // depth of the layer that is averaged: a slope of 63 degrees across a cell

/// A map's lines of sight, for points that `toAxes` takes to its axes.
struct Lines
{
  Eigen::Matrix<float, 3, 4> toAxes;
  bool perspective;
  Eigen::Vector2f low;
  float inverseCell;
  int width, height;
};

/// The cells of points, `outside` of those in none, their depths, and how far inside the cells they lie.
MEAM_ALL_VECTORS
void lookAlong(const Lines& lines, const float* x, const float* y, const float* z, int count, int* cells, float* depths,
  float* insides)
{
  const Eigen::Matrix<float, 3, 4>& m = lines.toAxes;
  const float ux = m(0, 0), uy = m(0, 1), uz = m(0, 2), u0 = m(0, 3);
  const float vx = m(1, 0), vy = m(1, 1), vz = m(1, 2), v0 = m(1, 3);
  const float wx = m(2, 0), wy = m(2, 1), wz = m(2, 2), w0 = m(2, 3);
  const float lowU = lines.low.x(), lowV = lines.low.y(), scale = lines.inverseCell;
  const float columns = lines.width, rows = lines.height;
  const int width = lines.width, outside = lines.width * lines.height;
  const float slope = lines.perspective ? 1.0f : 0.0f, parallel = 1.0f - slope;
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float depth = wx * x[k] + wy * y[k] + wz * z[k] + w0;
    const float ahead = slope * depth + parallel;
    const float u = ((ux * x[k] + uy * y[k] + uz * z[k] + u0) / ahead - lowU) * scale;
    const float v = ((vx * x[k] + vy * y[k] + vz * z[k] + v0) / ahead - lowV) * scale;
    const bool isInside = (ahead > 0.0f) & (u >= 0.0f) & (v >= 0.0f) & (u < columns) & (v < rows);
    const int column = static_cast<int>(std::min(std::max(0.0f, u), columns));
    const int row = static_cast<int>(std::min(std::max(0.0f, v), rows));
    const float offU = 2.0f * (u - column) - 1.0f, offV = 2.0f * (v - row) - 1.0f; // from the middle of the cell
    cells[k] = isInside ? row * width + column : outside;
    depths[k] = depth;
    insides[k] = (1.0f - offU * offU) * (1.0f - offV * offV);
  }
}

/// Which cells of a row are not seen, but one about them is. Rows have a border of one cell; `column` is
/// room for what its cells have in each column.
void findGaps(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below, int width,
  std::uint8_t* column, std::uint8_t* isGap)
{
#pragma omp simd
  for (int k = 0; k < width + 2; ++k)
  {
    column[k] = above[k] | row[k] | below[k];
  }
#pragma omp simd
  for (int k = 0; k < width; ++k)
  {
    isGap[k] = (column[k] | column[k + 1] | column[k + 2]) & (row[k + 1] ^ 1);
  }
}
}

DepthMap::DepthMap(const Points& surface, const Sensor& sensor, double cellSize, int threads)
  : IsPerspective(sensor.perspective)
  , Eye(sensor.perspective ? sensor.position.cast<float>().eval() : Eigen::Vector3f::Zero().eval())
  , CellSize(cellSize)
{
  const Eigen::Vector3f direction = sensor.direction.cast<float>();
  const Eigen::Vector3f across = Eigen::Vector3f::UnitX() - direction.x() * direction;
  const Eigen::Matrix3f frame = frameAround(direction);
  const Eigen::Vector3f right = across.norm() > 1e-3f ? across.normalized() : Eigen::Vector3f(frame.col(1));
  this->Axes.row(0) = right;
  this->Axes.row(1) = direction.cross(right);
  this->Axes.row(2) = direction;
  const int size = static_cast<int>(surface.size());
  Points projected(surface.size()); // not numbers where the sensor cannot have seen anything
  parallelFor(size, threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Vector3f p = this->project(surface[i]);
        const bool isSeen = p.allFinite() && (!sensor.perspective || p.z() > 0.0f);
        projected[i] = isSeen ? p : Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
      }
    });
  double depthSum = 0.0;
  std::size_t count = 0;
  for (const auto& p : projected)
  {
    if (p.z() == p.z())
    {
      depthSum += p.z();
      ++count;
    }
  }
  if (count == 0)
  {
    return;
  }
  Eigen::AlignedBox3f box = bounds(projected);
  if (sensor.perspective && box.max().z() > FarDepths * depthSum / count)
  {
    depthSum = count * innerBounds(projected, MiddleShare).center().z(); // stray points do not tell where the scene is
  }
  // A perspective map lies at depth 1.
  float cell = static_cast<float>(sensor.perspective ? cellSize * count / depthSum : cellSize);
  if (!(box.sizes().head<2>().maxCoeff() < LargestSide * cell))
  {
    box = innerBounds(projected, StrayShare); // stray points are left out
  }
  cell = std::max(cell, box.sizes().head<2>().maxCoeff() / LargestSide);
  this->InverseCell = 1.0f / cell;
  // The first points are well inside their cells: those of a regular scan do not all lie at borders.
  this->Low = box.min().head<2>().array() - 0.5f * cell;
  const Eigen::Array2f last = this->indexOf(box.max());
  this->Width = static_cast<int>(last.x()) + 1;
  this->Height = static_cast<int>(last.y()) + 1;
  this->Cells.assign(static_cast<std::size_t>(this->Width) * this->Height + 1, nothing());
  std::vector<int> cellOf(surface.size());
  parallelFor(size, threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        cellOf[i] = this->placeOfProjected(projected[i]).cell;
      }
    });
  const float layer = static_cast<float>(LayerCells * cellSize);
  // Each thread has cells of its own, and sums up their points in order. It looks at all points: more threads than
  // processors would only look more often.
  const std::int64_t shares = std::min(numberOfThreads(threads), numberOfThreads(0));
  const auto firstOf = [&](int share) { return static_cast<int>(share * this->Cells.size() / shares); };
  std::vector<Points> means(shares);
  parallelFor(static_cast<int>(shares), threads, {},
    [&](int begin, int end, int)
    { means[begin] = this->fillCells(surface, projected, cellOf, layer, firstOf(begin), firstOf(end)); });
  for (const Points& some : means)
  {
    this->Means.insert(this->Means.end(), some.begin(), some.end());
  }
  this->fillGaps(layer, threads);
}

void DepthMap::findPlaces(
  const Eigen::Isometry3f& toScene, const SoAPoints& points, int begin, int count, Places& places) const
{
  Eigen::Isometry3f fromEye = toScene;
  fromEye.translation() -= this->Eye;
  const Lines lines{ this->Axes * fromEye.matrix().topRows<3>(), this->IsPerspective, this->Low, this->InverseCell,
    this->Width, this->Height };
  lookAlong(lines, points.x.data() + begin, points.y.data() + begin, points.z.data() + begin, count, places.cells,
    places.depths, places.insides);
}

void DepthMap::relations(const Eigen::Isometry3f& toScene, const SoAPoints& points, int begin, int count,
  float tolerance, Relation* relations) const
{
  Places places;
  for (int done = 0; done < count; done += SoABlock)
  {
    const int size = std::min(SoABlock, count - done);
    this->findPlaces(toScene, points, begin + done, size, places);
    for (int k = 0; k < size; ++k)
    {
      const Cell& cell = this->Cells[places.cells[k]];
      relations[done + k] = relationTo(cell, places.depths[k], tolerance);
    }
  }
}

void DepthMap::meansAt(const SoAPoints& points, int begin, int count, Seen& seen) const
{
  assert(count <= SoABlock);
  Places places;
  this->findPlaces(Eigen::Isometry3f::Identity(), points, begin, count, places);
  constexpr float leastInside = std::numeric_limits<float>::min();
  for (int k = 0; k < count; ++k)
  {
    const Cell& cell = this->Cells[places.cells[k]];
    seen.x[k] = cell.mean.x();
    seen.y[k] = cell.mean.y();
    seen.z[k] = cell.mean.z();
    seen.inside[k] = cell.nearest < NothingSeen ? std::max(places.insides[k] * cell.weight, leastInside) : 0.0f;
  }
}

Points DepthMap::fillCells(const Points& surface, const Points& projected, const std::vector<int>& cellOf, float layer,
  int firstCell, int lastCell)
{
  const int size = static_cast<int>(surface.size());
  const auto isHere = [&](int i) { return cellOf[i] >= firstCell && cellOf[i] < lastCell; };
  for (int i = 0; i < size; ++i)
  {
    if (isHere(i))
    {
      Cell& seen = this->Cells[cellOf[i]];
      seen.nearest = std::min(seen.nearest, projected[i].z());
      seen.farthest = std::max(seen.farthest, projected[i].z());
    }
  }
  // In double precision the order of the points has no part in what a sum is rounded to.
  std::vector<Eigen::Vector4d> sums(lastCell - firstCell, Eigen::Vector4d::Zero()); // of weighted points, and weights
  for (int i = 0; i < size; ++i)
  {
    if (isHere(i) && projected[i].z() <= this->Cells[cellOf[i]].nearest + layer)
    {
      const Eigen::Array2f index = this->indexOf(projected[i]);
      const double weight = weightInCell<Eigen::Array2f>(index - index.cast<int>().cast<float>());
      sums[cellOf[i] - firstCell] += weight * surface[i].homogeneous().cast<double>();
    }
  }
  Points means;
  means.reserve(lastCell - firstCell);
  for (int k = 0; k < lastCell - firstCell; ++k)
  {
    const double weight = sums[k].w();
    if (weight > 0.0)
    {
      Cell& cell = this->Cells[firstCell + k];
      cell.mean = (sums[k].head<3>() / weight).cast<float>();
      cell.weight = static_cast<float>(std::min(1.0, weight));
      means.push_back(cell.mean);
    }
  }
  return means;
}

void DepthMap::fillGaps(float layer, int threads)
{
  // Between the samples of a surface some cells stay empty: the nearest surface around speaks for them.
  const std::size_t stride = static_cast<std::size_t>(this->Width) + 2; // with a border of cells that are not seen
  std::vector<std::uint8_t> seen(stride * (this->Height + 2), 0);
  parallelFor(this->Height, threads, {},
    [&](int begin, int end, int)
    {
      for (int row = begin; row < end; ++row)
      {
        for (int column = 0; column < this->Width; ++column)
        {
          seen[(row + 1) * stride + column + 1] = this->cellIn(row, column).nearest < NothingSeen ? 1 : 0;
        }
      }
    });
  parallelFor(this->Height, threads, {},
    [&](int begin, int end, int)
    {
      std::vector<std::uint8_t> column(stride), isGap(this->Width);
      for (int row = begin; row < end; ++row)
      {
        const std::uint8_t* above = &seen[row * stride];
        findGaps(above, above + stride, above + 2 * stride, this->Width, column.data(), isGap.data());
        for (int k = 0; k < this->Width; ++k)
        {
          if (isGap[k])
          {
            this->fillGap(row, k, above + k, stride, layer);
          }
        }
      }
    });
}

void DepthMap::fillGap(int row, int column, const std::uint8_t* seen, std::size_t stride, float layer)
{
  Cell& cell = this->cellIn(row, column);
  const Cell* beside[8];
  int found = 0;
  for (int v = 0; v < 3; ++v)
  {
    for (int u = 0; u < 3; ++u)
    {
      if (seen[v * stride + u])
      {
        beside[found++] = &this->cellIn(row + v - 1, column + u - 1);
        cell.nearest = std::min(cell.nearest, beside[found - 1]->nearest);
      }
    }
  }
  float weights = 0.0f;
  for (int k = 0; k < found; ++k)
  {
    const Cell& other = *beside[k];
    if (other.nearest <= cell.nearest + layer)
    {
      weights += other.weight;
      cell.mean += other.weight / weights * (other.mean - cell.mean);
      const bool isOneLayer = other.farthest <= cell.nearest + layer;
      cell.farthest = std::max(cell.farthest, isOneLayer ? other.farthest : other.nearest);
    }
  }
  cell.weight = std::min(1.0f, weights);
}
}
