// SPDX-License-Identifier: BSD-3-Clause
#include "scene/depth/DepthGrid.h"

#include "base/AllVectors.h"
#include "base/Bounds.h"
#include "base/PointGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr double LayerCells = 2.0;   // cells, depth of the layer that is averaged: a slope of 63 degrees across a cell
constexpr double StrayShare = 0.001; // of the points, at each end of each axis: left out of a grid too wide
constexpr double FarDepths = 1.9;    // times the mean depth: nothing of a bin is farther, only stray points are

constexpr float LargestSide = 2048.0f; // cells, a limit of memory; a wider scene gets coarser cells
constexpr double MiddleShare = 0.49;   // of the points, at each end of each axis; leaves next to the medians
constexpr int RunLength = ScanProjection::RunLength; // a name for it

/// Where a grid's cells lie across the lines of sight.
struct GridCells
{
  float lowU, lowV, inverseCell;
  int width, height;
};

/// A grid's lines of sight, for points that `toAxes` takes to its axes.
struct Lines
{
  Eigen::Matrix<float, 3, 4> toAxes;
  bool perspective;
  GridCells cells;
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
  const float lowU = lines.cells.lowU, lowV = lines.cells.lowV, scale = lines.cells.inverseCell;
  const float columns = lines.cells.width, rows = lines.cells.height;
  const int width = lines.cells.width, outside = lines.cells.width * lines.cells.height;
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

/// Columns and rows of cells, the last ones not among them.
struct CellRange
{
  int left, top, right, bottom;
};

/// The cells of points, counted from the first of a range, and -1 for those in none of it; their weights in their
/// cells.
MEAM_ALL_VECTORS
void place(const ScanProjection::RunPoints& points, int count, const GridCells& grid, const CellRange& in, int* cellOf,
  float* weights)
{
  const float lowU = grid.lowU, lowV = grid.lowV, scale = grid.inverseCell;
  const float left = in.left, right = in.right, top = in.top, bottom = in.bottom;
  const int width = in.right - in.left, first = in.top * width + in.left;
  constexpr float strip = static_cast<float>(BorderStrip);
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float u = (points.u[k] - lowU) * scale, v = (points.v[k] - lowV) * scale;
    const bool isInside = (u >= left) & (v >= top) & (u < right) & (v < bottom); // false for no numbers
    const int column = static_cast<int>(isInside ? u : left), row = static_cast<int>(isInside ? v : top);
    const float inU = 0.5f - std::abs(u - static_cast<float>(column) - 0.5f);
    const float inV = 0.5f - std::abs(v - static_cast<float>(row) - 0.5f);
    const float weight = std::min(inU / strip, 1.0f) * std::min(inV / strip, 1.0f);
    cellOf[k] = isInside ? row * width + column - first : -1;
    weights[k] = std::max(std::numeric_limits<float>::min(), weight);
  }
}
}

DepthGrid::DepthGrid(const ScanProjection& scan, double cellSize)
  : IsPerspective(scan.isPerspective())
  , Eye(scan.eye())
  , Axes(scan.axes())
  , CellSize(cellSize)
{
  if (scan.count() == 0)
  {
    return;
  }
  Eigen::AlignedBox3f box = scan.box();
  double depths = scan.depths();
  if (this->IsPerspective && box.max().z() > FarDepths * depths / scan.count())
  {
    // Stray points do not tell where the scene is.
    depths = scan.count() * innerBounds(scan.projected(), MiddleShare).center().z();
  }
  // A perspective grid lies at depth 1.
  float cell = static_cast<float>(this->IsPerspective ? cellSize * scan.count() / depths : cellSize);
  if (!(box.sizes().head<2>().maxCoeff() < LargestSide * cell))
  {
    box = innerBounds(scan.projected(), StrayShare); // stray points are left out
  }
  cell = std::max(cell, box.sizes().head<2>().maxCoeff() / LargestSide);
  this->InverseCell = 1.0f / cell;
  // The first points are well inside their cells: those of a regular scan do not all lie at borders.
  this->Low = box.min().head<2>().array() - 0.5f * cell;
  const Eigen::Array2f last = this->indexOf(box.max());
  this->Width = static_cast<int>(last.x()) + 1;
  this->Height = static_cast<int>(last.y()) + 1;
}

void DepthGrid::findPlaces(
  const Eigen::Isometry3f& toScene, const SoAPoints& points, int begin, int count, Places& places) const
{
  Eigen::Isometry3f fromEye = toScene;
  fromEye.translation() -= this->Eye;
  const Lines lines{ this->Axes * fromEye.matrix().topRows<3>(), this->IsPerspective,
    { this->Low.x(), this->Low.y(), this->InverseCell, this->Width, this->Height } };
  lookAlong(lines, points.x.data() + begin, points.y.data() + begin, points.z.data() + begin, count, places.cells,
    places.depths, places.insides);
}

float DepthGrid::layer() const { return static_cast<float>(LayerCells * this->CellSize); }

DepthGrid::Rectangle DepthGrid::cellsOf(const ScanProjection::Run& run) const
{
  const Eigen::Array2f size(this->Width, this->Height);
  const auto within = [&](const Eigen::Array2f& corner) -> Eigen::Array2i
  { return ((corner - this->Low) * this->InverseCell).max(-1.0f).min(size).floor().cast<int>(); };
  if (!(run.low <= run.high).all()) // nothing of it is seen
  {
    return {};
  }
  const Eigen::Array2i first = within(run.low).max(0), last = within(run.high);
  return { first.x(), first.y(), std::min(last.x() + 1, this->Width), std::min(last.y() + 1, this->Height) };
}

DepthGrid::Layers DepthGrid::layersIn(
  const Rectangle& cells, const ScanProjection& scan, const std::vector<int>& runs) const
{
  const GridCells grid{ this->Low.x(), this->Low.y(), this->InverseCell, this->Width, this->Height };
  struct InCell
  {
    int point, cell;
    float depth, weight;
  };
  thread_local std::vector<InCell> seen; // of the points those in the cells, in their order
  seen.clear();
  Layers layers;
  layers.nearest.assign(cells.size(), NothingSeen);
  layers.farthest.assign(cells.size(), -NothingSeen);
  ScanProjection::RunPoints points;
  int cellOf[RunLength];
  float weights[RunLength];
  for (const int which : runs)
  {
    const ScanProjection::Run& run = scan.runs()[which];
    const int count = run.end - run.begin;
    scan.project(run, points);
    place(points, count, grid, { cells.left, cells.top, cells.right, cells.bottom }, cellOf, weights);
    for (int k = 0; k < count; ++k)
    {
      const int cell = cellOf[k];
      if (cell >= 0)
      {
        const float depth = points.depth[k];
        layers.nearest[cell] = std::min(layers.nearest[cell], depth);
        layers.farthest[cell] = std::max(layers.farthest[cell], depth);
        seen.push_back({ run.begin + k, cell, depth, weights[k] });
      }
    }
  }
  // In double precision the order of the points has no part in what a sum is rounded to.
  layers.weighted.assign(cells.size(), Eigen::Vector4d::Zero());
  const float layer = this->layer();
  for (const auto& [point, cell, depth, weight] : seen)
  {
    if (depth <= layers.nearest[cell] + layer)
    {
      layers.weighted[cell] += static_cast<double>(weight) * scan.scan()[point].homogeneous().cast<double>();
    }
  }
  return layers;
}
}
