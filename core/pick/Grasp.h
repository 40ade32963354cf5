// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace meam
{
/// What holds the part.
enum class GraspKind
{
  Parallel, ///< two jaws that close on it
  Suction   ///< a cup that sits on it
};

/// The axis of the grasp's frame about which the gripper may be turned by any angle and grasps as well.
enum class FreeTurn
{
  None,
  Approach, ///< z: a cup on a flat spot, jaws on a sphere
  Closing   ///< x: jaws on the two faces of a disc
};

/// Where a gripper holds the part, in the CAD's coordinates. The frame's origin lies between the tips of the jaws, or
/// in the middle of the cup's rim, when the part is held; z is the way in; along x the jaws close.
struct Grasp
{
  std::string name;
  GraspKind kind = GraspKind::Parallel;
  Eigen::Isometry3d T_model_grasp = Eigen::Isometry3d::Identity(); ///< mm
  double width = 0.0;                                              ///< mm, of the part between the jaws; 0 for a cup
  FreeTurn freeTurn = FreeTurn::None;
  double quality = 1.0; ///< [0, 1], how well it holds, as whoever made it thinks
};

using Grasps = std::vector<Grasp>;

/// The frame of a grasp at a point, mm, with the way in and the direction of closing (of any length; closing is made
/// perpendicular to the way in). Throws Error where they are parallel, of no length or not finite.
Eigen::Isometry3d graspFrame(
  const Eigen::Vector3d& position, const Eigen::Vector3d& approach, const Eigen::Vector3d& closing);

/// Throws Error, naming the grasp, for a frame that is not a rotation and a translation, a width or a quality out of
/// range, a turn that its kind cannot make.
void requireGrasp(const Grasp& grasp);
}
