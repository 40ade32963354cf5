// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/verification/PoseEvidence.h"

namespace meam
{
/// What the scan shows of the part at a pose: the points that verification looks at, and how many are there.
struct PlaceEvidence
{
  PoseEvidence points; ///< of the predicted points, local frame
  // Of the edge points that nothing hides:
  int edges = 0;        ///< how many there are
  int edgesNear = 0;    ///< with a scene edge near, whichever way it runs
  int edgesMatched = 0; ///< with one near that runs their way, as verification counts
  int edgesAligned = 0; ///< with one near whose tangent is within 10 degrees
  double behind = 0.0;  ///< share of the part's whole surface behind the bin's floor or a wall, [0, 1]

  /// How many of the surface points are in a state.
  int surface(PointState state) const;
  /// The share of the edge points with a scene edge near that runs their way, [0, 1]; 0 without any.
  double edgeShare() const;
  /// The share of the surface points, of those that nothing hides, that are in a state, [0, 1]; 0 without any.
  double surfaceShare(PointState state) const;
};

PlaceEvidence evidenceAt(const Eigen::Isometry3d& T_scene_model, const Scene& scene, const TrainedModel& model,
  const EvidenceSettings& settings);
}
