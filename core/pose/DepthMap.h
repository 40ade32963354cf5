// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PointColumns.h"
#include "scene/Sensor.h"

#include <cstdint>
#include <limits>

namespace meam
{
/// What the sensor sees along each line of sight, from a cloud of any kind: a grid across the lines of sight, with the
/// nearest and the farthest surface in each cell.
class DepthMap
{
public:
  /// How a point lies to the surface the sensor saw there.
  enum class Relation
  {
    OnSurface,
    Hidden,   ///< the scene is in front of it
    InFront,  ///< the scene is behind it: the sensor looked through where it should be
    NoSurface ///< the sensor saw nothing there
  };

  /// `cellSize` is in mm, for a perspective sensor at the middle of the scene. Rows of cells run along the direction
  /// `along`, as seen by the sensor: one that moves with the scene lets the cells move with it. The same for any number
  /// of threads.
  DepthMap(const Points& surface, const Sensor& sensor, double cellSize,
    const Eigen::Vector3f& along = Eigen::Vector3f::UnitX(), int threads = 1);

  /// Side of a cell, mm: no point of the surface is farther from the mean of its cell, seen along the line of sight.
  double cellSize() const { return this->CellSize; }

  /// `tolerance` in mm along the line of sight.
  Relation relation(const Eigen::Vector3f& point, float tolerance) const
  {
    const Place place = this->placeOf(point);
    return relationTo(place.cell < 0 ? Nothing : this->Cells[place.cell], place.depth, tolerance);
  }

  /// The same of `count` points from `begin` on, which `toScene` takes to the scene, several at a time.
  void relations(const Eigen::Isometry3f& toScene, const PointColumns& points, int begin, int count, float tolerance,
    Relation* relations) const;

  /// One point of the surface for each occupied cell: the mean of the nearest layer, which a sensor's noise moves less
  /// than single points.
  const Points& means() const { return this->Means; }

  /// The mean along the line of sight through a point; where the sensor has a gap of one cell, that of the nearest
  /// layer beside it. Null when there is none.
  const Eigen::Vector3f* meanAt(const Eigen::Vector3f& point) const
  {
    const Cell* cell = this->cellOf(this->placeOf(point));
    return cell ? &cell->mean : nullptr;
  }

  /// The same; `inside` tells how far inside its cell the point lies: 1 in the middle, 0 at the border, where the mean
  /// changes. It means nothing where there is none.
  const Eigen::Vector3f* meanAt(const Eigen::Vector3f& point, float& inside) const
  {
    const Place place = this->placeOf(point);
    const Eigen::Array2f off = 2.0f * (place.index - place.index.floor()) - 1.0f; // from the middle
    inside = (1.0f - off.square()).prod();
    const Cell* cell = this->cellOf(place);
    return cell ? &cell->mean : nullptr;
  }

  static constexpr int Block = 256; ///< points that are looked up together
  struct Seen
  {
    float x[Block], y[Block], z[Block]; ///< of the means
    float inside[Block];                ///< 0 where there is none
  };
  /// meanAt() of at most `Block` points from `begin` on.
  void meansAt(const PointColumns& points, int begin, int count, Seen& seen) const;

private:
  struct Cell
  {
    float nearest;
    float farthest;
    Eigen::Vector3f mean;
  };
  static Relation relationTo(const Cell& cell, float depth, float tolerance)
  {
    const bool isOn = (std::abs(depth - cell.nearest) <= tolerance) | (std::abs(depth - cell.farthest) <= tolerance);
    return isOn                           ? Relation::OnSurface
      : !(cell.nearest < NothingSeen)     ? Relation::NoSurface
      : cell.nearest < depth              ? Relation::Hidden
                                          : Relation::InFront;
  }
  struct Place
  {
    int cell;             ///< -1: outside the map
    float depth;          ///< mm, along the line of sight
    Eigen::Array2f index; ///< across it, cells
  };
  Eigen::Vector3f project(const Eigen::Vector3f& point) const
  {
    Eigen::Vector3f p = this->Axes * (this->Eye.perspective ? (point - this->Eye.position).eval() : point);
    if (this->Eye.perspective)
    {
      p.head<2>() /= p.z();
    }
    return p;
  }
  Place placeOf(const Eigen::Vector3f& point) const { return this->placeOfProjected(this->project(point)); }
  Place placeOfProjected(const Eigen::Vector3f& p) const
  {
    const Eigen::Array2f index = (p.head<2>() - this->Low) * this->InverseCell;
    const bool inside = index.x() >= 0.0f && index.y() >= 0.0f && index.x() < this->Width && index.y() < this->Height &&
      !(this->Eye.perspective && p.z() <= 0.0f);
    return { inside ? static_cast<int>(index.y()) * this->Width + static_cast<int>(index.x()) : -1, p.z(),
      index };
  }
  struct Places
  {
    int cells[Block]; ///< the last one: outside the map
    float depths[Block];
    float insides[Block];
  };
  void findPlaces(
    const Eigen::Isometry3f& toScene, const PointColumns& points, int begin, int count, Places& places) const;
  void average(const Points& surface, const Points& projected, const std::vector<int>& cellOf, float layer);
  void fillGaps(float layer, int threads);
  /// `seen` tells of the nine cells about one, `stride` from row to row.
  void fillGap(int row, int column, const std::uint8_t* seen, std::size_t stride, float layer);
  Cell& cellIn(int row, int column) { return this->Cells[static_cast<std::size_t>(row) * this->Width + column]; }
  /// Null outside the map and where nothing was seen.
  const Cell* cellOf(const Place& place) const
  {
    const bool seen = place.cell >= 0 && this->Cells[place.cell].nearest < NothingSeen;
    return seen ? &this->Cells[place.cell] : nullptr;
  }
  static constexpr float NothingSeen = std::numeric_limits<float>::max();
  static const Cell Nothing;

  Sensor Eye;
  Eigen::Matrix3f Axes; ///< rows: right, down, depth
  double CellSize;
  float InverseCell = 1.0f;
  Eigen::Vector2f Low = Eigen::Vector2f::Zero();
  int Width = 0;
  int Height = 0;
  std::vector<Cell> Cells{ Nothing }; ///< and at the end one where there is nothing
  Points Means;
};
}
