// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"
#include "scene/Sensor.h"

#include <array>
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
    InFront,  ///< the scene is behind it: the sensor saw past where it should be
    NoSurface ///< the sensor saw nothing there
  };

  enum class Detail
  {
    Surface,     ///< with normals, and gaps of one cell filled
    Measurements ///< neither, for what asks by what was measured at that very place: a third of the time less
  };

  /// `cellSize` is in mm, for a perspective sensor at the middle of the scene. Rows of cells run along the first axis,
  /// as seen by the sensor. The same for any number of threads.
  DepthMap(
    const Points& surface, const Sensor& sensor, double cellSize, int threads = 1, Detail detail = Detail::Surface);

  /// Side of a cell, mm: no point of the surface is farther from the mean of its cell, seen along the line of sight.
  double cellSize() const { return this->CellSize; }

  /// Distance between neighbouring measured points across the lines of sight at the middle of the scene, mm, by how
  /// many there are on the surface seen; 0 without any.
  double pitch() const { return this->Pitch; }

  /// `tolerance` in mm along the line of sight.
  Relation relation(const Eigen::Vector3f& point, float tolerance) const
  {
    const Place place = this->placeOf(point);
    return relationTo(place.cell < 0 ? nothing() : this->Cells[place.cell], place.depth, tolerance);
  }

  /// The same by what was measured at that very place: with the mean depth of the nearest layer, and without what gaps
  /// of one cell are taken for.
  Relation relationToMean(const Eigen::Vector3f& point, float tolerance) const
  {
    const Place place = this->placeOf(point);
    const Cell& cell = this->Cells[place.cell < 0 ? this->Cells.size() - 1 : place.cell];
    if (!(cell.nearest < NothingSeen) || cell.isGap)
    {
      return Relation::NoSurface;
    }
    const float behind = place.depth - this->Axes.row(2).dot(cell.mean - this->Eye);
    return std::abs(behind) <= tolerance ? Relation::OnSurface : behind > 0.0f ? Relation::Hidden : Relation::InFront;
  }

  /// How far what was measured at that very place lies behind a point, mm along the line of sight; NaN where nothing
  /// was.
  float behind(const Eigen::Vector3f& point) const
  {
    const Place place = this->placeOf(point);
    return place.cell >= 0 && this->isMeasured(place.cell) ? this->depthIn(place.cell) - place.depth
                                                           : std::numeric_limits<float>::quiet_NaN();
  }

  /// Whether a point, as the sensor sees it, is no more than `margin` mm outside of the rectangle about everything that
  /// was measured.
  bool covers(const Eigen::Vector3f& point, float margin) const
  {
    const Eigen::Array2f index = this->indexOf(this->project(point));
    const float cells = margin / static_cast<float>(this->CellSize);
    return (index >= -cells).all() && index.x() < this->Width + cells && index.y() < this->Height + cells;
  }

  /// Unit normal, towards the sensor, of the nearest layer at the line of sight through a point; zero where the sensor
  /// saw too little about it, and without detail.
  Eigen::Vector3f normalAt(const Eigen::Vector3f& point) const
  {
    const int place = this->placeOf(point).cell;
    return place < 0 || this->Normals.empty() ? Eigen::Vector3f(Eigen::Vector3f::Zero()) : this->Normals[place];
  }

  /// Of the map, with those in which nothing was measured.
  int cellCount() const { return this->Width * this->Height; }
  int columns() const { return this->Width; }
  int rows() const { return this->Height; }
  /// The cell at the line of sight through a point; -1 outside of the map.
  int cellAt(const Eigen::Vector3f& point) const { return this->placeOf(point).cell; }
  /// Those beside a cell in its row and its column, as far as there are any: -1.
  std::array<int, 4> neighboursOf(int cell) const
  {
    const int column = cell % this->Width, size = this->Width * this->Height;
    return { column > 0 ? cell - 1 : -1, column + 1 < this->Width ? cell + 1 : -1,
      cell >= this->Width ? cell - this->Width : -1, cell + this->Width < size ? cell + this->Width : -1 };
  }
  /// Whether something was measured in a cell.
  bool isMeasured(int cell) const { return this->Cells[cell].nearest < NothingSeen && !this->Cells[cell].isGap; }
  /// Of the nearest layer of a cell in which something was measured, as means() and normalAt() have them.
  const Eigen::Vector3f& meanIn(int cell) const { return this->Cells[cell].mean; }
  const Eigen::Vector3f& normalIn(int cell) const { return this->Normals[cell]; } ///< with the surface's detail
  /// mm, of the mean, along the line of sight.
  float depthIn(int cell) const { return this->Axes.row(2).dot(this->Cells[cell].mean - this->Eye); }

  /// Where points lie in the map.
  struct Places
  {
    int cells[SoABlock];     ///< cellCount(): outside of the map
    float depths[SoABlock];  ///< mm, along the line of sight
    float insides[SoABlock]; ///< how far inside its cell, 1 in the middle and 0 at the border
  };
  /// Of at most SoABlock points from `begin` on, which `toScene` takes to the scene.
  void findPlaces(
    const Eigen::Isometry3f& toScene, const SoAPoints& points, int begin, int count, Places& places) const;

  /// The relation of `count` points from `begin` on, which `toScene` takes to the scene, several at a time.
  void relations(const Eigen::Isometry3f& toScene, const SoAPoints& points, int begin, int count, float tolerance,
    Relation* relations) const;

  /// One point of the surface for each occupied cell: the mean of the nearest layer, which a sensor's noise moves less
  /// than single points.
  const Points& means() const { return this->Means; }

  /// The means along the lines of sight through points; where the sensor has a gap of one cell, that of the nearest
  /// layer beside it.
  struct Seen
  {
    float x[SoABlock], y[SoABlock], z[SoABlock];
    /// How far inside its cell a point lies, 1 in the middle and next to 0 at the border, where the mean changes, times
    /// the mean's weight; 0 where there is none.
    float inside[SoABlock];
  };
  /// For at most SoABlock points from `begin` on.
  void meansAt(const SoAPoints& points, int begin, int count, Seen& seen) const;

