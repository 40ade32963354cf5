// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"
#include "scene/depth/ScanProjection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meam
{
/// A grid of cells across a sensor's lines of sight that holds all that was measured.
class DepthGrid
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

  /// `cellSize` is in mm, for a perspective sensor at the middle of the scene. Rows of cells run along the first axis,
  /// as seen by the sensor.
  DepthGrid(const ScanProjection& scan, double cellSize);

  /// Side of a cell, mm: no point of the surface is farther from the mean of its cell, seen along the line of sight.
  double cellSize() const { return this->CellSize; }
  /// With those in which nothing was measured.
  int cellCount() const { return this->Width * this->Height; }
  int columns() const { return this->Width; }
  int rows() const { return this->Height; }
  /// The cell at the line of sight through a point; -1 outside of the grid.
  int cellAt(const Eigen::Vector3f& point) const { return this->placeOf(point).cell; }
  /// Those beside a cell in its row and its column, as far as there are any: -1.
  std::array<int, 4> neighboursOf(int cell) const
  {
    const int column = cell % this->Width, size = this->Width * this->Height;
    return { column > 0 ? cell - 1 : -1, column + 1 < this->Width ? cell + 1 : -1,
      cell >= this->Width ? cell - this->Width : -1, cell + this->Width < size ? cell + this->Width : -1 };
  }
  /// Whether a point, as the sensor sees it, is no more than `margin` mm outside of the rectangle about everything that
  /// was measured.
  bool covers(const Eigen::Vector3f& point, float margin) const
  {
    const Eigen::Array2f index = this->indexOf(this->project(point));
    const float cells = margin / static_cast<float>(this->CellSize);
    return (index >= -cells).all() && index.x() < this->Width + cells && index.y() < this->Height + cells;
  }

  /// Where points lie in the grid.
  struct Places
  {
    int cells[SoABlock];     ///< cellCount(): outside of the grid
    float depths[SoABlock];  ///< mm, along the line of sight
    float insides[SoABlock]; ///< how far inside its cell, 1 in the middle and 0 at the border
  };
  /// Of at most SoABlock points from `begin` on, which `toScene` takes to the scene.
  void findPlaces(
    const Eigen::Isometry3f& toScene, const SoAPoints& points, int begin, int count, Places& places) const;

protected:
  struct Place
  {
    int cell;    ///< -1: outside the grid
    float depth; ///< mm, along the line of sight
  };
  Place placeOf(const Eigen::Vector3f& point) const
  {
    const Eigen::Vector3f p = this->project(point);
    const Eigen::Array2f index = this->indexOf(p);
    const bool inside = index.x() >= 0.0f && index.y() >= 0.0f && index.x() < this->Width && index.y() < this->Height &&
                        !(this->IsPerspective && p.z() <= 0.0f);
    return { inside ? static_cast<int>(index.y()) * this->Width + static_cast<int>(index.x()) : -1, p.z() };
  }
  /// Of a point of the scan, mm, along the line of sight.
  float depthOf(const Eigen::Vector3f& point) const { return this->Axes.row(2).dot(point - this->Eye); }
  /// Of a point at some depth to one that was measured there.
  Relation relationOf(float depth, const Eigen::Vector3f& measured, float tolerance) const
  {
    const float behind = depth - this->depthOf(measured);
    return std::abs(behind) <= tolerance ? Relation::OnSurface : behind > 0.0f ? Relation::Hidden : Relation::InFront;
  }

  /// Cells of a rectangle, from its first column and row to before its last ones.
  struct Rectangle
  {
    int left = 0, top = 0, right = 0, bottom = 0;
    int width() const { return this->right - this->left; }
    int size() const { return std::max(this->width(), 0) * std::max(this->bottom - this->top, 0); }
  };
  /// What was measured in the cells of a rectangle.
  struct Layers
  {
    std::vector<float> nearest, farthest;  ///< mm, along the lines of sight; the greatest number, and its negative,
                                           ///< where nothing was
    std::vector<Eigen::Vector4d> weighted; ///< of the points of the nearest layer the sum, and that of their weights,
                                           ///< which are less at a cell's border
    Eigen::Vector3f mean(int cell) const
    {
      return (this->weighted[cell].head<3>() / this->weighted[cell].w()).cast<float>();
    }
  };
  static constexpr float NothingSeen = std::numeric_limits<float>::max();
  /// By the runs of the scan that come to the cells: the points are summed up in their order.
  Layers layersIn(const Rectangle& cells, const ScanProjection& scan, const std::vector<int>& runs) const;
  /// Those that a run may come to; none of a run of which nothing is seen in the grid.
  Rectangle cellsOf(const ScanProjection::Run& run) const;
  /// mm, depth of the nearest layer.
  float layer() const;

  bool IsPerspective;
  Eigen::Vector3f Eye;
  Eigen::Matrix3f Axes;
  double CellSize;
  float InverseCell = 1.0f;
  Eigen::Array2f Low = Eigen::Array2f::Zero();
  int Width = 0;
  int Height = 0;

private:
  Eigen::Vector3f project(const Eigen::Vector3f& point) const
  {
    Eigen::Vector3f p = this->Axes * (point - this->Eye);
    if (this->IsPerspective)
    {
      p.head<2>() /= p.z();
    }
    return p;
  }
  /// In cells from the grid's corner.
  Eigen::Array2f indexOf(const Eigen::Vector3f& projected) const
  {
    return (projected.head<2>().array() - this->Low) * this->InverseCell;
  }
};
}
