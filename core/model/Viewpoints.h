// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry.h"

namespace meam
{
/// Unit directions from the part to `count` viewpoints around it. 1: above (+z); 2: above and below;
/// 6: the axes (the paper's choice); 14: and the cube's corners; 26: and the middles of its edges;
/// any other number: a Fibonacci sphere.
Points viewDirections(int count);
}
