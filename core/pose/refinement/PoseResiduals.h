// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/refinement/NormalEquations.h"
#include "scene/depth/DepthMap.h"

namespace meam
{
/// How the residuals of a surface weigh.
struct SurfaceWeights
{
  float limit;    ///< mm along the normal, where Tukey's weight comes to 0
  float farthest; ///< mm from a point to the mean at its line of sight; those farther weigh nothing
  /// The less the nearer a point is to where its mean changes, so that sums change steadily with the pose.
  bool fadesAtBorders;
};

/// Adds to `fit` what points of a part's surface, in the scene, are off the measured one along their normals.
template <typename Fit>
void addSurfaceResiduals(
  Fit& fit, const DepthMap& depth, const SoAOrientedPoints& surface, const SurfaceWeights& weights);

/// Adds to `fit` by what `offsets` (mm) points are off lines at right angles to the lines' directions: two residuals of
/// each.
template <typename Fit>
void addLineResiduals(
  Fit& fit, const SoAOrientedPoints& lines, const SoAPoints& offsets, const std::vector<float>& weights);
}
