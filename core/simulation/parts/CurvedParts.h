// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

namespace meam
{
// Parts whose outlines move with the view, as pipes, caps and handles have them. Closed meshes in mm that face outward;
// no face is farther than 0.1 mm from the round surface that it stands for.

TriangleMesh pipeElbow();
TriangleMesh cap();
TriangleMesh knob();
TriangleMesh handle();
}
