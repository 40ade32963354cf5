// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pick/Bin.h"
#include "pick/Gripper.h"

#include <string>
#include <vector>

namespace meam
{
/// What comes of a pick.
enum class TrialOutcome
{
  Success,
  HitsBin,
  HitsOther,   ///< another copy, or takes hold of two
  HitsPart,    ///< the open gripper comes down on the part that it shall take: the pose was wrong
  HoldsNothing ///< no copy is between the jaws or at the cup
};

struct PickTrial
{
  TrialOutcome outcome = TrialOutcome::HoldsNothing;
  int instance = -1; ///< index of the true copy that is held, or -1
};

struct PickTrialSettings
{
  double wayIn = 80.0;   ///< mm of the gripper's way that are looked at
  double cupSlack = 2.0; ///< mm that a cup gives way, and that it may be off the surface
};

/// Plays picks, grasps whose frames are the scene's (T_scene_grasp, mm), each for itself, among copies whose true poses
/// are known: whether the gripper on its way touches the bin, or any copy before it holds one. Throws Error for an
/// invalid mesh, gripper, bin or setting.
std::vector<PickTrial> tryPicks(const TriangleMesh& part, const Gripper& gripper, const Grasps& picks,
  const std::vector<Eigen::Isometry3d>& truths, const Bin* bin, const PickTrialSettings& settings = {},
  const Progress& progress = {});

/// In words: "hits another part".
std::string describe(TrialOutcome outcome);
}
