// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "base/PointGrid.h"

#include <atomic>
#include <vector>

namespace meam
{
/// Tells which points lie deep in a part. What it has found out of a place it keeps, for all scans. Calls may run in
/// parallel.
class BodyInterior
{
public:
  /// `surface`: samples of the part with normals. `depth`: mm, from which on a point is deep.
  BodyInterior(const PointCloud& surface, double diameter, double depth);

  /// Whether a point of the part's frame is deeper in the part.
  bool isDeep(const Eigen::Vector3f& point) const;
  /// Around the part, in its frame.
  const Eigen::AlignedBox3f& box() const { return this->Box; }

private:
  /// From a point to the nearest sample, and its normal; false where none is near.
  bool nearest(const Eigen::Vector3f& point, Eigen::Vector3f& way, Eigen::Vector3f& normal) const;

  /// Of the points of a cell.
  enum Depth : unsigned char
  {
    Unknown,
    AllDeep,
    NoneDeep,
    SomeDeep ///< perhaps
  };
  Depth depthOf(const Eigen::Vector3f& middle) const;

  PointCloud Surface;
  PointGrid Samples;
  Eigen::AlignedBox3f Box;                       ///< around the part
  Eigen::Array3i Size;                           ///< cells of the box
  float Deepest, Least, CellSize;                ///< mm
  mutable std::vector<std::atomic<Depth>> Cells; ///< as far as they were asked for
};
}
