// SPDX-License-Identifier: BSD-3-Clause
/// What planning picks is told of a part, a gripper and a bin: plain structs.
#pragma once

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace meam
{
/// What holds the part.
enum class GraspKind
{
  Parallel, ///< two jaws that close on it
  Suction   ///< a cup that sits on it
};

/// The axis of the grasp's frame about which the gripper may be turned by any angle and grasps as well.
enum class FreeTurn
{
  None,
  Approach, ///< z: a cup on a flat spot, jaws on a sphere
  Closing   ///< x: jaws on the two faces of a disc
};

/// Where a gripper holds the part, in the CAD's coordinates. The frame's origin lies between the tips of the jaws, or
/// in the middle of the cup's rim, when the part is held; z is the way in; along x the jaws close.
struct Grasp
{
  std::string name;
  GraspKind kind = GraspKind::Parallel;
  Eigen::Isometry3d T_model_grasp = Eigen::Isometry3d::Identity(); ///< mm
  double width = 0.0;                                              ///< mm, of the part between the jaws; 0 for a cup
  FreeTurn freeTurn = FreeTurn::None;
  double quality = 1.0; ///< [0, 1], how well it holds, as whoever made it thinks
};

using Grasps = std::vector<Grasp>;

/// A gripper by a few lengths, mm. In the grasp's frame it comes along z, and its jaws close along x.
struct GripperLengths
{
  GraspKind kind = GraspKind::Parallel;

  double opening = 60.0;        ///< between the jaws, at most
  double jawClearance = 3.0;    ///< on either side of the part, between it and a jaw on its way in
  double fingerWidth = 12.0;    ///< of a jaw, along y
  double fingerThickness = 8.0; ///< of a jaw, along x
  double fingerLength = 50.0;   ///< from the body to the tips
  double tipLength = 6.0;       ///< the tips reach so much farther than the grasp's origin
  double bodyLength = 100.0;    ///< behind the fingers, or behind the cup
  double bodyWidth = 60.0;      ///< across: of a gripper with jaws along y; of one with a cup its diameter
  double cupDiameter = 20.0;
  double cupLength = 30.0; ///< from the body to the rim
};

/// An open box that parts lie in. Its frame has its origin in the middle of the floor and z up.
struct Bin
{
  Eigen::Isometry3d T_scene_bin = Eigen::Isometry3d::Identity(); ///< mm
  Eigen::Vector3d size = Eigen::Vector3d::Zero();                ///< mm, inside: along x, along y, height of the walls
  double wall = 5.0;                                             ///< mm, thickness of the walls and the floor
};

/// What a user chooses of planning picks.
struct PlanSettings
{
  double safetyMargin = 2.0; ///< mm that the gripper keeps from all but the part that it takes
  double wayIn = 80.0;       ///< mm, straight along the grasp's z, that have to be free
  /// [0, 1], of what is picked, that a copy is there, however it is turned by the part's near-symmetries; where the
  /// gripper would not find the part's surface at each of them, that the pose is right. Less likely copies do not stand
  /// in the way; one of unknown probability and score (0) is certain.
  double minimumProbability = 0.5;
  bool rotationCounts = false;  ///< that of each pick is the pose's, its rotation included
  double maximumTilt = 60.0;    ///< degrees between the way in and straight down
  double maximumCovered = 20.0; ///< % of the part, from above, that may lie under something
  double turnStep = 30.0;       ///< degrees between the turns that free and symmetric grasps are tried at
  /// mm: measured points so near to a copy or to the bin are of it; 0: 3 times the noise and 1 % of the part's size,
  /// its box from corner to corner; at most 6 %
  double tolerance = 0.0;
};

/// What a user chooses of proposing grasps.
struct ProposeSettings
{
  int maximumGrasps = 20;
  double frictionAngle = 15.0; ///< degrees between the closing direction and the surface's normals: friction of 0.27
  double spread = 0.0;         ///< mm: nearer than this two grasps are one; 0: 10 % of the part's diameter
  unsigned seed = 1;           ///< of the places that are tried
  int threads = 0;             ///< 0: one for each processor; no part in the result
};
}
