// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/BinScene.h"

#include "mesh/ConvexHull.h"
#include "mesh/RequireMesh.h"
#include "simulation/BinPacking.h"
#include "simulation/VirtualSensor.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double SpacePerCopy = 0.75;  // side of the bin over diameter and root of the copies: about two layers
constexpr double LeastBinSize = 1.6;   // diameters
constexpr double WallHeight = 0.35;    // diameters
constexpr double WallThickness = 0.05; // diameters
constexpr double FilledView = 0.96;    // share of the image's shorter side

TriangleMesh box(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.vertices.push_back(
      Eigen::Vector3d((i & 1) ? high.x() : low.x(), (i & 2) ? high.y() : low.y(), (i & 4) ? high.z() : low.z())
        .cast<float>());
  }
  mesh.triangles = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 }, { 2, 6, 3 },
    { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  return mesh;
}

/// Four walls around a square of side `size`, standing on z = 0.
std::vector<TriangleMesh> walls(double size, double height, double thickness)
{
  const double in = 0.5 * size;
  const double out = in + thickness;
  return { box({ -out, -out, 0 }, { out, -in, height }), box({ -out, in, 0 }, { out, out, height }),
    box({ -out, -in, 0 }, { -in, in, height }), box({ in, -in, 0 }, { out, in, height }) };
}

void check(const BinSceneSettings& settings)
{
  const auto valid = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (settings.copies < 1 || settings.copies > 10000)
  {
    throw Error("The number of copies in the bin must be 1 to 10000.");
  }
  if (settings.width < 16 || settings.height < 16 || settings.width > 8192 || settings.height > 8192)
  {
    throw Error("The sensor's image must be 16 to 8192 pixels wide and high.");
  }
  if (!valid(settings.binSize) || !valid(settings.sensorHeight) || !valid(settings.depthNoise) ||
      !valid(settings.imageNoise) || !(settings.dropout >= 0.0 && settings.dropout <= 1.0))
  {
    throw Error("Sizes and noise of the simulated bin must be 0 or more, and the dropout a share "
                "from 0 to 1.");
  }
}
}

BinScene simulateBin(const TriangleMesh& part, const BinSceneSettings& settings, const Progress& progress)
{
  requireMesh(part);
  check(settings);
  const double partDiameter = diameter(part.vertices);
  if (!(partDiameter > 0.0))
  {
    throw Error("The part has no size: all vertices of its mesh are at one place.");
  }
  BinScene scene;
  scene.binSize =
    settings.binSize > 0.0
      ? settings.binSize
      : partDiameter * std::max(LeastBinSize, SpacePerCopy * std::sqrt(static_cast<double>(settings.copies)));
  if (scene.binSize > 100.0 * partDiameter)
  {
    throw Error("The bin is more than a hundred times larger than the part: check their units.");
  }
  Random random(settings.seed);
  const std::vector<Eigen::Isometry3d> poses =
    packBin(part, scene.binSize, settings.copies, random, subProgress(progress, 0.0, 0.6));

  // The sensor's z looks down, its x along the bin's x.
  const double sensorHeight = settings.sensorHeight > 0.0 ? settings.sensorHeight : 3.0 * scene.binSize;
  Eigen::Isometry3d T_scene_bin = Eigen::Isometry3d::Identity();
  T_scene_bin.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  T_scene_bin.translation().z() = sensorHeight;
  std::vector<Body> bodies;
  for (const auto& pose : poses)
  {
    bodies.push_back({ &part, T_scene_bin * pose, random.uniform(0.72, 0.88) });
  }
  const double wallHeight = WallHeight * partDiameter;
  const double wallThickness = WallThickness * partDiameter;
  const std::vector<TriangleMesh> sides = walls(scene.binSize, wallHeight, wallThickness);
  for (const auto& side : sides)
  {
    bodies.push_back({ &side, T_scene_bin, 0.45 });
  }

  VirtualSensorSettings sensor;
  sensor.width = settings.width;
  sensor.height = settings.height;
  sensor.floor = sensorHeight;
  sensor.focalLength = FilledView * std::min(settings.width, settings.height) * (sensorHeight - wallHeight) /
                       (scene.binSize + 2.0 * wallThickness);
  sensor.nearness = 0.1 * partDiameter;
  sensor.depthNoise = settings.depthNoise;
  sensor.dropout = settings.dropout;
  sensor.imageNoise = settings.imageNoise;
  SensorData data = renderBodies(bodies, sensor, random, subProgress(progress, 0.6, 1.0));

  const int copies = static_cast<int>(poses.size());
  for (int i = 0; i < copies; ++i)
  {
    const int alone = data.alonePixels[i];
    scene.instances.push_back(
      { bodies[i].T_scene_model, alone > 0 ? static_cast<double>(data.visiblePixels[i]) / alone : 0.0 });
  }
  for (int& body : data.bodyOfPixel)
  {
    body = body < copies ? body : -1;
  }
  scene.cloud = std::move(data.cloud);
  scene.image = std::move(data.image);
  scene.instanceOfPixel = std::move(data.bodyOfPixel);
  scene.focalLength = sensor.focalLength;
  return scene;
}
}
