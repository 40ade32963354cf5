// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "pose/Pose.h"

namespace meam
{
/// Where the part's middle (model frame, mm) may be: the ellipsoid of so many standard deviations about it, by the
/// translations in the pose's covariance, scene coordinates; drawn by so many rings of vertices.
TriangleMesh uncertaintyEllipsoid(const Pose& pose, const Eigen::Vector3d& middle, double deviations, int rings = 12);
}
