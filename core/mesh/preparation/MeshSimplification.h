// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshDistance.h"

namespace meam
{
/// Nothing promises that the collapses keep the bound: the result is measured, and they are repeated with less
/// tolerance when it does not hold.
struct MeshSimplificationSettings
{
  double leastCosine = 0.26;   ///< of 75 degrees: a triangle turns by less when one of its corners moves
  int tries = 4;               ///< then the mesh stays as it is
  double toleranceShare = 0.9; ///< of the largest error, in the first try; from then on it shrinks by what was too much
  double leastNext = 0.2;      ///< of the last tolerance, the next one at least,
  double mostNext = 0.8;       ///< and at most
  MeshDistanceSettings distance{};
};

/// The mesh with as few triangles as edge collapses reach (OpenMesh) while no point of the new surface is
/// farther than `maximumError` (mm) from the old one, nor of the old one from the new. The result is
/// measured, see meshDistance(). Its vertices are some of the old ones; edges and borders stay within the
/// bound too. Throws Error for an error bound that is not positive.
TriangleMesh simplifyMesh(const TriangleMesh& mesh, double maximumError, const Progress& progress = {},
  const MeshSimplificationSettings& settings = {});
}
