// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "mesh/Symmetries.h"
#include "mesh/TriangleMesh.h"
#include "pick/Grasp.h"
#include "pick/Gripper.h"

namespace meam
{
/// Grasps from the part's faces (mm, closed meshes facing outwards), spread over it, best first, for jaws or a cup as
/// the gripper has them. Jaws: pairs of places that face apart, along the normal of the first, both normals within the
/// friction cone (antipodal; Nguyen, IJRR 7(3), 1988), and approaches across it; a cup: places that are flat under its
/// whole rim. Left out is what the gripper would touch the part with on its way in. Quality, [0, 1]: the share of the
/// pads that touches, or how well the lip closes, less what is lost by the distance from the centre of mass and by
/// slanted normals. Of grasps that the part's exact symmetries make equal one comes out; a turn is free where the grasp
/// is as good all around. Throws Error for an invalid mesh, gripper or setting; a part that nothing holds gives no
/// grasps.
Grasps proposeGrasps(const TriangleMesh& part, const Symmetries& symmetries, const Gripper& gripper,
  const ProposeSettings& settings = {}, const Progress& progress = {});
}
