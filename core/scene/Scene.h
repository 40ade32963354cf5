// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LocalFrame.h"
#include "mesh/Symmetries.h"
#include "pose/Pose.h"
#include "scene/Sensor.h"

namespace meam
{
/// All that is known of a bin at the time of detection; mm.
struct Scene
{
  PointCloud edges; ///< edge points with tangents
  Points surface;   ///< all points the sensor measured; may be empty
  Sensor sensor;
  /// Takes the scene's own coordinates, in which poses are told, to those in which points and sensor are given here.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
};

/// The scene in the frame of its surface, or without one that of its edges: a scene that is moved is the same scene there.
/// `edges` and `sensor` are in the scene's coordinates.
Scene sceneInOwnFrame(const PreciseCloud& edges, FramedPoints surface, const Sensor& sensor, int threads = 1);

/// Poses, in the scene's own coordinates, in those of its points. Of poses that are equal for a part with these symmetries
/// the one that is turned least there, whatever the scene's coordinates are. Throws Error for a pose that is not finite.
Poses inFrameOf(const Scene& scene, const Poses& poses, const Symmetries& symmetries);
}
