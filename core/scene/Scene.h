// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LocalCloud.h"
#include "base/PointGrid.h"
#include "scene/depth/DepthMap.h"
#include "scene/depth/FineDepth.h"
#include "scene/EdgeIndex.h"
#include "scene/Enclosure.h"
#include "scene/ScanQuality.h"
#include "scene/Sensor.h"

namespace meam
{
struct SceneSettings
{
  bool findsEnclosure = true; ///< floor and walls of the bin
  bool findsLongLines = true; ///< edges longer than the part
  bool followsNoise = true;   ///< the tolerance of both is no less than 3 times the scan's noise
  int threads = 0;            ///< 0: one for each processor
};

/// A bin at the time of detection, prepared for parts of one diameter: built once, in the frame of its edge points, in
/// which all stages work and all poses stay until the end. Lengths in mm. Calls may run in parallel.
struct Scene
{
  /// `edges`: thinned edge points with tangents (estimateTangents). `allMeasured`: the points that the sensor measured,
  /// in their frame, or none. `sensor` in the scene's own coordinates. `quality`: what the scan shows of it, where that
  /// is known. Throws Error when the scene has no edges, edges without tangents, or weights beyond [0, 1], and when no
  /// point of the surface lies before the sensor.
  Scene(LocalCloud edges, const Points& allMeasured, const Sensor& sensor, double partDiameter,
    const SceneSettings& settings = {}, const ScanQuality& quality = {});
  Scene(const Scene&) = delete;
  void operator=(const Scene&) = delete;

  bool hasSurface() const { return !this->depth.means().empty(); }
  const Eigen::Isometry3d& T_local_scene() const { return this->edges.T_local_scene; }
  const PointCloud& edgePoints() const { return this->edges.cloud; }
  /// Grid of the edge points.
  const PointGrid& edgeGrid() const { return this->edgeIndex.grid(); }

  LocalCloud edges;
  Sensor sensor; ///< in the local frame
  ScanQuality quality;
  Points measured; ///< all that the sensor measured
  double partDiameter;
  EdgeIndex edgeIndex;
  ScanProjection lines; ///< of `measured`
  DepthMap depth;
  FineDepth fineDepth;                     ///< point by point: next to none of its cells is empty on a surface
  PointGrid surface;                       ///< of depth.means()
  std::vector<Plane> enclosure;            ///< the bin's floor and walls, as far as they are in sight
  std::vector<unsigned char> isOnLongLine; ///< of each edge point: the line is longer than the part
  PointGrid longLines;                     ///< of these edge points
};
}
