// SPDX-License-Identifier: BSD-3-Clause
// A part and a gripper for it.
#pragma once

#include "TestParts.h"
#include "pick/Bin.h"
#include "pick/Grasp.h"
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

/// Under a sensor that looks along z, its floor 500 mm away; along x, along y and high.
inline meam::Bin bin(double length, double width, double height)
{
  meam::Bin result;
  result.T_scene_bin.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  result.T_scene_bin.translation().z() = 500.0;
  result.size = { length, width, height };
  return result;
}

/// From above, across the block.
inline meam::Grasp fromAbove(double y = 0.0)
{
  meam::Grasp grasp;
  grasp.name = "above";
  grasp.T_model_grasp = meam::graspFrame({ 0, y, 0 }, { 0, 0, 1 }, { 1, 0, 0 });
  grasp.width = 20.0;
  return grasp;
}
}
