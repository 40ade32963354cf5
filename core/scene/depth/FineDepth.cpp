// SPDX-License-Identifier: BSD-3-Clause
#include "scene/depth/FineDepth.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr int SmallestTileBits = 4;   // 16 cells a side: smaller tiles take more memory than they save time
constexpr std::size_t TilesOfRun = 2; // on average, at most: a tile looks at all points of its runs
}

FineDepth::FineDepth(const ScanProjection& scan, double cellSize)
  : DepthGrid(scan, cellSize)
  , Scan(scan)
{
  std::vector<Rectangle> cells;
  cells.reserve(scan.runs().size());
  for (const ScanProjection::Run& run : scan.runs())
  {
    cells.push_back(this->cellsOf(run));
  }
  /// Those that cells lie in.
  const auto tilesOf = [&](const Rectangle& of) -> Rectangle
  {
    const auto last = [&](int cell) { return (cell + (1 << this->TileBits) - 1) >> this->TileBits; };
    return { of.left >> this->TileBits, of.top >> this->TileBits, last(of.right), last(of.bottom) };
  };
  const auto isFine = [&]
  {
    std::size_t all = 0;
    for (const Rectangle& of : cells)
    {
      all += tilesOf(of).size();
    }
    return all > TilesOfRun * cells.size();
  };
  this->TileBits = SmallestTileBits;
  while ((1 << this->TileBits) < std::max(this->Width, this->Height) && isFine()) // of points in no order all is a tile
  {
    ++this->TileBits;
  }
  this->TileMask = (1 << this->TileBits) - 1;
  const Rectangle all = tilesOf({ 0, 0, this->Width, this->Height });
  const std::size_t count = all.size();
  this->TilesInRow = all.width();
  this->Runs.resize(count);
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const Rectangle tiles = tilesOf(cells[k]);
    for (int down = tiles.top; down < tiles.bottom; ++down)
    {
      for (int right = tiles.left; right < tiles.right; ++right)
      {
        this->Runs[static_cast<std::size_t>(down) * this->TilesInRow + right].push_back(static_cast<int>(k));
      }
    }
  }
  this->Filling = std::vector<std::mutex>(count);
  this->Tiles.resize(count);
  this->Ready = std::vector<std::atomic<const Eigen::Vector3f*>>(count);
}

const Eigen::Vector3f* FineDepth::fill(int right, int down) const
{
  const std::size_t tile = static_cast<std::size_t>(down) * this->TilesInRow + right;
  const std::lock_guard<std::mutex> lock(this->Filling[tile]);
  if (!this->Tiles[tile])
  {
    const int side = 1 << this->TileBits;
    const Rectangle cells{ right * side, down * side, (right + 1) * side, (down + 1) * side };
    const Layers layers = this->layersIn(cells, this->Scan, this->Runs[tile]);
    auto means = std::make_unique<Eigen::Vector3f[]>(cells.size());
    for (int k = 0; k < cells.size(); ++k)
    {
      means[k] = layers.nearest[k] < NothingSeen
                   ? layers.mean(k)
                   : Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()).eval();
    }
    this->Tiles[tile] = std::move(means);
    this->Ready[tile].store(this->Tiles[tile].get(), std::memory_order_release);
  }
  return this->Tiles[tile].get();
}
}
