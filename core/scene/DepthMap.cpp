// SPDX-License-Identifier: BSD-3-Clause
#include "scene/DepthMap.h"

#include "base/AllVectors.h"
#include "base/Bounds.h"
#include "base/Frames.h"
#include "base/Parallel.h"
#include "base/PointGrid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace meam
{
namespace
{
constexpr double LayerCells = 2.0;   // cells, depth of the layer that is averaged: a slope of 63 degrees across a cell
constexpr int FewestNeighbours = 4;  // of the eight cells about one, that tell which way the surface faces
constexpr double StrayShare = 0.001; // of the points, at each end of each axis: left out of a map too wide
constexpr double FarDepths = 1.9;    // times the mean depth: nothing of a bin is farther, only stray points are

constexpr float LargestSide = 2048.0f; // cells, a limit of memory; a wider scene gets coarser cells
constexpr double MiddleShare = 0.49;   // of the points, at each end of each axis; leaves next to the medians
constexpr int RunLength = 64;          // points looked at together; a longer run comes to more rows of the map

/// Where a map's cells lie across the lines of sight.
struct MapCells
{
  Eigen::Vector2f low;
  float inverseCell;
  int width, height;
};

/// A map's lines of sight, for points that `toAxes` takes to its axes.
struct Lines
{
  Eigen::Matrix<float, 3, 4> toAxes;
  bool perspective;
  MapCells cells;
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
  const float lowU = lines.cells.low.x(), lowV = lines.cells.low.y(), scale = lines.cells.inverseCell;
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

/// From points of a scan to the axes of a map.
struct Projection
{
  Eigen::Matrix3f axes;
  Eigen::Vector3f eye;
  bool perspective;
};

/// Points of a scan that are looked at together: coordinates on a map's axes, divided by the depth when it is
/// perspective. Not numbers where the sensor cannot have seen anything.
struct ProjectedPoints
{
  float u[RunLength], v[RunLength], depth[RunLength];
};

ProjectedPoints nothingSeen()
{
  ProjectedPoints points;
  for (float* values : { points.u, points.v, points.depth })
  {
    std::fill_n(values, RunLength, std::numeric_limits<float>::quiet_NaN());
  }
  return points;
}

MEAM_ALL_VECTORS
void projectPoints(const Projection& to, const float* xyz, int count, ProjectedPoints& points)
{
  constexpr float infinity = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
  const Eigen::Matrix3f& m = to.axes;
  const float ux = m(0, 0), uy = m(0, 1), uz = m(0, 2);
  const float vx = m(1, 0), vy = m(1, 1), vz = m(1, 2);
  const float wx = m(2, 0), wy = m(2, 1), wz = m(2, 2);
  const float eyeX = to.eye.x(), eyeY = to.eye.y(), eyeZ = to.eye.z();
  const float slope = to.perspective ? 1.0f : 0.0f, parallel = 1.0f - slope;
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float x = xyz[3 * k] - eyeX, y = xyz[3 * k + 1] - eyeY, z = xyz[3 * k + 2] - eyeZ;
    const float depth = wx * x + (wy * y + wz * z);
    const float ahead = slope * depth + parallel;
    const float u = (ux * x + (uy * y + uz * z)) / ahead;
    const float v = (vx * x + (vy * y + vz * z)) / ahead;
    const bool isSeen =
      (std::abs(u) < infinity) & (std::abs(v) < infinity) & (std::abs(depth) < infinity) & (ahead > 0.0f);
    points.u[k] = isSeen ? u : none;
    points.v[k] = isSeen ? v : none;
    points.depth[k] = isSeen ? depth : none;
  }
}

/// What a map has to know of points before it has cells, lane by lane.
struct Extent
{
  float low[3][PointLanes], high[3][PointLanes];
  double depths[PointLanes]; ///< their sum
  double counts[PointLanes];
};

Extent nowhere()
{
  Extent extent{};
  std::fill_n(extent.low[0], 3 * PointLanes, std::numeric_limits<float>::infinity());
  std::fill_n(extent.high[0], 3 * PointLanes, -std::numeric_limits<float>::infinity());
  return extent;
}

inline __attribute__((always_inline)) void extend(const float* values, float* low, float* high)
{
#pragma omp simd
  for (int k = 0; k < PointLanes; ++k)
  {
    low[k] = values[k] < low[k] ? values[k] : low[k]; // false for no numbers
    high[k] = values[k] > high[k] ? values[k] : high[k];
  }
}

MEAM_ALL_VECTORS
void extend(const ProjectedPoints& points, int count, Extent& extent)
{
  Extent result = extent;
  for (int begin = 0; begin < count; begin += PointLanes)
  {
    extend(points.u + begin, result.low[0], result.high[0]);
    extend(points.v + begin, result.low[1], result.high[1]);
    extend(points.depth + begin, result.low[2], result.high[2]);
#pragma omp simd
    for (int k = 0; k < PointLanes; ++k)
    {
      const float depth = points.depth[begin + k];
      const bool isSeen = depth == depth;
      result.depths[k] += isSeen ? static_cast<double>(depth) : 0.0;
      result.counts[k] += isSeen ? 1.0 : 0.0;
    }
  }
  extent = result;
}

/// The cells of points, counted from `first`, and -1 for those in none of the next `cells`; their weights in their
/// cells.
MEAM_ALL_VECTORS
void place(
  const ProjectedPoints& points, int count, const MapCells& map, int first, int cells, int* cellOf, float* weights)
{
  const float lowU = map.low.x(), lowV = map.low.y(), scale = map.inverseCell;
  const float columns = map.width, rows = map.height;
  const int width = map.width;
  constexpr float strip = static_cast<float>(BorderStrip);
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float u = (points.u[k] - lowU) * scale, v = (points.v[k] - lowV) * scale;
    const bool isInside = (u >= 0.0f) & (v >= 0.0f) & (u < columns) & (v < rows); // false for no numbers
    const int column = static_cast<int>(isInside ? u : 0.0f), row = static_cast<int>(isInside ? v : 0.0f);
    const int cell = row * width + column - first;
    const float inU = 0.5f - std::abs(u - static_cast<float>(column) - 0.5f);
    const float inV = 0.5f - std::abs(v - static_cast<float>(row) - 0.5f);
    const float weight = std::min(inU / strip, 1.0f) * std::min(inV / strip, 1.0f);
    cellOf[k] = isInside & (cell >= 0) & (cell < cells) ? cell : -1;
    weights[k] = std::max(std::numeric_limits<float>::min(), weight);
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

DepthMap::DepthMap(const Points& surface, const Sensor& sensor, double cellSize, int threads, Detail detail)
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
  const Projection projection{ this->Axes, this->Eye, this->IsPerspective };
  const int size = static_cast<int>(surface.size());
  std::vector<Run> runs((size + RunLength - 1) / RunLength);
  struct Summary // of what comes together to one sum, whatever the number of threads
  {
    Eigen::AlignedBox3f box;
    double depths = 0.0;
    std::int64_t count = 0;
  };
  std::vector<Summary> summaries(runs.size());
  parallelFor(static_cast<int>(runs.size()), threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        runs[i].begin = i * RunLength;
        runs[i].end = std::min(size, runs[i].begin + RunLength);
        Summary& summary = summaries[i];
        const int count = runs[i].end - runs[i].begin;
        ProjectedPoints points;
        if (count < RunLength)
        {
          points = nothingSeen();
        }
        projectPoints(projection, surface[runs[i].begin].data(), count, points);
        Extent extent = nowhere();
        extend(points, RunLength, extent);
        for (int axis = 0; axis < 3; ++axis)
        {
          summary.box.min()[axis] = *std::min_element(extent.low[axis], extent.low[axis] + PointLanes);
          summary.box.max()[axis] = *std::max_element(extent.high[axis], extent.high[axis] + PointLanes);
        }
        summary.depths = std::accumulate(extent.depths, extent.depths + PointLanes, 0.0);
        summary.count = static_cast<std::int64_t>(std::accumulate(extent.counts, extent.counts + PointLanes, 0.0));
        runs[i].low = summary.box.min().y();
        runs[i].high = summary.box.max().y();
      }
    });
  Summary all;
  for (const Summary& summary : summaries)
  {
    if (summary.count > 0)
    {
      all.box.extend(summary.box);
    }
    all.depths += summary.depths;
    all.count += summary.count;
  }
  if (all.count == 0)
  {
    return;
  }
  const auto projected = [&] // to look at stray points, of which there are hardly ever any
  {
    Points points;
    points.reserve(surface.size());
    for (const Run& run : runs)
    {
      ProjectedPoints some;
      projectPoints(projection, surface[run.begin].data(), run.end - run.begin, some);
      for (int k = 0; k < run.end - run.begin; ++k)
      {
        points.emplace_back(some.u[k], some.v[k], some.depth[k]);
      }
    }
    return points;
  };
  Eigen::AlignedBox3f box = all.box;
  if (sensor.perspective && box.max().z() > FarDepths * all.depths / all.count)
  {
    // Stray points do not tell where the scene is.
    all.depths = all.count * innerBounds(projected(), MiddleShare).center().z();
  }
  // A perspective map lies at depth 1.
  float cell = static_cast<float>(sensor.perspective ? cellSize * all.count / all.depths : cellSize);
  if (!(box.sizes().head<2>().maxCoeff() < LargestSide * cell))
  {
    box = innerBounds(projected(), StrayShare); // stray points are left out
  }
  cell = std::max(cell, box.sizes().head<2>().maxCoeff() / LargestSide);
  this->InverseCell = 1.0f / cell;
  // The first points are well inside their cells: those of a regular scan do not all lie at borders.
  this->Low = box.min().head<2>().array() - 0.5f * cell;
  const Eigen::Array2f last = this->indexOf(box.max());
  this->Width = static_cast<int>(last.x()) + 1;
  this->Height = static_cast<int>(last.y()) + 1;
  this->Cells.assign(static_cast<std::size_t>(this->Width) * this->Height + 1, nothing());
  const float layer = static_cast<float>(LayerCells * cellSize);
  // Each thread has rows of its own, and sums up their points in order. Runs that come to the rows of two are looked at
  // by both: more threads than processors would only look more often.
  const std::int64_t shares = std::min(numberOfThreads(threads), numberOfThreads(0));
  const auto firstOf = [&](int share) { return static_cast<int>(share * this->Height / shares); };
  std::vector<Points> means(shares);
  parallelFor(static_cast<int>(shares), threads, {},
    [&](int begin, int end, int)
    {
      for (; begin < end; ++begin)
      {
        means[begin] = this->fillRows(surface, runs, layer, firstOf(begin), firstOf(begin + 1));
      }
    });
  this->Means = std::move(means.front());
  for (auto some = means.begin() + 1; some != means.end(); ++some)
  {
    this->Means.insert(this->Means.end(), some->begin(), some->end());
  }
  if (detail == Detail::Surface)
  {
    this->fillGaps(layer, threads);
    this->Normals.assign(this->Cells.size(), Eigen::Vector3f::Zero());
    parallelFor(this->Width * this->Height, threads, {},
      [&](int begin, int end, int)
      {
        for (int k = begin; k < end; ++k)
        {
          this->Normals[k] = this->normalOf(k);
        }
      });
  }
  const auto gaps = std::count_if(this->Cells.begin(), this->Cells.end(), [](const Cell& cell) { return cell.isGap; });
  this->Pitch = cellSize * std::sqrt(static_cast<double>(this->Means.size() + gaps) / static_cast<double>(all.count));
}

