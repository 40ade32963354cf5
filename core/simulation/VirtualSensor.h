// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Error.h"
#include "Random.h"
#include "scene/OrganizedCloud.h"

namespace meam
{
/// Something the sensor looks at.
struct Body
{
  const TriangleMesh* mesh = nullptr;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity(); ///< mm, in the sensor's frame
  double albedo = 0.6;                                             ///< share of the light it reflects
};

/// A pinhole at the origin, looking along z; x right, y down. The principal point is the middle.
struct VirtualSensorSettings
{
  int width = 960;
  int height = 768;
  double focalLength = 1000.0; ///< pixels
  double floor = 1000.0;       ///< mm, z of an endless plane across the view
  double floorAlbedo = 0.25;
  double nearness = 10.0;  ///< mm; a pixel so much behind its surroundings is in their shade
  double depthNoise = 0.0; ///< mm, standard deviation along the line of sight
  double dropout = 0.0;    ///< share of the pixels without depth
  double imageNoise = 0.0; ///< grey values, standard deviation
};

/// What the sensor returns, and what it saw.
struct SensorData
{
  OrganizedCloud cloud;
  Image image;                    ///< grey
  std::vector<int> bodyOfPixel;   ///< index of the body; -1: the floor
  std::vector<int> visiblePixels; ///< of each body
  std::vector<int> alonePixels;   ///< of each body if it were alone
};

/// Renders the bodies: depth, and a grey image with two lamps that cast shadows. Nothing may come
/// nearer to the sensor than a hundredth of the floor's distance. Throws Error when something does.
SensorData renderBodies(const std::vector<Body>& bodies, const VirtualSensorSettings& settings, Random& random,
  const Progress& progress = {});
}
