// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"

#include <mutex>
#include <optional>

namespace meam
{
/// A part as a mirror shows it: where the right hand's part is looked for the left hand's may lie, or the axes of the
/// scan are left-handed.
struct MirroredPart
{
  TrainedModel model; ///< without what votes, and without distances
  /// How it may lie where the part is, as motions of the mirrored part: those first that leave the most of its surface
  /// where the part's is.
  std::vector<Eigen::Isometry3d> turns;
};

/// The mirrored part of a model, made when it is first asked for. Calls may run in parallel.
class MirrorImage
{
public:
  /// `model` is the one that holds this. Null where a part is its own mirror image, as far as poses tell, or where the
  /// mirrored part is so much unlike it that no pose of one fits the other.
  const MirroredPart* of(const TrainedModel& model) const;

private:
  mutable std::once_flag IsMade;
  mutable std::optional<MirroredPart> Mirrored;
};
}
