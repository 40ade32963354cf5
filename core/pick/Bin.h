// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pick/PickTypes.h"

namespace meam
{
/// A box with its middle and its axes.
struct PlacedBox
{
  Eigen::Isometry3d T_scene_box = Eigen::Isometry3d::Identity(); ///< mm
  Eigen::Vector3d size = Eigen::Vector3d::Zero();                ///< mm
};

/// What the bin is made of: its floor and its four walls.
std::vector<PlacedBox> boxesOf(const Bin& bin);

/// Distance of a point (scene, mm) from the bin's floor and walls, mm; 0 inside of them.
double distanceFrom(const Bin& bin, const Eigen::Vector3d& point);

/// Throws Error for sizes that are not positive and a frame that is not a rotation and a translation.
void requireBin(const Bin& bin);
}
