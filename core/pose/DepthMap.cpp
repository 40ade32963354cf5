// SPDX-License-Identifier: BSD-3-Clause
#include "pose/DepthMap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr float Empty = std::numeric_limits<float>::infinity();
constexpr float LargestSide = 4096.0f; // cells; a wider scene gets coarser cells
constexpr double StrayShare = 0.001;   // of the points, at each end of each axis
}

DepthMap::DepthMap(const Points& surface, const Sensor& sensor, double cellSize)
  : Eye(sensor)
{
  const Eigen::Matrix3f frame = frameAround(sensor.direction);
  this->Axes.row(0) = frame.col(1);
  this->Axes.row(1) = frame.col(2);
  this->Axes.row(2) = frame.col(0);
  Points projected;
  projected.reserve(surface.size());
  double depthSum = 0.0;
  for (const auto& point : surface)
  {
    const Eigen::Vector3f p = this->project(point);
    if (p.allFinite() && (!sensor.perspective || p.z() > 0.0f))
    {
      projected.push_back(p);
      depthSum += p.z();
    }
  }
  if (projected.empty())
  {
    return;
  }
  // A perspective map lies at depth 1.
  float cell = static_cast<float>(sensor.perspective ? cellSize * projected.size() / depthSum : cellSize);
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
  this->Nearest.assign(static_cast<std::size_t>(this->Width) * this->Height, Empty);
  this->Farthest.assign(static_cast<std::size_t>(this->Width) * this->Height, -Empty);
  for (const auto& p : projected)
  {
    if (!box.contains(Eigen::Vector3f(p.x(), p.y(), box.min().z())))
    {
      continue;
    }
    const Eigen::Vector2i index = ((p.head<2>() - this->Low) * this->InverseCell).cast<int>();
    const int place = index.y() * this->Width + index.x();
    this->Nearest[place] = std::min(this->Nearest[place], p.z());
    this->Farthest[place] = std::max(this->Farthest[place], p.z());
  }
}

Eigen::Vector3f DepthMap::project(const Eigen::Vector3f& point) const
{
  Eigen::Vector3f p = this->Axes * (this->Eye.perspective ? (point - this->Eye.position).eval() : point);
  if (this->Eye.perspective)
  {
    p.head<2>() /= p.z();
  }
  return p;
}

DepthMap::Place DepthMap::placeOf(const Eigen::Vector3f& point) const
{
  const Eigen::Vector3f p = this->project(point);
  const Eigen::Array2f index = ((p.head<2>() - this->Low) * this->InverseCell).array().floor();
  if (!(index.x() >= 0.0f && index.y() >= 0.0f && index.x() < this->Width && index.y() < this->Height) ||
    (this->Eye.perspective && p.z() <= 0.0f))
  {
    return { -1, p.z() };
  }
  return { static_cast<int>(index.y()) * this->Width + static_cast<int>(index.x()), p.z() };
}

int DepthMap::occupiedCell(int cell) const
{
  if (cell < 0 || this->Nearest[cell] != Empty)
  {
    return cell;
  }
  // Between the samples of a surface some cells stay empty: the nearest surface around speaks for them.
  const int x = cell % this->Width;
  const int y = cell / this->Width;
  int best = -1;
  for (int v = std::max(0, y - 1); v <= std::min(this->Height - 1, y + 1); ++v)
  {
    for (int u = std::max(0, x - 1); u <= std::min(this->Width - 1, x + 1); ++u)
    {
      const int other = v * this->Width + u;
      if (this->Nearest[other] != Empty && (best < 0 || this->Nearest[other] < this->Nearest[best]))
      {
        best = other;
      }
    }
  }
  return best;
}

DepthMap::Relation DepthMap::relation(const Eigen::Vector3f& point, float tolerance) const
{
  Place place = this->placeOf(point);
  place.cell = this->occupiedCell(place.cell);
  if (place.cell < 0)
  {
    return Relation::NoSurface;
  }
  const float nearest = this->Nearest[place.cell];
  const float farthest = this->Farthest[place.cell];
  if (std::abs(place.depth - nearest) <= tolerance || std::abs(place.depth - farthest) <= tolerance)
  {
    return Relation::OnSurface;
  }
  return nearest < place.depth ? Relation::Hidden : Relation::InFront;
}
}
