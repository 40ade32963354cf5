// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace meam
{
/// Distances from a part's surface or from its edges on a grid about the part: one look-up for each point asked.
/// Between samples the surface is taken as flat and an edge as straight.
class DistanceField
{
public:
  DistanceField() = default;

  /// From the surface that samples with normals stand for. Lengths in mm: `reach` is the largest distance told,
  /// `spacing` that of the samples, `cellSize` the side of a cell.
  static DistanceField ofSurface(const PointCloud& samples, double spacing, double reach, double cellSize);
  /// From the edges that points with tangents stand for.
  static DistanceField ofEdges(const PointCloud& edges, double spacing, double reach, double cellSize);

  /// As files hold it.
  struct Stored
  {
    std::vector<float> frame;            ///< origin, middle, the inverse of a cell's side, radius, reach
    std::vector<std::int32_t> size;      ///< cells along x, y and z
    std::vector<std::uint8_t> distances; ///< in steps of a 255th of the reach: of the cells, and of all outside
  };
  Stored stored() const;
  /// None where the numbers do not fit each other.
  static std::optional<DistanceField> of(Stored stored);

  /// mm, `reach` for all that is farther.
  float at(const Eigen::Vector3f& point) const
  {
    const Eigen::Array3f cell = (point - this->Origin).array() * this->InverseCell;
    if (!((cell >= 0.0f).all() && (cell < this->Extent).all()))
    {
      return this->Reach;
    }
    const Eigen::Array3i index = cell.cast<int>();
    return this->Told[this->Distances[(index.z() * this->Size.y() + index.y()) * this->Size.x() + index.x()]];
  }

  /// The same of `count` points from `begin` on, which `toPart` takes to the part's frame, several at a time.
  void at(const Eigen::Isometry3f& toPart, const SoAPoints& points, int begin, int count, float* distances) const;

  /// A ball around all that the distances are from.
  const Eigen::Vector3f& middle() const { return this->Middle; }
  float radius() const { return this->Radius; }
  /// mm about `middle`: all points that are nearer than the reach lie in this ball.
  float outerRadius() const { return (0.5f * this->Extent.matrix().norm() + 1.0f) / this->InverseCell; }

private:
  static constexpr std::uint8_t Farthest = 255; ///< of what a cell stores: `reach` or more

  enum class Kind
  {
    Surface, ///< points with normals
    Edges    ///< points with tangents
  };
  DistanceField(
    const Points& points, const Points& directions, Kind kind, double spacing, double reach, double cellSize);

  /// Sets the largest distance told, and what the stored steps tell.
  void tellUpTo(float reach);

  Eigen::Vector3f Origin = Eigen::Vector3f::Zero();
  float InverseCell = 1.0f;
  Eigen::Array3i Size = Eigen::Array3i::Zero();
  Eigen::Array3f Extent = Eigen::Array3f::Zero(); ///< the size, to compare with
  Eigen::Vector3f Middle = Eigen::Vector3f::Zero();
  float Radius = 0.0f;
  float Reach = 0.0f;
  std::array<float, Farthest + 1> Told{};          ///< mm, for what is stored
  std::vector<std::uint8_t> Distances{ Farthest }; ///< of the cells, and of all outside
};
}
