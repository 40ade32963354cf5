// SPDX-License-Identifier: BSD-3-Clause
#include "PointGrid.h"

#include <cmath>
#include <numeric>
#include <unordered_map>

namespace meam
{
namespace
{
constexpr double MostCells = 4e6;
}

PointGrid::PointGrid(const Points& points, double cellSize)
{
  const Eigen::AlignedBox3f box = bounds(points);
  if (box.isEmpty())
  {
    return;
  }
  this->Origin = box.min();
  // A stray point far away must not cost memory: cells grow until their number is reasonable.
  double cell = cellSize;
  const auto cells = [&] { return (box.sizes().cast<double>() / cell).array().floor() + 1.0; };
  while (cells().prod() > MostCells)
  {
    cell *= 1.25;
  }
  this->InverseCell = static_cast<float>(1.0 / cell);
  this->Size = this->cellOf(box.max()).array() + 1;
  std::vector<int> cellAt(points.size(), -1);
  this->Starts.assign(static_cast<std::size_t>(this->Size.x()) * this->Size.y() * this->Size.z() + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (points[i].allFinite())
    {
      const Eigen::Vector3i at = this->cellOf(points[i]);
      cellAt[i] = (at.z() * this->Size.y() + at.y()) * this->Size.x() + at.x();
      ++this->Starts[cellAt[i] + 1];
    }
  }
  std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
  std::vector<int> next(this->Starts.begin(), this->Starts.end() - 1);
  this->Order.resize(this->Starts.back());
  this->Sorted.resize(this->Starts.back());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (cellAt[i] >= 0)
    {
      const int place = next[cellAt[i]]++;
      this->Order[place] = static_cast<int>(i);
      this->Sorted[place] = points[i];
    }
  }
}

std::vector<int> thinPoints(const Points& points, double leafSize)
{
  if (leafSize <= 0.0)
  {
    std::vector<int> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  struct Cell
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    int nearest = -1;
    double distance = 0.0;
  };
  const auto codeOf = [&](const Eigen::Vector3f& point)
  {
    const Eigen::Array3d cell = (point.cast<double>() / leafSize).array().floor();
    constexpr std::int64_t mask = (1 << 21) - 1;
    return (static_cast<std::int64_t>(cell.x()) & mask) | ((static_cast<std::int64_t>(cell.y()) & mask) << 21) |
      ((static_cast<std::int64_t>(cell.z()) & mask) << 42);
  };
  std::unordered_map<std::int64_t, int> cellAt;
  std::vector<Cell> cells;
  std::vector<int> cellOf(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto [entry, isNew] = cellAt.try_emplace(codeOf(points[i]), static_cast<int>(cells.size()));
    if (isNew)
    {
      cells.emplace_back();
    }
    cellOf[i] = entry->second;
    cells[entry->second].sum += points[i].cast<double>();
    ++cells[entry->second].count;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    Cell& cell = cells[cellOf[i]];
    const double distance = (points[i].cast<double>() - cell.sum / cell.count).squaredNorm();
    if (cell.nearest < 0 || distance < cell.distance)
    {
      cell.nearest = static_cast<int>(i);
      cell.distance = distance;
    }
  }
  std::vector<int> kept;
  kept.reserve(cells.size());
  for (const Cell& cell : cells)
  {
    kept.push_back(cell.nearest);
  }
  return kept;
}
}
