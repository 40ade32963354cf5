// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/depth/DepthGrid.h"

#include <atomic>
#include <memory>
#include <mutex>

namespace meam
{
/// What was measured in small cells across the lines of sight. A tile of cells is filled when one of them is first
/// asked for: a search asks for few of them. Calls may run in parallel.
class FineDepth : public DepthGrid
{
public:
  /// `cellSize` as of the grid. `scan` has to outlive the map.
  FineDepth(const ScanProjection& scan, double cellSize);

  /// Mean of the nearest layer of a cell; null where nothing was measured.
  const Eigen::Vector3f* meanIn(int column, int row) const
  {
    const Eigen::Vector3f& mean = this->tileOf(column >> this->TileBits,
      row >> this->TileBits)[((row & this->TileMask) << this->TileBits) + (column & this->TileMask)];
    return std::isnan(mean.x()) ? nullptr : &mean;
  }
  const Eigen::Vector3f* meanIn(int cell) const { return this->meanIn(cell % this->Width, cell / this->Width); }
  /// The same as mm along the line of sight, NaN for null.
  float depthIn(int column, int row) const
  {
    const Eigen::Vector3f* mean = this->meanIn(column, row);
    return mean ? this->depthOf(*mean) : std::numeric_limits<float>::quiet_NaN();
  }
  /// By the mean at the line of sight through a point; `tolerance` in mm along it.
  Relation relation(const Eigen::Vector3f& point, float tolerance) const
  {
    const Place place = this->placeOf(point);
    const Eigen::Vector3f* mean = place.cell < 0 ? nullptr : this->meanIn(place.cell);
    return mean ? this->relationOf(place.depth, *mean, tolerance) : Relation::NoSurface;
  }

private:
  /// Means by row and column of the tile, NaN where nothing was measured.
  using Tile = std::unique_ptr<Eigen::Vector3f[]>;
  const Eigen::Vector3f* tileOf(int right, int down) const
  {
    const std::size_t tile = static_cast<std::size_t>(down) * this->TilesInRow + right;
    const Eigen::Vector3f* means = this->Ready[tile].load(std::memory_order_acquire);
    return means ? means : this->fill(right, down);
  }
  const Eigen::Vector3f* fill(int right, int down) const;

  const ScanProjection& Scan;
  int TileBits = 0, TileMask = 0; ///< of a column or row, its place in the tile
  int TilesInRow = 0;
  std::vector<std::vector<int>> Runs; ///< those that come to each tile
  mutable std::vector<std::mutex> Filling;
  mutable std::vector<Tile> Tiles;
  mutable std::vector<std::atomic<const Eigen::Vector3f*>> Ready; ///< null for a tile that is not filled
};
}
