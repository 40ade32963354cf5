// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Symmetries.h"
#include "pick/Gripper.h"
#include "pick/Pick.h"
#include "pick/PickCollisions.h"
#include "pick/PickSettings.h"
#include "pick/planning/PartSurface.h"
#include "pick/planning/PickSurroundings.h"

#include <optional>
#include <vector>

namespace meam
{
/// Degrees between a gripper's way in and straight down.
double tiltOf(const Eigen::Isometry3d& T_scene_grasp, const Eigen::Vector3d& up);

/// A part, its grasps and a gripper, and at which turns of a grasp it takes a copy.
class GraspSearch
{
public:
  /// Throws Error for an invalid mesh, gripper or grasp, for one outside the part, and without a grasp.
  GraspSearch(const TriangleMesh& part, const Symmetries& symmetries, const Grasps& grasps, const Gripper& gripper,
    const PlanSettings& settings);

  const Gripper& gripper() const { return this->Claw; }
  const PlanSettings& settings() const { return this->Settings; }
  const Grasps& grasps() const { return this->Given; }
  const PartSurface& surface() const { return this->Surface; }
  double partSize() const { return this->Box.diagonal().norm(); } ///< mm, the diagonal of its box

  /// Whether the grasp may fail where the part is turned by one of its near-symmetries, or the settings want all to
  /// count the rotation.
  bool needsRotation(std::size_t grasp) const { return this->NeedsRotation[grasp]; }

  /// What is in the way from now on; `ofPoses`: of each pose the search of its part.
  void setObstacles(const Poses& poses, const std::vector<const GraspSearch*>& ofPoses, const std::optional<Bin>& bin,
    const PickSurroundings& around);

  /// The best turn of a grasp of a copy; where none is possible the one that comes farthest.
  Pick pickAt(const Pose& pose, int copy, int grasp, const PickSurroundings& around) const;

private:
  bool fits(const Grasp& grasp) const { return this->Claw.kind == grasp.kind && !this->tooWide(grasp); }
  bool tooWide(const Grasp& grasp) const;
  /// Whether what the gripper touches is the part's surface as well at each of its near-symmetries.
  bool holdsAnyRotation(const Grasp& grasp, const Symmetries& symmetries) const;
  /// mm, between the places at which a gripper's mesh is looked at on its way.
  double step() const;

  Gripper Claw;
  PlanSettings Settings;
  Grasps Given;
  Eigen::AlignedBox3d Box; ///< of the mesh, mm
  PickCollisions Collisions;
  PartSurface Surface;
  std::vector<std::vector<Eigen::Isometry3d>> Frames; ///< T_model_grasp of each grasp at all its turns
  std::vector<bool> NeedsRotation;                    ///< of each
  std::vector<std::vector<bool>> Touching;            ///< of each, whether the gripper touches the part that it holds
};
}
