// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Error.h"
#include "Geometry.h"
#include "Random.h"

namespace meam
{
/// Drops copies of a part into a square bin, one after the other: T_bin_model of each, in mm, with
/// the origin on the floor in the middle and z up.
///
/// Without physics: a copy comes straight down onto the height field of what lies there, and turns
/// and shifts as long as that lowers its centre of gravity, which is what a frictionless part would
/// do. The height fields are on the safe side, so that no two copies cross each other. Throws Error
/// when the part does not fit into the bin.
std::vector<Eigen::Isometry3d> packBin(
  const TriangleMesh& part, double binSize, int copies, Random& random, const Progress& progress = {});
}