void DepthMap::findPlaces(
  const Eigen::Isometry3f& toScene, const SoAPoints& points, int begin, int count, Places& places) const
{
  Eigen::Isometry3f fromEye = toScene;
  fromEye.translation() -= this->Eye;
  const Lines lines{ this->Axes * fromEye.matrix().topRows<3>(), this->IsPerspective,
    { this->Low, this->InverseCell, this->Width, this->Height } };
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

Eigen::Vector3f DepthMap::normalOf(int place) const
{
  // The cells about one, in order, the first once more: two that follow each other make a triangle with the one amid.
  constexpr int right[] = { 1, 1, 0, -1, -1, -1, 0, 1, 1 }, down[] = { 0, 1, 1, 1, 0, -1, -1, -1, 0 };
  const Cell& cell = this->Cells[place];
  if (!(cell.nearest < NothingSeen))
  {
    return Eigen::Vector3f::Zero();
  }
  const float layer = static_cast<float>(LayerCells * this->CellSize);
  const int row = place / this->Width, column = place % this->Width;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero(), last = Eigen::Vector3f::Zero();
  int neighbours = 0;
  for (int k = 0; k < 9; ++k)
  {
    const int v = row + down[k], u = column + right[k];
    Eigen::Vector3f edge = Eigen::Vector3f::Zero(); // stays so where there is no neighbour
    if (v >= 0 && v < this->Height && u >= 0 && u < this->Width)
    {
      const Cell& beside = this->Cells[static_cast<std::size_t>(v) * this->Width + u];
      if (!beside.isGap && std::abs(beside.nearest - cell.nearest) <= layer)
      {
        edge = beside.mean - cell.mean;
        neighbours += k < 8 ? 1 : 0;
      }
    }
    sum += edge.cross(last);
    last = edge;
  }
  const float length = sum.norm();
  return neighbours >= FewestNeighbours && length > 0.0f ? Eigen::Vector3f(sum / length) : Eigen::Vector3f::Zero();
}

Points DepthMap::fillRows(const Points& surface, const std::vector<Run>& runs, float layer, int firstRow, int lastRow)
{
  const Projection projection{ this->Axes, this->Eye, this->IsPerspective };
  const MapCells map{ this->Low, this->InverseCell, this->Width, this->Height };
  const int first = firstRow * this->Width, cells = (lastRow - firstRow) * this->Width;
  Cell* const own = this->Cells.data() + first;
  /// Calls visit(point, cell, depth, weight) for all points in these rows, in their order.
  const auto forEach = [&](const auto& visit)
  {
    ProjectedPoints points;
    int cellOf[RunLength];
    float weights[RunLength];
    for (const Run& run : runs)
    {
      // False for a run of which nothing is seen.
      if (!((run.high - this->Low.y()) * this->InverseCell >= static_cast<float>(firstRow)) ||
          !((run.low - this->Low.y()) * this->InverseCell < static_cast<float>(lastRow)))
      {
        continue;
      }
      const int count = run.end - run.begin;
      projectPoints(projection, surface[run.begin].data(), count, points);
      place(points, count, map, first, cells, cellOf, weights);
      for (int k = 0; k < count; ++k)
      {
        if (cellOf[k] >= 0)
        {
          visit(surface[run.begin + k], cellOf[k], points.depth[k], weights[k]);
        }
      }
    }
  };
  forEach(
    [&](const Eigen::Vector3f&, int cell, float depth, float)
    {
      own[cell].nearest = std::min(own[cell].nearest, depth);
      own[cell].farthest = std::max(own[cell].farthest, depth);
    });
  // In double precision the order of the points has no part in what a sum is rounded to.
  std::vector<Eigen::Vector4d> sums(cells, Eigen::Vector4d::Zero()); // of weighted points, and weights
  forEach(
    [&](const Eigen::Vector3f& point, int cell, float depth, float weight)
    {
      if (depth <= own[cell].nearest + layer)
      {
        sums[cell] += static_cast<double>(weight) * point.homogeneous().cast<double>();
      }
    });
  Points means;
  means.reserve(cells);
  for (int k = 0; k < cells; ++k)
  {
    const double weight = sums[k].w();
    if (weight > 0.0)
    {
      own[k].mean = (sums[k].head<3>() / weight).cast<float>();
      own[k].weight = static_cast<float>(std::min(1.0, weight));
      means.push_back(own[k].mean);
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
  cell.isGap = true;
}
}
