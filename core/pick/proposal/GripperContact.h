// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/MeshRays.h"
#include "pick/Grasp.h"
#include "pick/Gripper.h"

#include <optional>

namespace meam
{
constexpr double SealTolerance = 0.4; // mm between a cup's rim and the surface that a lip of rubber closes

/// How a gripper touches the part at a grasp.
struct GripperContact
{
  double share = 0.0; ///< [0, 1] of the pad that touches less; 1 for a cup, which touches all around
  double slant = 0.0; ///< [0, 1]: of the limits, which may be reached, of friction, or of what a cup's lip closes
};

/// Jaws that close on the part until they are as wide apart as the grasp says. None when a middle of their pads does
/// not touch within the cone of `frictionAngle` (degrees), something keeps a pad away, or too little touches.
std::optional<GripperContact> jawContact(
  const MeshRays& rays, const Grasp& grasp, const Gripper& gripper, double frictionAngle);

/// A cup that sits down on the part. None when its rim, or the surface under it, is not flat enough.
std::optional<GripperContact> cupContact(const MeshRays& rays, const Grasp& grasp, const Gripper& gripper);
}
