// SPDX-License-Identifier: BSD-3-Clause
#include "pick/proposal/GraspFitting.h"

#include "base/Error.h"

namespace meam
{
Grasp fitGrasp(const MeshRays& rays, const Grasp& grasp, const Gripper& gripper, double start)
{
  Grasp result = grasp;
  if (grasp.kind == GraspKind::Suction)
  {
    const Eigen::Vector3d down = grasp.T_model_grasp.linear().col(2);
    const Eigen::Vector3d from = grasp.T_model_grasp.translation() - start * down;
    const auto hit = rays.firstEntered(from, down, 2.0 * start);
    if (!hit)
    {
      throw Error(
        "The grasp '" + grasp.name + "' meets nothing along its approach: move it over the part, z into the part.");
    }
    result.T_model_grasp.translation() = from + hit->distance * down;
    result.width = 0.0;
    return result;
  }
  const Eigen::Vector3d along = grasp.T_model_grasp.linear().col(0);
  const Eigen::Vector3d origin = grasp.T_model_grasp.translation();
  const double half = 0.5 * gripper.opening;
  const auto low = rays.firstEntered(origin - half * along, along, gripper.opening);
  const auto high = rays.firstEntered(origin + half * along, -along, gripper.opening);
  if (!low || !high)
  {
    throw Error(
      "The grasp '" + grasp.name +
      "' closes on nothing: move it onto the part, its x along which the jaws close across the part, and check "
      "that the part fits into the gripper's opening.");
  }
  result.T_model_grasp.translation() = origin + 0.5 * (low->distance - high->distance) * along;
  result.width = gripper.opening - low->distance - high->distance;
  return result;
}
}
