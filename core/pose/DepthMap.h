// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/Sensor.h"

namespace meam
{
/// What the sensor sees along each line of sight, from a cloud of any kind: the nearest and the
/// farthest surface point in each cell of a grid across the lines of sight.
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

  /// `cellSize` is in mm, for a perspective sensor at the middle of the scene.
  DepthMap(const Points& surface, const Sensor& sensor, double cellSize);

  /// `tolerance` in mm along the line of sight.
  Relation relation(const Eigen::Vector3f& point, float tolerance) const;

private:
  /// Cell of a point and its depth (mm) along the line of sight; cell -1 outside the map.
  struct Place
  {
    int cell;
    float depth;
  };
  Place placeOf(const Eigen::Vector3f& point) const;
  Eigen::Vector3f project(const Eigen::Vector3f& point) const;
  /// The cell itself, or of its neighbours the one with the nearest surface, or -1.
  int occupiedCell(int cell) const;

  Sensor Eye;
  Eigen::Matrix3f Axes; ///< rows: right, down, depth
  float InverseCell = 1.0f;
  Eigen::Vector2f Low = Eigen::Vector2f::Zero();
  int Width = 0;
  int Height = 0;
  std::vector<float> Nearest;
  std::vector<float> Farthest;
};
}
