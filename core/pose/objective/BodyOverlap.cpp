// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/BodyOverlap.h"

#include "base/Bounds.h"
#include "pose/PoseTolerances.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr double Cell = 0.01;         // of the diameter, side of a cell; most cells tell of all their points
constexpr float HalfDiagonal = 0.87f; // of a cell, in sides
constexpr double Deepest = 0.1;       // of the diameter, of what is looked at: its neighbours are less deep
constexpr double LeastShare = 0.05;   // of the surface that lies inside; less may be where the part is bent
constexpr float SurelyBelow = 0.95f;  // the same, for all points of a cell
constexpr float StraightBelow = 0.7f; // cosine, way to the nearest sample against its normal: else beside an edge
}

BodyOverlap::BodyOverlap(const TrainedModel& model)
  : Model(model)
  , Surface(model.surface.points, Deepest * model.diameter)
  , Box(bounds(model.surface.points))
  , Size(0, 0, 0)
  , Least(static_cast<float>(FitDistance * model.diameter))
  , CellSize(static_cast<float>(Cell * model.diameter))
{
  if (!this->Box.isEmpty())
  {
    this->Size = (this->Box.sizes().array() / this->CellSize).cast<int>() + 1;
  }
  this->Cells = std::vector<std::atomic<Depth>>(static_cast<std::size_t>(this->Size.prod()));
}

bool BodyOverlap::nearest(const Eigen::Vector3f& point, Eigen::Vector3f& way, Eigen::Vector3f& normal) const
{
  const int sample = this->Surface.nearest(point, Deepest * this->Model.diameter);
  if (sample < 0)
  {
    return false;
  }
  way = this->Model.surface.points[sample] - point;
  normal = this->Model.surface.normals[sample];
  return true;
}

BodyOverlap::Depth BodyOverlap::depthOf(const Eigen::Vector3f& middle) const
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

bool BodyOverlap::isDeep(const Eigen::Vector3f& point) const
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

bool BodyOverlap::reachesInto(const Eigen::Isometry3f& T) const
{
  const std::vector<int>& points = this->Model.verificationPoints;
  const auto count =
    std::count_if(points.begin(), points.end(), [&](int i) { return this->isDeep(T * this->Model.surface.points[i]); });
  return count > 0 && static_cast<double>(count) >= LeastShare * static_cast<double>(points.size());
}

bool BodyOverlap::cut(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
{
  const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
  if ((a * middle - b * middle).norm() > this->Model.diameter)
  {
    return false;
  }
  const Eigen::Isometry3f T = (b.inverse() * a).cast<float>();
  return this->reachesInto(T) || this->reachesInto(T.inverse());
}
}
