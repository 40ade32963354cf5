// SPDX-License-Identifier: BSD-3-Clause
#include "model/edges/Silhouette.h"

#include "base/Bounds.h"
#include "base/Frames.h"

#include <algorithm>
#include <array>
#include <utility>

namespace meam
{
namespace
{
constexpr double CellsPerSpacing = 2.0; // of the samples, at the part's middle
constexpr int SampleRadius = 3;         // cells; no gaps stay between samples
constexpr double Reach = 2.0;           // spacings from an edge point to where the background must show

/// The cells beside one.
std::array<Eigen::Vector2i, 4> beside(const Eigen::Vector2i& cell)
{
  return { cell + Eigen::Vector2i(1, 0), cell + Eigen::Vector2i(-1, 0), cell + Eigen::Vector2i(0, 1),
    cell + Eigen::Vector2i(0, -1) };
}
}

Silhouette::Silhouette(const Points& part, const Eigen::Vector3d& viewpoint, double spacing)
  : Viewpoint(viewpoint)
{
  constexpr double mostCells = 2000.0; // along a side, for an image of bounded size
  const Eigen::AlignedBox3f box = bounds(part);
  const Eigen::Vector3d depth = box.center().cast<double>() - viewpoint;
  this->Spacing = std::max(spacing, CellsPerSpacing * box.diagonal().norm() / mostCells);
  this->Axes = frameAround(depth.normalized().cast<float>()).cast<double>().transpose();
  this->CellsPerSlope = depth.norm() * CellsPerSpacing / this->Spacing;

  std::vector<Eigen::Vector2i> places;
  places.reserve(part.size());
  for (const auto& point : part)
  {
    if (point.allFinite())
    {
      places.push_back(this->cellOf(point.cast<double>()));
    }
  }
  const auto before = [](const Eigen::Vector2i& a, const Eigen::Vector2i& b)
  { return std::make_pair(a.x(), a.y()) < std::make_pair(b.x(), b.y()); };
  std::sort(places.begin(), places.end(), before);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  Eigen::Vector2i high = places.front();
  this->Low = places.front();
  for (const auto& place : places)
  {
    this->Low = this->Low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  // A margin that holds the samples' discs and a ring of background around them.
  this->Low.array() -= SampleRadius + 1;
  this->Size = high - this->Low + Eigen::Vector2i::Constant(SampleRadius + 2);
  this->Cells.assign(static_cast<std::size_t>(this->Size.x()) * this->Size.y(), Cell::Enclosed);
  for (const auto& place : places)
  {
    this->markDisc(place, Cell::Part);
  }
  // What the discs reach beyond the samples is taken back; the gaps between samples stay closed.
  std::vector<Eigen::Vector2i> rim;
  for (int y = 0; y < this->Size.y(); ++y)
  {
    for (int x = 0; x < this->Size.x(); ++x)
    {
      const Eigen::Vector2i cell = this->Low + Eigen::Vector2i(x, y);
      const std::array<Eigen::Vector2i, 4> around = beside(cell);
      const auto isPart = [&](const Eigen::Vector2i& other)
      { return this->isInside(other) && this->at(other) == Cell::Part; };
      if (this->at(cell) != Cell::Part && std::any_of(around.begin(), around.end(), isPart))
      {
        rim.push_back(cell);
      }
    }
  }
  for (const auto& cell : rim)
  {
    this->markDisc(cell, Cell::Enclosed);
  }
  this->markAround();
}

void Silhouette::markDisc(const Eigen::Vector2i& middle, Cell mark)
{
  const int radius = SampleRadius;
  for (int y = -radius; y <= radius; ++y)
  {
    for (int x = -radius; x <= radius; ++x)
    {
      const Eigen::Vector2i cell = middle + Eigen::Vector2i(x, y);
      if (x * x + y * y <= radius * radius && this->isInside(cell))
      {
        this->at(cell) = mark;
      }
    }
  }
}

/// Floods the background from a corner of the image; what it does not reach stays enclosed.
void Silhouette::markAround()
{
  std::vector<Eigen::Vector2i> open{ this->Low };
  this->at(this->Low) = Cell::Around;
  while (!open.empty())
  {
    const Eigen::Vector2i cell = open.back();
    open.pop_back();
    for (const Eigen::Vector2i& next : beside(cell))
    {
      if (this->isInside(next) && this->at(next) == Cell::Enclosed)
      {
        this->at(next) = Cell::Around;
        open.push_back(next);
      }
    }
  }
}

Silhouette::Cell Silhouette::beyond(const Eigen::Vector3d& point, const Eigen::Vector3d& outward) const
{
  const double cells = CellsPerSpacing;
  for (double step = 0.0; step <= Reach * cells; step += 1.0)
  {
    const Eigen::Vector2i cell = this->cellOf(point + step * this->Spacing / cells * outward);
    if (!this->isInside(cell))
    {
      return Cell::Around;
    }
    if (this->at(cell) != Cell::Part)
    {
      return this->at(cell);
    }
  }
  return Cell::Part;
}

Eigen::Vector2i Silhouette::cellOf(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d place = this->Axes * (point - this->Viewpoint);
  return (this->CellsPerSlope / place[0] * place.tail<2>()).array().floor().matrix().cast<int>();
}

bool Silhouette::isInside(const Eigen::Vector2i& cell) const
{
  return ((cell - this->Low).array() >= 0).all() && ((cell - this->Low).array() < this->Size.array()).all();
}

Silhouette::Cell& Silhouette::at(const Eigen::Vector2i& cell)
{
  const Eigen::Vector2i place = cell - this->Low;
  return this->Cells[static_cast<std::size_t>(place.y()) * this->Size.x() + place.x()];
}

Silhouette::Cell Silhouette::at(const Eigen::Vector2i& cell) const
{
  const Eigen::Vector2i place = cell - this->Low;
  return this->Cells[static_cast<std::size_t>(place.y()) * this->Size.x() + place.x()];
}
}
