// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
struct FeatureEdgesSettings
{
  double angle = 30.0;  ///< degrees: faces that meet at more than this make a sharp edge
  double spacing = 0.0; ///< mm, between neighbouring points along an edge; 0: 1 % of d_max
};

/// Finds the sharp edges (EdgeType::Crease) and the borders (EdgeType::HoleBorder) of a prepared mesh and
/// samples them evenly. Tangents are the directions of the mesh's edges, normals the mean of their
/// faces'; pointIds count the points. Edges where more than two faces meet are sharp. A closed, smooth
/// mesh gives no points. Throws Error for a mesh without faces, an invalid vertex or index, or a bad setting.
PointCloud extractFeatureEdges(
  const TriangleMesh& mesh, const FeatureEdgesSettings& settings = {}, const Progress& progress = {});
}
