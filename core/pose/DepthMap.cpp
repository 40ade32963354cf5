// SPDX-License-Identifier: BSD-3-Clause
#include "pose/DepthMap.h"

#include "Parallel.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr float Empty = std::numeric_limits<float>::infinity();
constexpr float LargestSide = 2048.0f; // cells; a wider scene gets coarser cells
constexpr double StrayShare = 0.001;   // of the points, at each end of each axis
constexpr double LayerCells = 2.0;     // depth of the layer that is averaged: a slope of 63 degrees across a cell
}

DepthMap::DepthMap(
  const Points& surface, const Sensor& sensor, double cellSize, const Eigen::Vector3f& along, int threads)
  : Eye(sensor)
  , CellSize(cellSize)
{
  const Eigen::Vector3f across = along - along.dot(sensor.direction) * sensor.direction;
  const Eigen::Matrix3f frame = frameAround(sensor.direction);
  const Eigen::Vector3f right = across.norm() > 1e-3f ? across.normalized() : Eigen::Vector3f(frame.col(1));
  this->Axes.row(0) = right;
  this->Axes.row(1) = sensor.direction.cross(right);
  this->Axes.row(2) = sensor.direction;
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
  // A perspective map lies at depth 1.
  float cell = static_cast<float>(sensor.perspective ? cellSize * count / depthSum : cellSize);
  Eigen::AlignedBox3f box = bounds(projected);
  if (!(box.sizes().head<2>().maxCoeff() < LargestSide * cell))
  {
    box = innerBounds(projected, StrayShare); // stray points are left out
  }
  cell = std::max(cell, box.sizes().head<2>().maxCoeff() / LargestSide);
  this->InverseCell = 1.0f / cell;
  this->Low = box.min().head<2>();
  this->Width = static_cast<int>(box.sizes().x() * this->InverseCell) + 1;
  this->Height = static_cast<int>(box.sizes().y() * this->InverseCell) + 1;
  this->Cells.assign(static_cast<std::size_t>(this->Width) * this->Height, { Empty, -Empty, Eigen::Vector3f::Zero() });
  std::vector<int> cellOf(surface.size());
  parallelFor(size, threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        cellOf[i] = this->placeOfProjected(projected[i]).cell;
      }
    });
  for (int i = 0; i < size; ++i)
  {
    if (cellOf[i] >= 0)
    {
      Cell& seen = this->Cells[cellOf[i]];
      seen.nearest = std::min(seen.nearest, projected[i].z());
      seen.farthest = std::max(seen.farthest, projected[i].z());
    }
  }
  const float layer = static_cast<float>(LayerCells * cellSize);
  this->average(surface, projected, cellOf, layer);
  this->fillGaps(layer, threads);
}

void DepthMap::average(const Points& surface, const Points& projected, const std::vector<int>& cellOf, float layer)
{
  // Sums are of what is beyond the first point: they keep their precision far from the origin.
  std::vector<int> counts(this->Cells.size(), 0);
  std::vector<int> first(this->Cells.size());
  for (std::size_t i = 0; i < surface.size(); ++i)
  {
    const int k = cellOf[i];
    if (k >= 0 && projected[i].z() <= this->Cells[k].nearest + layer)
    {
      if (counts[k]++ == 0)
      {
        first[k] = static_cast<int>(i);
      }
      else
      {
        this->Cells[k].mean += surface[i] - surface[first[k]];
      }
    }
  }
  for (std::size_t i = 0; i < this->Cells.size(); ++i)
  {
    if (counts[i] > 0)
    {
      this->Cells[i].mean = surface[first[i]] + this->Cells[i].mean / static_cast<float>(counts[i]);
      this->Means.push_back(this->Cells[i].mean);
    }
  }
}

void DepthMap::fillGaps(float layer, int threads)
{
  // Between the samples of a surface some cells stay empty: the nearest surface around speaks for them.
  const std::vector<Cell> seen = this->Cells;
  parallelFor(this->Height, threads, {},
    [&](int begin, int end, int)
    {
      for (int row = begin; row < end; ++row)
      {
        for (int column = 0; column < this->Width; ++column)
        {
          Cell& cell = this->Cells[static_cast<std::size_t>(row) * this->Width + column];
          if (cell.nearest < NothingSeen)
          {
            continue;
          }
          const Cell* beside[8];
          int found = 0;
          const int left = std::max(0, column - 1), right = std::min(this->Width - 1, column + 1);
          for (int v = std::max(0, row - 1); v <= std::min(this->Height - 1, row + 1); ++v)
          {
            for (int u = left; u <= right; ++u)
            {
              const Cell& other = seen[static_cast<std::size_t>(v) * this->Width + u];
              if (other.nearest < NothingSeen)
              {
                beside[found++] = &other;
                cell.nearest = std::min(cell.nearest, other.nearest);
              }
            }
          }
          int count = 0;
          for (int k = 0; k < found; ++k)
          {
            const Cell& other = *beside[k];
            if (other.nearest <= cell.nearest + layer)
            {
              cell.mean += (other.mean - cell.mean) / static_cast<float>(++count);
              const bool isOneLayer = other.farthest <= cell.nearest + layer;
              cell.farthest = std::max(cell.farthest, isOneLayer ? other.farthest : other.nearest);
            }
          }
        }
      }
    });
}
}
