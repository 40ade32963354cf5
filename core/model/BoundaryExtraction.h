// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"
#include "model/AppearanceModel.h"

namespace meam
{
enum class BoundaryMethod
{
  PointBoundary, ///< of the points alone (PCL's boundary estimation), as in the paper
  MeshEdges      ///< the mesh's sharp edges, borders and occluding contours, as far as they are seen
};

struct BoundaryExtractionSettings
{
  BoundaryMethod method = BoundaryMethod::PointBoundary;
  // PointBoundary
  double radius = 0.0; ///< mm, neighbourhood of a point; 0: 2.5 times the spacing of the points
  double angle = 90.0; ///< degrees: a point with a wider gap between its neighbours is on the boundary
  // MeshEdges
  double sharpAngle = 30.0; ///< degrees: faces that meet at more than this make a sharp edge
};

/// Reduces each appearance model to its boundary points (paper, Section 4), each with its type. The
/// models need normals. MeshEdges needs the prepared mesh that they are of: its edge points are as dense
/// as the models' and come with exact tangents; their pointIds are those of the nearest visible samples.
/// Of a whole part nothing is a contour: the boundary of its points is creases, its MeshEdges are all sharp
/// edges and the borders.
/// Throws Error when a model has no points or no normals, and without what the method needs.
std::vector<AppearanceModel> extractBoundary(const std::vector<AppearanceModel>& models,
  const BoundaryExtractionSettings& settings = {}, const TriangleMesh* mesh = nullptr, const Progress& progress = {});

/// The median distance of a point to its nearest neighbour, in mm; 0 for less than two places.
double pointSpacing(const Points& points);
}
