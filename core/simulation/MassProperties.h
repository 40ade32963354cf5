// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// How a body's mass is spread, for a mass of 1.
struct MassProperties
{
  Eigen::Isometry3d T_model_body = Eigen::Isometry3d::Identity(); ///< mm; from the centre of mass, principal axes
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();              ///< mm^2, about the axes of the body
};

/// Of an even solid when the mesh is closed (and faces outwards), otherwise of an even sheet over its faces.
MassProperties massProperties(const TriangleMesh& mesh, bool closed);
}
