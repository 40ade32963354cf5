// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "mesh/TriangleMesh.h"
#include "scene/MeasuredCloud.h"

#include <string>

namespace meam
{
/// Reads the points of a PLY file (ascii or binary) as a cloud that is not organized, in the file's own unit:
/// x y z, normals from nx ny nz, intensities from intensity, gray, i or scalar_intensity, colours from red green blue
/// or r g b; faces and what else there may be are skipped. Colours are as colorValues() has them. Throws Error, naming
/// the file and what is wrong with it; allocates no more than the length of the file justifies.
MeasuredCloud readPLYCloud(const std::string& path, const Progress& progress = {});

/// Reads the faces of a PLY file, after its points, in the file's own unit; polygons and strips of triangles are
/// cut into triangles. No triangles when there are none. Throws as above.
TriangleMesh readPLYMesh(const std::string& path, const Progress& progress = {});

/// Whether the file's header is that of a PLY file with points and no faces; false for one that cannot be read.
bool isPLYCloud(const std::string& path);
}
