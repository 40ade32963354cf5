// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
constexpr double SpacingShare = 0.01; // of d_max: samples, and points on feature edges

struct SurfaceSamplingSettings
{
  double spacing = 0.0; ///< mm, between neighbouring samples; 0: 1 % of d_max
  unsigned seed = 1;    ///< the same seed gives the same samples
};

/// Samples the surface evenly (Poisson discs): no two samples are closer than the spacing and no more would fit. This
/// is counted among samples that face the same way, so that narrow faces and both sides of a thin wall get samples of
/// their own. Normals come from the winding of the triangles; pointIds count the samples. Throws Error for a mesh
/// without faces or without area, an invalid vertex or index, a bad spacing, or one that asks for millions of samples.
PointCloud sampleSurface(
  const TriangleMesh& mesh, const SurfaceSamplingSettings& settings = {}, const Progress& progress = {});
}
