// SPDX-License-Identifier: BSD-3-Clause
#include "model/body/BodyInterior.h"

#include "base/Bounds.h"

namespace meam
{
namespace
{
constexpr double Cell = 0.01;         // of the diameter, side of a cell; most cells tell of all their points
constexpr float HalfDiagonal = 0.87f; // of a cell, in sides
constexpr double MostLooked = 0.1;    // of the diameter: nothing that is deeper is near a sample
constexpr float SurelyBelow = 0.95f;  // cosine, way to the nearest sample against its normal: all points of a cell;
constexpr float StraightBelow = 0.7f; // of less a point lies beside an edge
}

BodyInterior::BodyInterior(const PointCloud& surface, double diameter, double depth)
  : Surface(surface)
  , Samples(surface.points, MostLooked * diameter)
  , Box(bounds(surface.points))
  , Size(0, 0, 0)
  , Deepest(static_cast<float>(MostLooked * diameter))
  , Least(static_cast<float>(depth))
  , CellSize(static_cast<float>(Cell * diameter))
{
  if (!this->Box.isEmpty())
  {
    this->Size = (this->Box.sizes().array() / this->CellSize).cast<int>() + 1;
  }
  this->Cells = std::vector<std::atomic<Depth>>(static_cast<std::size_t>(this->Size.prod()));
}

bool BodyInterior::nearest(const Eigen::Vector3f& point, Eigen::Vector3f& way, Eigen::Vector3f& normal) const
{
  const int sample = this->Samples.nearest(point, this->Deepest);
  if (sample < 0)
  {
    return false;
  }
  way = this->Surface.points[sample] - point;
  normal = this->Surface.normals[sample];
  return true;
}

BodyInterior::Depth BodyInterior::depthOf(const Eigen::Vector3f& middle) const
{
  const float half = HalfDiagonal * this->CellSize;
  Eigen::Vector3f way, normal;
  if (!this->nearest(middle, way, normal))
  {
    return SomeDeep;
  }
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
  std::atomic<Depth>& cell = this->Cells[(place.z() * this->Size.y() + place.y()) * this->Size.x() + place.x()];
  Depth depth = cell.load(std::memory_order_relaxed);
  if (depth == Unknown) // the same whichever thread finds it out
  {
    depth = this->depthOf(this->Box.min() + this->CellSize * (place.cast<float>() + 0.5f).matrix());
    cell.store(depth, std::memory_order_relaxed);
  }
  if (depth != SomeDeep)
  {
    return depth == AllDeep;
  }
  Eigen::Vector3f way, normal;
  const bool isNear = this->nearest(point, way, normal);
  const float distance = isNear ? way.norm() : 0.0f;
  return distance > this->Least && way.dot(normal) > StraightBelow * distance;
}
}
