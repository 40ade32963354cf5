// SPDX-License-Identifier: BSD-3-Clause
#include "io/CameraFile.h"
#include "io/DepthImage.h"
#include "io/ImageFile.h"
#include "meam.h"

namespace meam
{
Image loadImage(const std::string& path) { return readImage(path); }

Scan loadDepthImage(const std::string& path, const std::string& cameraFile, double scale)
{
  const CameraFile calibration = readCamera(cameraFile);
  OrganizedCloud cloud = readDepthImage(path, calibration.camera, scale * calibration.depthScale);
  Scan scan;
  scan.width = cloud.width;
  scan.height = cloud.height;
  scan.points = std::move(cloud.points);
  return scan;
}
}
