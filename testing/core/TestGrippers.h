// SPDX-License-Identifier: BSD-3-Clause
// A part and a gripper for it.
#pragma once

#include "TestParts.h"
#include "pick/Gripper.h"

namespace grippers
{
/// 20 x 40 x 20 mm about the origin. Lying on a floor at z = 500 it reaches from z = 480.
inline meam::TriangleMesh block() { return parts::box({ -10, -20, -10 }, { 10, 20, 10 }); }

/// Their fingers stand 3 mm from the block, from 13 to 21 mm on either side of its middle.
inline meam::Gripper jaws(double opening = 40.0)
{
  meam::Gripper gripper;
  gripper.opening = opening;
  gripper.jawClearance = 3.0;
  gripper.fingerWidth = 10.0;
  gripper.fingerThickness = 8.0;
  gripper.fingerLength = 50.0;
  gripper.tipLength = 6.0;
  gripper.bodyWidth = 20.0;
  return gripper;
}
}
