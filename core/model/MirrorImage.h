// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"

#include <mutex>
#include <optional>

namespace meam
{
/// The plane at which a part is mirrored, and what of the mirrored part is told apart.
struct Mirroring
{
  Eigen::Vector3f at = Eigen::Vector3f::Zero(), normal = Eigen::Vector3f::UnitZ();
  /// How the mirrored part may lie where the part is, as its motions: those first that leave the most of its surface
  /// where the part's is. None where a part is its own mirror image, as far as poses tell, or where the mirrored part
  /// is so much unlike it that no pose of one fits the other.
  std::vector<Eigen::Isometry3d> turns;
};

/// A part as a mirror shows it: where the right hand's part is looked for the left hand's may lie, or the axes of the
/// scan are left-handed.
struct MirroredPart
{
  TrainedModel model;                   ///< without what votes, and without distances
  std::vector<Eigen::Isometry3d> turns; ///< Mirroring::turns
};

/// The mirrored part of a model, made when it is first asked for. Calls may run in parallel.
class MirrorImage
{
public:
  MirrorImage() = default;
  /// Of a model of which it is known.
  explicit MirrorImage(Mirroring known);

  /// `model` is the one that holds this. Null where there are no turns.
  const MirroredPart* of(const TrainedModel& model) const;
  /// How it is mirrored.
  const Mirroring& mirroring(const TrainedModel& model) const;

private:
  mutable std::once_flag IsFound;
  mutable Mirroring Found;
  mutable std::once_flag IsMade;
  mutable std::optional<MirroredPart> Mirrored;
};
}
