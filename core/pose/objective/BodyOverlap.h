// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointGrid.h"
#include "model/TrainedModel.h"

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
  /// Of the surface of a part the share that lies so deep in this part, whose frame `T` takes it to.
  double shareInside(const Eigen::Isometry3f& T) const;

  const TrainedModel& Model;
  PointGrid Surface;
};
}
