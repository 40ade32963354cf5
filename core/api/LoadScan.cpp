// SPDX-License-Identifier: BSD-3-Clause
#include "io/CameraFile.h"
#include "io/MeshFile.h"
#include "io/cloud/PCDFile.h"
#include "io/cloud/XYZFile.h"
#include "io/PLYFile.h"
#include "io/parsing/FileBytes.h"
#include "meam.h"
#include "scene/DepthCloud.h"
#include "scene/preparation/CloudOrganization.h"
#include "scene/preparation/ScanPreparation.h"

namespace meam
{
namespace
{
/// What the file says of each point becomes the image.
Scan scanOf(MeasuredCloud measured)
{
  Scan scan;
  scan.sensor = sensorOfFile(measured);
  scan.width = measured.cloud.width;
  scan.height = measured.cloud.height;
  scan.points = std::move(measured.cloud.points);
  if (!measured.colors.empty() || !measured.intensities.empty())
  {
    scan.image.width = scan.width;
    scan.image.height = scan.height;
    scan.image.channels = measured.intensities.empty() ? 3 : 1;
    scan.image.pixels = measured.intensities.empty() ? std::move(measured.colors) : greyValues(measured.intensities);
  }
  return scan;
}

MeasuredCloud readCloud(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension == ".pcd")
  {
    return readPCD(path);
  }
  if (extension == ".ply")
  {
    return readPLYCloud(path);
  }
  if (extension == ".obj")
  {
    MeasuredCloud measured;
    measured.cloud.points = readOBJPoints(path);
    measured.cloud.width = static_cast<int>(measured.cloud.points.size());
    measured.cloud.height = 1;
    return measured;
  }
  for (const char* text : { ".xyz", ".csv", ".txt", ".asc", ".pts" })
  {
    if (extension == text)
    {
      return readXYZ(path);
    }
  }
  throw Error(
    "The scan '" + path +
    "' has an extension that is not known: give a .pcd, a .ply, an .obj or a text of points (.xyz, .csv, .txt, "
    ".asc, .pts); depth images are read by loadDepthImage().");
}

void scaleCloud(MeasuredCloud& measured, double scale, const std::string& path)
{
  if (!(scale > 0.0 && std::isfinite(scale)))
  {
    throw Error("The scale of '" + path + "' has to be a positive number: 1000 brings metres to mm.");
  }
  for (auto& point : measured.cloud.points)
  {
    point *= static_cast<float>(scale);
  }
  if (measured.T_cloud_sensor)
  {
    measured.T_cloud_sensor->translation() *= scale;
  }
}
}

Scan loadScan(const std::string& path, const std::string& cameraFile, double scale)
{
  MeasuredCloud measured = readCloud(path);
  scaleCloud(measured, scale, path);
  return scanOf(cameraFile.empty() ? std::move(measured) : organizeCloud(measured, readCamera(cameraFile).camera));
}

Scan scanOfDepths(const std::vector<float>& depths, int width, int height, const Camera& camera, double scale)
{
  OrganizedCloud cloud = cloudOfDepths(depths, width, height, camera, scale, "The depth image");
  Scan scan;
  scan.width = width;
  scan.height = height;
  scan.points = std::move(cloud.points);
  return scan;
}

Camera loadCamera(const std::string& path) { return readImageCamera(path); }
Camera loadDepthCamera(const std::string& path) { return readCamera(path).camera; }
double loadDepthScale(const std::string& path) { return readCamera(path).depthScale; }
}
