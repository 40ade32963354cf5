// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "mesh/Symmetries.h"
#include "mesh/TriangleMesh.h"
#include "pick/Grasp.h"
#include "pick/Gripper.h"

namespace meam
{
struct GraspProposalSettings : ProposeSettings
{
  double turnApart = 40.0; ///< degrees: turned by less than this, two grasps nearer than `spread` are one; less than
                           ///< the step between approaches

  double crowding = 0.8; ///< times its worth for each grasp taken at its place, and for each with its way in; 1: by
                         ///< quality alone, however many are at one place

  // Of jaws.
  double leastWidth = 0.5;    ///< mm, of what the jaws hold: thinner sheets bend
  double padTolerance = 0.5;  ///< mm that a jaw's pad may be from the surface where it is said to touch
  double leastContact = 0.15; ///< share of each pad that has to touch; a pin touches a fifth all along the pad
  int approaches = 8;         ///< directions about the closing one that are tried

  // Of cups.
  double sealTolerance = 0.4; ///< mm between the cup's rim and the surface that a lip of rubber closes
  double mostBend = 5.0;      ///< degrees between the surface's normals under the cup

  double wayIn = 80.0;       ///< mm, straight along the approach, on which the gripper must not touch the part
  double wayStep = 2.0;      ///< mm between the places on it at which a gripper that is a mesh is looked at
  int contacts = 1500;       ///< places on the surface that are tried, about: more finds more and takes longer
  double turnStep = 15.0;    ///< degrees between the turns at which a free one is proved
  double freeTurnLoss = 0.1; ///< share of the contact that a free turn may cost
  double centreWeight = 0.5; ///< of the quality that is lost half a diameter away from the centre of mass
  double angleWeight = 0.5;  ///< of the quality that is lost at the limit of friction, or of what a lip closes
};

/// Grasps from the part's faces (mm, closed meshes facing outwards), spread over it, best first, for jaws or a cup as
/// the gripper has them. Jaws: pairs of places that face apart, along the normal of the first, both normals within the
/// friction cone (antipodal; Nguyen, IJRR 7(3), 1988), and approaches across it; a cup: places that are flat under its
/// whole rim. Left out is what the gripper would touch the part with on its way in. Quality, [0, 1]: the share of the
/// pads that touches, or how well the lip closes, less what is lost by the distance from the centre of mass and by
/// slanted normals. Of grasps that the part's exact symmetries make equal one comes out; a turn is free where the grasp
/// is as good all around. Throws Error for an invalid mesh, gripper or setting; a part that nothing holds gives no
/// grasps.
Grasps proposeGrasps(const TriangleMesh& part, const Symmetries& symmetries, const Gripper& gripper,
  const GraspProposalSettings& settings = {}, const Progress& progress = {});
}
