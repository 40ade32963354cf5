// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/MeshRays.h"
#include "mesh/Symmetries.h"
#include "mesh/TriangleMesh.h"

#include <vector>

namespace meam
{
/// A place of the part's surface that a gripper may touch.
struct ContactPlace
{
  Eigen::Vector3d point;  ///< mm
  Eigen::Vector3d normal; ///< unit, outward
};

/// Where the part weighs and how large it is.
struct PartBalance
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< of mass, of an even solid, or of a sheet when it is open; mm
  double diameter = 0.0;                            ///< d_max, mm
};

PartBalance balanceOf(const TriangleMesh& part);

/// First the places where lines through the centre of mass leave the surface at right angles, because a grasp is best
/// there, then about `count` all over it. Of those that the exact symmetries make equal about one.
std::vector<ContactPlace> contactPlaces(const TriangleMesh& part, const MeshRays& rays, const PartBalance& balance,
  const Symmetries& symmetries, int count, unsigned seed);
}
