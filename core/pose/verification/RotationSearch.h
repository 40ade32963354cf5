// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"
#include "mesh/Symmetries.h"
#include "model/TrainedModel.h"
#include "scene/Scene.h"

namespace meam
{
/// Rotation search about the axes of a part's approximate symmetries. Its surface fits the scene at each of them, and
/// that of a nearly round part at any rotation about its axis, so refinement stays at the rotation it came with; the
/// scene's edges tell them apart. Calls may run in parallel.
class RotationSearch
{
public:
  /// Keeps references to both.
  RotationSearch(const Scene& scene, const TrainedModel& model);

  /// The pose turned about each such axis to where more of the scene's edges on the part are edges of the part than as
  /// it is: the better one first, as good as the steps of the search. None for a part without near-symmetries other
  /// than half turns.
  std::vector<Eigen::Isometry3d> better(const Eigen::Isometry3d& T_scene_model) const;

  /// The pose, or its turn by a near-symmetry if more of the scene's edges on the part are edges of the part then.
  Eigen::Isometry3d likeliest(const Eigen::Isometry3d& T_scene_model) const;

private:
  /// Of the scene's edges on the part some, in its frame.
  SoAPoints edgesOn(const Eigen::Isometry3d& T_scene_model) const;
  /// How many of these are edges of the part once it is turned, less for those beside.
  double explained(const SoAPoints& edges, const Eigen::Isometry3d& turn) const;

  const Scene& InScene;
  const TrainedModel& Model;
  float Unexplained; ///< mm
  std::vector<ContinuousSymmetry> Axes;
};
}