private:
  struct Cell
  {
    float nearest;
    float farthest;
    Eigen::Vector3f mean;
    float weight; ///< of the mean: [0, 1], less where all its points lie at the cell's border
    bool isGap;   ///< nothing was measured in it, but beside it
  };
  static Relation relationTo(const Cell& cell, float depth, float tolerance)
  {
    const bool isSeen = cell.nearest < NothingSeen;
    const bool isOn =
      isSeen & ((std::abs(depth - cell.nearest) <= tolerance) | (std::abs(depth - cell.farthest) <= tolerance));
    return isOn                   ? Relation::OnSurface
           : !isSeen              ? Relation::NoSurface
           : cell.nearest < depth ? Relation::Hidden
                                  : Relation::InFront;
  }
  struct Place
  {
    int cell;    ///< -1: outside the map
    float depth; ///< mm, along the line of sight
  };
  Eigen::Vector3f project(const Eigen::Vector3f& point) const
  {
    Eigen::Vector3f p = this->Axes * (point - this->Eye);
    if (this->IsPerspective)
    {
      p.head<2>() /= p.z();
    }
    return p;
  }
  /// In cells from the map's corner.
  Eigen::Array2f indexOf(const Eigen::Vector3f& projected) const
  {
    return (projected.head<2>() - this->Low) * this->InverseCell;
  }
  Place placeOf(const Eigen::Vector3f& point) const { return this->placeOfProjected(this->project(point)); }
  Place placeOfProjected(const Eigen::Vector3f& p) const
  {
    const Eigen::Array2f index = this->indexOf(p);
    const bool inside = index.x() >= 0.0f && index.y() >= 0.0f && index.x() < this->Width && index.y() < this->Height &&
                        !(this->IsPerspective && p.z() <= 0.0f);
    return { inside ? static_cast<int>(index.y()) * this->Width + static_cast<int>(index.x()) : -1, p.z() };
  }
  /// Points of a scan that follow each other, and the rows of the map that they come to.
  struct Run
  {
    int begin, end;
    float low, high; ///< across the lines of sight, along the map's columns
  };
  /// Sets depths and means of the cells in the rows from `firstRow` to before `lastRow`. Returns the means.
  Points fillRows(const Points& surface, const std::vector<Run>& runs, float layer, int firstRow, int lastRow);
  void fillGaps(float layer, int threads);
  /// `seen` tells of the nine cells about one, `stride` from row to row.
  void fillGap(int row, int column, const std::uint8_t* seen, std::size_t stride, float layer);
  /// Of the nearest layer of a cell by the means of the cells about it: see normalAt().
  Eigen::Vector3f normalOf(int place) const;
  Cell& cellIn(int row, int column) { return this->Cells[static_cast<std::size_t>(row) * this->Width + column]; }
  static constexpr float NothingSeen = std::numeric_limits<float>::max();
  static Cell nothing()
  {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return { infinity, -infinity, Eigen::Vector3f::Zero(), 0.0f, false };
  }

  bool IsPerspective;
  Eigen::Vector3f Eye;  ///< the sensor's position, or anywhere
  Eigen::Matrix3f Axes; ///< rows: right, down, depth
  double CellSize;
  double Pitch = 0.0;
  float InverseCell = 1.0f;
  Eigen::Vector2f Low = Eigen::Vector2f::Zero();
  int Width = 0;
  int Height = 0;
  std::vector<Cell> Cells{ nothing() }; ///< and at the end one where there is nothing
  Points Means;
  Points Normals; ///< of the cells, unit; zero where too little was seen; none of measurements alone
};
}
