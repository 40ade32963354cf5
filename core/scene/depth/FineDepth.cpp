// SPDX-License-Identifier: BSD-3-Clause
#include "scene/depth/FineDepth.h"

#include <algorithm>

namespace meam
{
namespace
{
/// Cells, the longer side of what half of the scan's runs come to, or more: a tile that is smaller would look at most
/// of its points in vain, and one of a scan in no order is all of the map.
float lengthOfRuns(const ScanProjection& scan, float inverseCell)
{
  std::vector<float> lengths;
  for (const ScanProjection::Run& run : scan.runs())
  {
    const float length = (run.high - run.low).maxCoeff();
    if (length >= 0.0f)
    {
      lengths.push_back(length);
    }
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return lengths.empty() ? 0.0f : *middle * inverseCell;
}
}

FineDepth::FineDepth(const ScanProjection& scan, double cellSize)
  : DepthGrid(scan, cellSize)
  , Scan(scan)
{
  const int largest = std::max(this->Width, this->Height);
  const float wanted = lengthOfRuns(scan, this->InverseCell);
  while ((1 << this->TileBits) < largest && static_cast<float>(1 << this->TileBits) < wanted)
  {
    ++this->TileBits;
  }
  this->TileMask = (1 << this->TileBits) - 1;
  const auto tiles = [&](int cells) { return (cells + this->TileMask) >> this->TileBits; };
  this->TilesInRow = tiles(this->Width);
  const std::size_t count = static_cast<std::size_t>(this->TilesInRow) * tiles(this->Height);
  this->Runs.resize(count);
  for (std::size_t k = 0; k < scan.runs().size(); ++k)
  {
    const Rectangle cells = this->cellsOf(scan.runs()[k]);
    for (int down = cells.top >> this->TileBits; down < tiles(cells.bottom); ++down)
    {
      for (int right = cells.left >> this->TileBits; right < tiles(cells.right); ++right)
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
