// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
struct SurfaceSamplingSettings
{
  double spacing = 0.0;              ///< mm, between neighbouring samples; 0: spacingShare
  unsigned seed = 1;                 ///< the same seed gives the same samples
  double spacingShare = 0.01;        ///< of d_max
  double candidatesPerSquare = 20.0; ///< of side `spacing`: a point of the surface is at most the spacing and the
                                     ///< distance to the nearest candidate away from a sample
  double sameSide = 0.5; ///< cosine of 60 degrees: samples that face farther apart do not displace each other
};

/// Samples the surface evenly (Poisson discs): no two samples are closer than the spacing and no more would fit. This
/// is counted among samples that face the same way, so that narrow faces and both sides of a thin wall get samples of
/// their own. Normals come from the winding of the triangles; pointIds count the samples. Throws Error for a mesh
/// without faces or without area, an invalid vertex or index, a bad spacing, or one that asks for millions of samples.
PointCloud sampleSurface(
  const TriangleMesh& mesh, const SurfaceSamplingSettings& settings = {}, const Progress& progress = {});
}
