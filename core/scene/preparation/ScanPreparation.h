// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/MeasuredCloud.h"
#include "scene/OrganizedCloud.h"
#include "scene/Sensor.h"
#include "scene/edges/SceneEdgeExtraction.h"

#include <optional>
#include <string>

namespace meam
{
/// A scan as its edges are found in it: a grid, in the frame of a sensor that looks along +z.
struct PreparedScan
{
  OrganizedCloud cloud;
  Image image;               ///< registered with it; empty when there is none
  std::vector<int> pointIds; ///< of each place of the grid the scan's point, or -1; empty: they are the same
  Sensor sensor;             ///< in the scan's own coordinates
  Eigen::Isometry3d T_sensor_scan = Eigen::Isometry3d::Identity();
  bool isViewpointGuessed = false; ///< nothing tells where the sensor stood
  bool isAsGiven = true;           ///< neither points nor axes differ from the scan's
  std::string report;              ///< in sentences, what was assumed; empty when there was nothing to

  /// The measured points, in the scan's own coordinates.
  Points measured() const;
};

/// Brings what people have to that: points by which a sensor says that it measured nothing are left out; axes are
/// turned; points that are not organized (`height` 1) come back onto the grid of their sensor, which is found again
/// from where they lie, or else onto one that they fill, laid at the given or the likely viewpoint; and a grid of which
/// few places are filled is made coarser. `image` is registered with the scan, or empty. `sensor`: none, when it is not
/// known. Throws Error for a cloud without points, and for a grid whose width and height are swapped.
PreparedScan prepareScan(OrganizedCloud scan, Image image, const std::optional<Sensor>& sensor);

/// Where points alone were seen from, by the pose that their file tells. None where they are on the grid of a sensor at
/// a usual place or in front of the origin, as those in the sensor's own frame are, and where not all lie ahead of it.
std::optional<Sensor> sensorOfFile(const MeasuredCloud& measured);

/// The edge points of a scan, in its own coordinates, and their pointIds of its own points. Without an image they are
/// those of the cloud, if the settings look for these.
SceneEdges extractSceneEdges(
  const PreparedScan& scan, const SceneEdgeExtractionSettings& settings, const Progress& progress = {});
}
