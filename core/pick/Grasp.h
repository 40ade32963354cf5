// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pick/PickTypes.h"

namespace meam
{
/// The frame of a grasp at a point, mm, with the way in and the direction of closing (of any length; closing is made
/// perpendicular to the way in). Throws Error where they are parallel, of no length or not finite.
Eigen::Isometry3d graspFrame(
  const Eigen::Vector3d& position, const Eigen::Vector3d& approach, const Eigen::Vector3d& closing);

/// Throws Error, naming the grasp, for a frame that is not a rotation and a translation, a width or a quality out of
/// range, a turn that its kind cannot make.
void requireGrasp(const Grasp& grasp);
}
