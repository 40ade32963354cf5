// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/SceneIndex.h"

namespace meam
{
/// Looks for a better turn of a nearly round part. Its surface fits the scene at any turn about the axis of its
/// near-symmetries, so refinement stays at the turn it came with; the scene's edges know better. Calls may run in
/// parallel.
class TurnSearch
{
public:
  /// Keeps a reference to the index.
  explicit TurnSearch(const SceneIndex& index);

  /// The pose turned about each such axis to where more of the scene's edges on the part are edges of the part than as
  /// it is: at most two for an axis, the better one first, as good as the steps of the search. None for a part
  /// without near-symmetries other than half turns.
  std::vector<Eigen::Isometry3d> better(const Eigen::Isometry3d& T_scene_model) const;

private:
  const SceneIndex& Index;
  std::vector<ContinuousSymmetry> Axes;
};
}
