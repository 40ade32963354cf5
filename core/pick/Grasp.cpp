// SPDX-License-Identifier: BSD-3-Clause
#include "pick/Grasp.h"

#include "base/Error.h"

#include <cmath>

namespace meam
{
Eigen::Isometry3d graspFrame(
  const Eigen::Vector3d& position, const Eigen::Vector3d& approach, const Eigen::Vector3d& closing)
{
  const Eigen::Vector3d z = approach.normalized();
  const Eigen::Vector3d across = closing - closing.dot(z) * z;
  if (!position.allFinite() || !approach.allFinite() || !closing.allFinite() || !(approach.norm() > 0.0) ||
      !(across.norm() > 1e-6 * closing.norm()))
  {
    throw Error("A grasp needs a position and two directions that are not parallel: the approach, and along which the "
                "jaws close.");
  }
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear().col(0) = across.normalized();
  frame.linear().col(1) = z.cross(across.normalized());
  frame.linear().col(2) = z;
  frame.translation() = position;
  return frame;
}

void requireGrasp(const Grasp& grasp)
{
  const auto fail = [&grasp](const std::string& what) { throw Error("The grasp '" + grasp.name + "' " + what); };
  const Eigen::Matrix3d R = grasp.T_model_grasp.linear();
  if (!grasp.T_model_grasp.matrix().allFinite() || !(R.transpose() * R).isIdentity(1e-6) || R.determinant() < 0.0)
  {
    fail("has a frame that is not a rotation and a translation.");
  }
  if (!(grasp.width >= 0.0) || !std::isfinite(grasp.width))
  {
    fail("has a width that is not a length in mm, 0 or more.");
  }
  if (!(grasp.quality >= 0.0 && grasp.quality <= 1.0))
  {
    fail("has a quality outside 0 to 1.");
  }
  if (grasp.kind == GraspKind::Suction && grasp.freeTurn == FreeTurn::Closing)
  {
    fail("is one of suction, which closes along no axis: it may be turned about the approach only.");
  }
}
}
