// SPDX-License-Identifier: BSD-3-Clause
#include "model/body/BodyInterior.h"

#include "base/AllVectors.h"
#include "base/Bounds.h"

#include <utility>

namespace meam
{
namespace
{
constexpr double Cell = 0.01;         // of the diameter, side of a cell; most cells tell of all their points
constexpr float HalfDiagonal = 0.87f; // of a cell, in sides
constexpr double MostLooked = 0.1;    // of the diameter: nothing that is deeper is near a sample
constexpr float SurelyBelow = 0.95f;  // cosine, way to the nearest sample against its normal: all points of a cell;
constexpr float StraightBelow = 0.7f; // of less a point lies beside an edge

/// Of the cells of a row the nearest sample so far.
struct Row
{
  float* squared; ///< mm^2, the distance to it
  int* samples;
};

/// Takes a sample for the cells that it is nearer to. `first`: mm along x from the sample to the middle of the first
/// cell, `cell`: mm between them, `besideSquared`: mm^2 across.
MEAM_ALL_VECTORS
void takeNearer(const Row& row, int count, float first, float cell, float besideSquared, int sample)
{
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float along = first + static_cast<float>(k) * cell;
    const float squared = along * along + besideSquared;
    const bool isNearer = squared < row.squared[k];
    row.squared[k] = isNearer ? squared : row.squared[k];
    row.samples[k] = isNearer ? sample : row.samples[k];
  }
}
}

BodyInterior::BodyInterior(const PointCloud& surface, double diameter, double depth, std::vector<std::uint8_t> cells)
  : Surface(surface)
  , Samples(surface.points, MostLooked * diameter)
  , Box(bounds(surface.points))
  , Size(0, 0, 0)
  , Deepest(static_cast<float>(MostLooked * diameter))
  , Least(static_cast<float>(depth))
  , CellSize(static_cast<float>(Cell * diameter))
  , Cells(std::move(cells))
{
  if (!this->Box.isEmpty())
  {
    this->Size = (this->Box.sizes().array() / this->CellSize).cast<int>() + 1;
  }
  if (this->Cells.size() != static_cast<std::size_t>(this->Size.prod()))
  {
    this->Cells = this->depths();
  }
}

std::vector<std::uint8_t> BodyInterior::depths() const
{
  const auto count = static_cast<std::size_t>(this->Size.prod());
  std::vector<float> squared(count, this->Deepest * this->Deepest);
  std::vector<int> samples(count, -1);
  const auto rowAt = [&](int y, int z) { return (static_cast<std::size_t>(z) * this->Size.y() + y) * this->Size.x(); };
  for (std::size_t i = 0; i < this->Surface.size(); ++i)
  {
    const Eigen::Array3f place = (this->Surface.points[i] - this->Box.min()).array();
    const Eigen::Array3i low = ((place - this->Deepest) / this->CellSize).max(0.0f).cast<int>();
    const Eigen::Array3i high = ((place + this->Deepest) / this->CellSize).cast<int>().min(this->Size - 1);
    const auto offset = [&](int cell, int axis)
    { return (static_cast<float>(cell) + 0.5f) * this->CellSize - place[axis]; };
    for (int z = low.z(); z <= high.z(); ++z)
    {
      for (int y = low.y(); y <= high.y(); ++y)
      {
        const std::size_t first = rowAt(y, z) + low.x();
        const float beside = offset(y, 1) * offset(y, 1) + offset(z, 2) * offset(z, 2);
        takeNearer({ &squared[first], &samples[first] }, high.x() - low.x() + 1, offset(low.x(), 0), this->CellSize,
          beside, static_cast<int>(i));
      }
    }
  }
  std::vector<std::uint8_t> depths(count, SomeDeep);
  for (int z = 0; z < this->Size.z(); ++z)
  {
    for (int y = 0; y < this->Size.y(); ++y)
    {
      for (int x = 0; x < this->Size.x(); ++x)
      {
        const std::size_t cell = rowAt(y, z) + x;
        if (samples[cell] >= 0)
        {
          const Eigen::Vector3f middle =
            this->Box.min() + this->CellSize * Eigen::Vector3f(x + 0.5f, y + 0.5f, z + 0.5f);
          depths[cell] =
            this->depthOf(this->Surface.points[samples[cell]] - middle, this->Surface.normals[samples[cell]]);
        }
      }
    }
  }
  return depths;
}

BodyInterior::Depth BodyInterior::depthOf(const Eigen::Vector3f& way, const Eigen::Vector3f& normal) const
{
  const float half = HalfDiagonal * this->CellSize;
  const float distance = way.norm(), along = way.dot(normal);
  const bool isShallow = distance < this->Least - half;
  const bool isOutside = distance > 2.0f * half && along < -StraightBelow * distance;
  const bool isInside = distance > this->Least + half && along > SurelyBelow * distance;
  return isShallow || isOutside ? NoneDeep : isInside ? AllDeep : SomeDeep;
}

bool BodyInterior::isDeep(const Eigen::Vector3f& point) const
{
  if (!this->Box.contains(point))
  {
    return false;
  }
  const Eigen::Array3i place = ((point - this->Box.min()).array() / this->CellSize).cast<int>().min(this->Size - 1);
  const std::uint8_t depth = this->Cells[(place.z() * this->Size.y() + place.y()) * this->Size.x() + place.x()];
  if (depth == AllDeep || depth == NoneDeep)
  {
    return depth == AllDeep;
  }
  const int sample = this->Samples.nearest(point, this->Deepest);
  if (sample < 0)
  {
    return false;
  }
  const Eigen::Vector3f way = this->Surface.points[sample] - point;
  const float distance = way.norm();
  return distance > this->Least && way.dot(this->Surface.normals[sample]) > StraightBelow * distance;
}
}
