// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Error.h"
#include "scene/OrganizedCloud.h"

namespace meam
{
struct BinSceneSettings
{
  int copies = 20;
  unsigned seed = 1;         ///< the same seed gives the same scene
  double binSize = 0.0;      ///< mm, inner side of the square bin; 0: follows the part and the copies
  double sensorHeight = 0.0; ///< mm above the floor; 0: three times the bin's side
  int width = 960;           ///< pixels
  int height = 768;
  double depthNoise = 0.1; ///< mm, standard deviation
  double dropout = 0.002;  ///< share of the pixels without depth, besides those seen too flatly
  double imageNoise = 1.5; ///< grey values, standard deviation
};

/// One copy of the part in the bin.
struct BinInstance
{
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity(); ///< mm, in the sensor's frame
  double visibleFraction = 0.0; ///< pixels seen over pixels if nothing else were there
};

/// What a sensor straight above the bin returns, and the truth.
struct BinScene
{
  OrganizedCloud cloud;
  Image image;                      ///< grey, registered with the cloud
  std::vector<int> instanceOfPixel; ///< -1: the bin
  std::vector<BinInstance> instances;
  double focalLength = 0.0; ///< pixels; the principal point is the middle of the image
  double binSize = 0.0;     ///< mm
};

/// A bin with a floor, low walls and copies of `part` (mm) that lie as they fell, and the scan of
/// it by a virtual sensor. Throws Error for a mesh without faces or settings out of range, among
/// them a bin into which the part does not fit.
BinScene simulateBin(const TriangleMesh& part, const BinSceneSettings& settings = {}, const Progress& progress = {});
}
