// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/Pose.h"

namespace meam
{
/// Where the part's middle (model frame, mm) may be: what maps the unit ball onto the ellipsoid of so many standard
/// deviations about it, by the translations in the pose's covariance, scene coordinates.
Eigen::Affine3d uncertaintyEllipsoid(const Pose& pose, const Eigen::Vector3d& middle, double deviations);
}
