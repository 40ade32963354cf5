// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointGrid.h"
#include "model/TrainedModel.h"

#include <atomic>
#include <vector>

namespace meam
{
/// Tells whether parts at two poses cut into each other: no two bodies are in the same place. Calls may run in
/// parallel.
class BodyOverlap
{
public:
  /// Keeps a reference to the model.
  explicit BodyOverlap(const TrainedModel& model);

  /// Whether a noticeable share of the surface of one of two copies lies deeper in the other than poses are off. A body
  /// that is too thin for that cuts nothing.
  bool cut(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;

private:
  /// Whether so much of the surface of a part lies so deep in this part, whose frame `T` takes it to.
  bool reachesInto(const Eigen::Isometry3f& T) const;
  /// Whether a point of the part's frame is deeper in the part than poses are off.
  bool isDeep(const Eigen::Vector3f& point) const;
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

  const TrainedModel& Model;
  PointGrid Surface;
  Eigen::AlignedBox3f Box;                       ///< around the part
  Eigen::Array3i Size;                           ///< cells of the box
  float Least, CellSize;                         ///< mm
  mutable std::vector<std::atomic<Depth>> Cells; ///< as far as they were asked for
};
}
