// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Symmetries.h"
#include "pick/Grasp.h"

namespace meam
{
/// Turns of a part after which it looks the same, the identity first: its discrete symmetries, and every `step` degrees
/// about its axis when it has one (of a ball about one axis).
std::vector<Eigen::Isometry3d> turnsOf(const Symmetries& symmetries, double step);

/// The frames, T_model_grasp, at which a grasp is as good as at the one given, which comes first: `symmetric` turns of
/// the part, and every `step` degrees of what is free. Of frames that are equal, but for a thousandth of `size` (mm),
/// one.
std::vector<Eigen::Isometry3d> framesOf(
  const Grasp& grasp, const std::vector<Eigen::Isometry3d>& symmetric, double step, double size);
}
