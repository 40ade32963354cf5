// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry.h"

namespace meam
{
/// A copy of the part in the scene: where it is and what speaks for it.
struct Pose
{
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity(); ///< mm
  double score = 0.0;           ///< [0, 1]; 0 until the pose is verified
  /// [0, 1], how sure it is that the part is not turned by one of its near-symmetries: low when what breaks them is
  /// not in sight.
  double certainty = 1.0;
  int votes = 0;                ///< of the peak it came from
  int viewId = -1;              ///< the appearance model that shows what the sensor sees of it
  double visibleFraction = 0.0; ///< [0, 1], share of the part's side towards the sensor that nothing hides
};

using Poses = std::vector<Pose>;

/// Rotation between two poses, degrees.
double rotationError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);
/// Distance between the origins of two poses, mm.
double translationError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);
}
