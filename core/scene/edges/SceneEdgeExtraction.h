// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/Error.h"
#include "features/Preset.h"
#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"
#include "scene/ScanQuality.h"
#include "scene/edges/ImageEdges.h"

#include <optional>

namespace meam
{
/// What told of an edge point; of several the first.
enum class EdgeSource : unsigned char
{
  Image,     ///< Canny's edges
  DepthJump, ///< the surface ends in front of another one
  Crease     ///< two pieces of the surface meet at an angle
};

struct SceneEdgeExtractionSettings
{
  bool imageEdges = true; ///< at least one of the three
  bool depthEdges = false;
  bool creases = false;
  ImageEdgeSettings image;
  std::optional<Camera> camera; ///< that took the image; none: the image is registered with the cloud
  int searchRadius = 1;         ///< grid steps around an edge pixel in which its depth is looked for
  double depthJump = 0.0;       ///< mm between two surfaces that are neighbours; 0: by point distance and noise
  double creaseAngle = 30.0;    ///< degrees between the two pieces of a crease
  bool tangents = true;         ///< from the edge's direction and the local surface; points without it are left out
  int threads = 0;              ///< 0: one for each processor
};

/// What a preset looks for: Paper edges of the image, whose tangents are estimated later (Algorithm 1); Recommended
/// those of the cloud as well: smooth parts on parts of the same color have hardly any in the image.
SceneEdgeExtractionSettings sceneEdgeSettings(Preset preset);

struct SceneEdges
{
  PointCloud cloud; ///< with pointIds, row * width + column, and tangents when they are asked for
  std::vector<EdgeSource> sources;
  ScanQuality quality; ///< of the scan they were found in
};

/// The points of the scene's edges, in the order of the grid, each at most once.
///
/// Image: Canny's edge pixels taken to 3D (paper, Section 5.1). At a depth jump the edge belongs to the
/// surface that is nearer to the camera; a pixel without depth takes its neighbour's. Of a camera beside the
/// sensor the cloud tells what it sees: points that something hides from it get no edge.
/// Depth jumps and creases: from the cloud alone, without looking at the image.
///
/// Throws Error for a cloud that is not organized or has no valid depth, an image of another size than the
/// cloud or its camera, a camera that does not see the scene, or settings out of range. An image of one
/// colour has no edges. `image` is not looked at when only the cloud's edges are wanted.
SceneEdges extractSceneEdges(const OrganizedCloud& cloud, const Image& image,
  const SceneEdgeExtractionSettings& settings = {}, const Progress& progress = {});
}
