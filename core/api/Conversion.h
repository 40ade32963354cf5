// SPDX-License-Identifier: BSD-3-Clause
/// From the structs of meam.h and picks.h to the core's, for the files that several libraries are made of.
#pragma once

#include "mesh/Symmetries.h"
#include "mesh/TriangleMesh.h"
#include "pick/Gripper.h"
#include "picks.h"

namespace meam
{
/// Throws Error when the scan's points do not fill its grid.
void requireGrid(const Scan& scan);

/// The part's mesh. Throws Error for one that is invalid or not as large as the model's part, if there is a model.
TriangleMesh partOf(const Model& model, const Mesh& part);

/// Those of the model's part; none without a model.
Symmetries symmetriesOf(const Model& model);

Gripper gripperOf(const GripperModel& gripper);
}
