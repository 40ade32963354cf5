// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

#include <functional>

namespace meam
{
/// The corners of an outline, or of a line that is open.
using Polyline = std::vector<Eigen::Vector2d>;

/// A part of upright columns: `lines` cut the plane into regions, and solid(point, layer) tells whether a region
/// is solid between levels[layer] and levels[layer + 1] (mm, ascending). Its surface is every face between solid
/// and empty: closed, facing outwards and without crossings, as long as no two columns touch at an edge alone.
TriangleMesh columnMesh(const std::vector<double>& levels, const std::vector<Polyline>& lines,
  const std::function<bool(const Eigen::Vector2d&, int)>& solid);

/// An upright piece of a part that is added, or taken away.
struct Feature
{
  enum Kind
  {
    Solid,
    Empty
  };
  Kind kind;
  Polyline outline; ///< closed, without its first corner again
  double bottom;    ///< mm
  double top;
};

/// A part of features; a later one wins over those before.
TriangleMesh featureMesh(const std::vector<Feature>& features);
}
