// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/MeshRays.h"
#include "pick/Grasp.h"
#include "pick/Gripper.h"

namespace meam
{
/// A grasp that was laid by hand, moved onto the part: jaws close from the gripper's opening, on the line through the
/// grasp's origin, until both touch; its width becomes that of the part there, its origin the middle between them, and
/// its direction stays. A cup goes along its approach from `start` mm before its origin until its middle meets the
/// surface. Throws Error, naming the grasp, when nothing is there to touch.
Grasp fitGrasp(const MeshRays& rays, const Grasp& grasp, const Gripper& gripper, double start);
}
