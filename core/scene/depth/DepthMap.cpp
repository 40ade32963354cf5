// SPDX-License-Identifier: BSD-3-Clause
#include "scene/depth/DepthMap.h"

#include "base/Parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace meam
{
namespace
{
constexpr int FewestNeighbours = 4; // of the eight cells about one, that tell which way the surface faces

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

DepthMap::DepthMap(const ScanProjection& scan, double cellSize, int threads)
  : DepthGrid(scan, cellSize)
{
  if (scan.count() == 0)
  {
    return;
  }
  this->Cells.assign(static_cast<std::size_t>(this->Width) * this->Height + 1, nothing());
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
        means[begin] = this->fillRows(scan, firstOf(begin), firstOf(begin + 1));
      }
    });
  this->Means = std::move(means.front());
  for (auto some = means.begin() + 1; some != means.end(); ++some)
  {
    this->Means.insert(this->Means.end(), some->begin(), some->end());
  }
  this->fillGaps(this->layer(), threads);
  this->Normals.assign(this->Cells.size(), Eigen::Vector3f::Zero());
  parallelForEach(this->Width * this->Height, threads, {}, [&](int k) { this->Normals[k] = this->normalOf(k); });
  const auto gaps = std::count_if(this->Cells.begin(), this->Cells.end(), [](const Cell& cell) { return cell.isGap; });
  this->Pitch =
    cellSize * std::sqrt(static_cast<double>(this->Means.size() + gaps) / static_cast<double>(scan.count()));
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
  const float layer = this->layer();
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

Points DepthMap::fillRows(const ScanProjection& scan, int firstRow, int lastRow)
{
  std::vector<int> runs;
  for (std::size_t k = 0; k < scan.runs().size(); ++k)
  {
    const Rectangle cells = this->cellsOf(scan.runs()[k]);
    if (cells.top < lastRow && cells.bottom > firstRow)
    {
      runs.push_back(static_cast<int>(k));
    }
  }
  const Rectangle rows{ 0, firstRow, this->Width, lastRow };
  const Layers layers = this->layersIn(rows, scan, runs);
  Cell* const own = this->Cells.data() + static_cast<std::size_t>(firstRow) * this->Width;
  Points means;
  means.reserve(rows.size());
  for (int k = 0; k < rows.size(); ++k)
  {
    if (layers.nearest[k] < NothingSeen)
    {
      const float weight = static_cast<float>(std::min(1.0, layers.weighted[k].w()));
      own[k] = { layers.nearest[k], layers.farthest[k], layers.mean(k), weight, false };
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
  parallelForEach(this->Height, threads, {},
    [&](int row)
    {
      for (int column = 0; column < this->Width; ++column)
      {
        seen[(row + 1) * stride + column + 1] = this->cellIn(row, column).nearest < NothingSeen ? 1 : 0;
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
