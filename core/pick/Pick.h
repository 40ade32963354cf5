// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace meam
{
/// Why a pick is not possible, in the order in which it is looked at.
enum class PickObstruction
{
  None,
  Uncertain,  ///< the pose is not likely enough
  Covered,    ///< something lies on the part
  WrongKind,  ///< the grasp is one of another kind of gripper
  TooWide,    ///< the part does not fit between the jaws
  Tilted,     ///< the gripper would come too slantwise, or from below
  PartItself, ///< the gripper collides with the part that it shall hold
  Bin,
  Instance, ///< another copy
  Measured  ///< something that was measured and is no known copy
};

/// One grasp of one copy.
struct Pick
{
  Eigen::Isometry3d T_scene_grasp = Eigen::Isometry3d::Identity(); ///< mm
  int pose = -1;                                                   ///< index of the copy among the poses
  int grasp = -1;                                                  ///< index among the grasps
  PickObstruction obstruction = PickObstruction::None;
  int obstacle = -1;      ///< index of the copy that is in the way, or -1
  double clearance = 0.0; ///< mm from all but the part, on the way in, up to what is comfortable
  double tilt = 0.0;      ///< degrees between the way in and straight down
  double reach = 0.0;     ///< mm from the bin's rim, or from the highest point measured, down to the grasp
  double covered = 0.0;   ///< [0, 1] of the part, from above
  double score = 0.0;     ///< [0, 1]: probability as it counts here, quality, share uncovered, share of the comfortable
                          ///< clearance, multiplied

  bool possible() const { return this->obstruction == PickObstruction::None; }
};

using Picks = std::vector<Pick>;

/// Why it is not possible, in words, poses counted from 1: "collides with instance 3".
std::string describe(const Pick& pick);
/// The same in a word or two, to stand in a picture: "pick 1" of one that is possible, by its rank.
std::string labelOf(const Pick& pick, int rank);

/// How many are possible, of how many copies, and of the other copies what keeps the gripper from them however it is
/// held, in a sentence.
std::string describe(const Picks& picks);
/// What to change for the copies that cannot be picked, a sentence for each reason; empty where all can.
std::string adviceOn(const Picks& picks);
}
