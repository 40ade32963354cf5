// SPDX-License-Identifier: BSD-3-Clause
#include "PointGrid.h"

#include "Error.h"

#include <cmath>
#include <numeric>
#include <tuple>

namespace meam
{
namespace
{
constexpr double MostCells = 4e6;
constexpr double SameDistance = 1e-4; // of a cube's side
constexpr double StrayShare = 0.001; // of the points, at each end of each axis

/// A cube of side leafSize, counted from the origin.
struct Cube
{
  std::int64_t x, y, z;
  bool operator==(const Cube& other) const { return this->x == other.x && this->y == other.y && this->z == other.z; }
};

std::size_t hashOf(const Cube& cube)
{
  const auto bits = [](std::int64_t index) { return static_cast<std::uint64_t>(index); }; // these may wrap
  const std::uint64_t mixed =
    (bits(cube.x) * 0x9E3779B97F4A7C15ull) ^ (bits(cube.y) * 0xC2B2AE3D27D4EB4Full) ^ (bits(cube.z) * 0x165667B19E3779F9ull);
  return mixed ^ (mixed >> 32);
}
}

PointGrid::PointGrid(const Points& points, double cellSize)
{
  Eigen::AlignedBox3f box = bounds(points);
  if (box.isEmpty())
  {
    return;
  }
  double cell = cellSize;
  if (!(cell > 0.0) || !std::isfinite(cell) || !box.sizes().allFinite())
  {
    throw Error("Points cannot be sorted into cells of " + std::to_string(cellSize) +
      " mm: the points coincide, a length is zero, or coordinates are far beyond any part's size.");
  }
  // Stray points far away must cost neither memory nor speed: they go to the cells of the border. Then
  // cells grow until their number is reasonable.
  const auto cells = [&]() -> Eigen::Array3d { return (box.sizes().cast<double>() / cell).array().floor() + 1.0; };
  if (cells().prod() > MostCells)
  {
    box = innerBounds(points, StrayShare);
  }
  while (cells().prod() > MostCells)
  {
    cell *= 1.25;
  }
  this->Origin = box.min();
  this->InverseCell = static_cast<float>(1.0 / cell);
  this->Size = cells().cast<int>();
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
      this->Sorted.set(place, points[i]);
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
    Cube cube;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    int nearest = -1;
    double distance = 0.0; // to the mean
  };
  constexpr double farthest = 9e18; // what 64 bits count
  const auto cubeOf = [&](const Eigen::Vector3f& point)
  {
    const Eigen::Array3d cell = (point.cast<double>() / leafSize).array().floor().max(-farthest).min(farthest);
    return Cube{ static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
      static_cast<std::int64_t>(cell.z()) };
  };
  // An open hash table of cells: place of a cube in `cells`, or -1.
  std::size_t size = 16;
  while (size < 2 * points.size())
  {
    size *= 2;
  }
  std::vector<int> cellAt(size, -1);
  std::vector<Cell> cells;
  std::vector<int> cellOf(points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!points[i].allFinite())
    {
      continue;
    }
    const Cube cube = cubeOf(points[i]);
    std::size_t slot = hashOf(cube) & (size - 1);
    while (cellAt[slot] >= 0 && !(cells[cellAt[slot]].cube == cube))
    {
      slot = (slot + 1) & (size - 1);
    }
    if (cellAt[slot] < 0)
    {
      cellAt[slot] = static_cast<int>(cells.size());
      cells.emplace_back();
      cells.back().cube = cube;
    }
    cellOf[i] = cellAt[slot];
    cells[cellOf[i]].sum += points[i].cast<double>();
    ++cells[cellOf[i]].count;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (cellOf[i] < 0)
    {
      continue;
    }
    Cell& cell = cells[cellOf[i]];
    const double distance = (points[i].cast<double>() - cell.sum / cell.count).norm() / leafSize;
    const double nearer = cell.distance - distance;
    // Of two points both are equally near to their mean: the one nearer to the cube's middle.
    const auto offCentre = [&](int k)
    {
      const Eigen::Array3d middle(cell.cube.x + 0.5, cell.cube.y + 0.5, cell.cube.z + 0.5);
      return (points[k].cast<double>().array() / leafSize - middle).matrix().squaredNorm();
    };
    if (cell.nearest < 0 || nearer > SameDistance ||
      (nearer > -SameDistance && offCentre(static_cast<int>(i)) < offCentre(cell.nearest)))
    {
      cell.nearest = static_cast<int>(i);
      cell.distance = distance;
    }
  }
  std::sort(cells.begin(), cells.end(),
    [](const Cell& a, const Cell& b)
    { return std::tie(a.cube.z, a.cube.y, a.cube.x) < std::tie(b.cube.z, b.cube.y, b.cube.x); });
  std::vector<int> kept;
  kept.reserve(cells.size());
  for (const Cell& cell : cells)
  {
    kept.push_back(cell.nearest);
  }
  return kept;
}
}
