// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/depth/DepthGrid.h"

namespace meam
{
/// What the sensor sees along each line of sight, from a cloud of any kind: a grid across the lines of sight, with the
/// nearest and the farthest surface in each cell.
class DepthMap : public DepthGrid
{
public:
  /// `cellSize` as of the grid. The same for any number of threads.
  DepthMap(const ScanProjection& scan, double cellSize, int threads = 1);
  /// Of points that no other map is made of.
  DepthMap(const Points& scan, const Sensor& sensor, double cellSize, int threads = 1)
    : DepthMap(ScanProjection(scan, sensor, threads), cellSize, threads)
  {
  }

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
    return cell.nearest < NothingSeen && !cell.isGap ? this->relationOf(place.depth, cell.mean, tolerance)
                                                     : Relation::NoSurface;
  }

  /// How far what was measured at that very place lies behind a point, mm along the line of sight; NaN where nothing
  /// was.
  float behind(const Eigen::Vector3f& point) const
  {
    const Place place = this->placeOf(point);
    return place.cell >= 0 && this->isMeasured(place.cell) ? this->depthIn(place.cell) - place.depth
                                                           : std::numeric_limits<float>::quiet_NaN();
  }

  /// Unit normal, towards the sensor, of the nearest layer at the line of sight through a point; zero where the sensor
  /// saw too little about it.
  Eigen::Vector3f normalAt(const Eigen::Vector3f& point) const
  {
    const int place = this->placeOf(point).cell;
    return place < 0 ? Eigen::Vector3f(Eigen::Vector3f::Zero()) : this->Normals[place];
  }

  /// Whether something was measured in a cell.
  bool isMeasured(int cell) const { return this->Cells[cell].nearest < NothingSeen && !this->Cells[cell].isGap; }
  /// Of the nearest layer of a cell in which something was measured, as means() and normalAt() have them.
  const Eigen::Vector3f& meanIn(int cell) const { return this->Cells[cell].mean; }
  const Eigen::Vector3f& normalIn(int cell) const { return this->Normals[cell]; }
  /// mm, of the mean, along the line of sight.
  float depthIn(int cell) const { return this->depthOf(this->Cells[cell].mean); }

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
  /// Sets depths and means of the cells in the rows from `firstRow` to before `lastRow`. Returns the means.
  Points fillRows(const ScanProjection& scan, int firstRow, int lastRow);
  void fillGaps(float layer, int threads);
  /// `seen` tells of the nine cells about one, `stride` from row to row.
  void fillGap(int row, int column, const std::uint8_t* seen, std::size_t stride, float layer);
  /// Of the nearest layer of a cell by the means of the cells about it: see normalAt().
  Eigen::Vector3f normalOf(int place) const;
  Cell& cellIn(int row, int column) { return this->Cells[static_cast<std::size_t>(row) * this->Width + column]; }
  static Cell nothing()
  {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return { infinity, -infinity, Eigen::Vector3f::Zero(), 0.0f, false };
  }

  double Pitch = 0.0;
  std::vector<Cell> Cells{ nothing() }; ///< and at the end one where there is nothing
  Points Means;
  Points Normals; ///< of the cells, unit; zero where too little was seen
};
}
