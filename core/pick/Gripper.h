// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "pick/PickTypes.h"

#include <vector>

namespace meam
{
/// A gripper by its lengths, or any, as it stands open around the part, in the grasp's frame: its mesh, when it has
/// faces, takes the place of the jaws or the cup.
struct Gripper : GripperLengths
{
  TriangleMesh mesh;
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
