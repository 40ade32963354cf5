// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "pick/Grasp.h"

#include <vector>

namespace meam
{
/// A gripper by a few lengths, mm. In the grasp's frame it comes along z, and its jaws close along x.
struct Gripper
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

  /// Any gripper, as it stands open around the part, in the grasp's frame; it takes the place of the jaws or the cup.
  /// Empty: the lengths above.
  TriangleMesh mesh{};
};

/// A convex piece of a gripper, its axes those of the grasp's frame.
struct GripperPiece
{
  bool round = false;                               ///< a cylinder along z, size.x() its diameter; or a box
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(); ///< mm
  Eigen::Vector3d size = Eigen::Vector3d::Zero();   ///< mm
};

/// The gripper around a part, open; none of one that is a mesh. Made longer by `wayIn` (mm) backwards, each piece is
/// all the room that it takes on its way.
std::vector<GripperPiece> piecesOf(const Gripper& gripper, const Grasp& grasp, double wayIn = 0.0);

/// What comes to lie between the jaws when they close, as far as they are wide and their tips reach; none of a cup.
std::vector<GripperPiece> betweenJaws(const Gripper& gripper, const Grasp& grasp);

/// The faces of a piece, to look at.
TriangleMesh meshOf(const GripperPiece& piece);

/// The faces of the gripper around a part, in the grasp's frame, to look at.
TriangleMesh meshOf(const Gripper& gripper, const Grasp& grasp);

/// Throws Error, with its name, for a length that is not positive, a clearance below 0, or an invalid mesh.
void requireGripper(const Gripper& gripper);
}
