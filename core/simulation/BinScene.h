// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/Error.h"
#include "mesh/TriangleMesh.h"
#include "pick/Bin.h"
#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"
#include "simulation/VirtualSensor.h"

namespace meam
{
struct BinSceneSettings
{
  int copies = 20;
  /// Where copies stand, in the sensor's frame, mm: `copies` does not count. Empty: they fall.
  std::vector<Eigen::Isometry3d> poses{};
  bool settle = false;       ///< they are let go at `poses` and come to rest; otherwise nothing falls
  unsigned seed = 1;         ///< the same seed gives the same scene
  double binSize = 0.0;      ///< mm, inner side of the bin; 0: follows the part and the copies
  double binWidth = 0.0;     ///< mm, its other inner side, along y; 0: the bin is a square
  double wallHeight = 0.0;   ///< mm; 0: 0.6 diameters of the part
  double sensorHeight = 0.0; ///< mm above the floor; 0: three times the bin's longer side
  int width = 960;           ///< pixels
  int height = 768;
  bool colored = false;  ///< the image: red, green and blue, or grey
  double baseline = 0.0; ///< mm from the sensor to a camera beside it that takes the image; 0: the sensor does
  SensorQuality quality{};
};

/// A bin that a sensor of a kind sees, with as many pixels as it has: structured light 960 x 768, active stereo
/// 1280 x 720 (Intel RealSense D415), time of flight 640 x 480 (Sony IMX556, the chip of many industrial cameras). The
/// view is narrower than that of most such sensors, for the bin fills it from three times its side away.
BinSceneSettings binSettings(SensorKind kind);

/// One copy of the part in the bin.
struct BinInstance
{
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity(); ///< mm, in the sensor's frame
  Mask silhouette;       ///< the pixels of the depth it would have if nothing else were there
  int visiblePixels = 0; ///< of these, those that nothing hides
  double visibleFraction() const
  {
    const int whole = this->silhouette.count();
    return whole > 0 ? static_cast<double>(this->visiblePixels) / whole : 0.0;
  }
};

/// What a sensor straight above the bin returns, and the truth.
struct BinScene
{
  OrganizedCloud cloud;
  Camera sensor; ///< of the depth; at the origin
  Image image;
  Camera camera;                    ///< of the image; the sensor when the image is registered with the cloud
  std::vector<int> instanceOfPixel; ///< of the depth; -1: the bin
  std::vector<BinInstance> instances;
  double binSize = 0.0; ///< mm
  Bin bin;              ///< where it is
};

/// A bin with a floor, walls and copies of `part` (mm) that lie as they fell, and the scan of it by a virtual
/// sensor. A camera beside it looks at the middle of the floor and has as many pixels. Throws Error for a mesh
/// without faces or settings out of range, among them a bin into which the part does not fit.
BinScene simulateBin(const TriangleMesh& part, const BinSceneSettings& settings = {}, const Progress& progress = {});
}
