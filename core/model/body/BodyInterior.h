// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "base/PointGrid.h"

#include <cstdint>
#include <vector>

namespace meam
{
/// Tells which points lie deep in a part.
class BodyInterior
{
public:
  /// `surface`: samples of the part with normals. `depth`: mm, from which on a point is deep. `cells`: of another of
  /// the same part; they are made anew where there are not as many.
  BodyInterior(const PointCloud& surface, double diameter, double depth, std::vector<std::uint8_t> cells = {});

  /// Whether a point of the part's frame is deeper in the part.
  bool isDeep(const Eigen::Vector3f& point) const;
  /// Around the part, in its frame.
  const Eigen::AlignedBox3f& box() const { return this->Box; }
  /// What is known of the points of each cell of the box, along x, then y, then z.
  const std::vector<std::uint8_t>& cells() const { return this->Cells; }

private:
  /// Of the points of a cell.
  enum Depth : std::uint8_t
  {
    AllDeep,
    NoneDeep,
    SomeDeep ///< perhaps
  };
  /// From the middle of a cell, the way to the nearest sample and its normal.
  Depth depthOf(const Eigen::Vector3f& way, const Eigen::Vector3f& normal) const;
  std::vector<std::uint8_t> depths() const;

  PointCloud Surface;
  PointGrid Samples;
  Eigen::AlignedBox3f Box;        ///< around the part
  Eigen::Array3i Size;            ///< cells of the box
  float Deepest, Least, CellSize; ///< mm
  std::vector<std::uint8_t> Cells;
};
}
