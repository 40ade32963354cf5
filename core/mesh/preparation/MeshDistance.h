// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// The largest distance (mm) of a point of either surface from the other surface, measured at the
/// corners of faces and at points spread evenly over faces and edges, as dense as the finer mesh's vertices.
double meshDistance(const TriangleMesh& a, const TriangleMesh& b, const Progress& progress = {});
}
