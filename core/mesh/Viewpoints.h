// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// Unit directions from the part to `count` viewpoints around it. 1: above (+z); 2: above and below;
/// 6: the axes (the paper's choice); 14: and the cube's corners; 26: and the middles of its edges;
/// any other number: a Fibonacci sphere.
///
/// Of a part that is seen from some side only, the directions within `coneAngle` degrees of
/// `coneDirection` (of any length): of the fixed sets those that are inside, any other number is
/// spread over the inside. Throws Error when there are none, and for a cone that is not one.
Points viewDirections(int count, const Eigen::Vector3d& coneDirection, double coneAngle);
/// The same all around.
inline Points viewDirections(int count) { return viewDirections(count, Eigen::Vector3d::UnitZ(), 180.0); }
}
