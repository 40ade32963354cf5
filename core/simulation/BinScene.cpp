// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/BinScene.h"

#include "base/Frames.h"
#include "base/Range.h"
#include "mesh/ConvexHull.h"
#include "mesh/TriangleMesh.h"
#include "simulation/BinPhysics.h"
#include "simulation/Lighting.h"
#include "simulation/Rasterizer.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double SpacePerCopy = 0.75;  // side of the bin over diameter and root of the copies: about two layers
constexpr double LeastBinSize = 1.6;   // diameters
constexpr double WallHeight = 0.6;     // diameters
constexpr double WallThickness = 0.05; // diameters
constexpr double FilledView = 0.96;    // share of the image's shorter side
constexpr double Nearness = 0.1;       // diameters: what lies so much deeper than its surroundings is in their shade
const Eigen::Vector3d PartTint(1.02, 1.0, 0.96);
const Eigen::Vector3d WallAlbedo(0.42, 0.45, 0.50);
const Eigen::Vector3d FloorAlbedo(0.24, 0.25, 0.27);

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

/// Four walls around a rectangle, standing on z = 0.
std::vector<TriangleMesh> walls(const Eigen::Vector2d& size, double height, double thickness)
{
  const Eigen::Vector2d in = 0.5 * size;
  const Eigen::Vector2d out = in + Eigen::Vector2d::Constant(thickness);
  return { box({ -out.x(), -out.y(), 0 }, { out.x(), -in.y(), height }),
    box({ -out.x(), in.y(), 0 }, { out.x(), out.y(), height }),
    box({ -out.x(), -in.y(), 0 }, { -in.x(), in.y(), height }),
    box({ in.x(), -in.y(), 0 }, { out.x(), in.y(), height }) };
}

void check(const BinSceneSettings& settings)
{
  if (!std::all_of(
        settings.poses.begin(), settings.poses.end(), [](const Eigen::Isometry3d& T) { return isRigid(T.matrix()); }))
  {
    throw Error("A pose that a copy shall stand at is not a rotation and a translation.");
  }
  requireWithin("number of copies in the bin", settings.copies, 1, 10000);
  requireWithin("width of the sensor's image", settings.width, 16, 8192, " pixels");
  requireWithin("height of the sensor's image", settings.height, 16, 8192, " pixels");
  requireWithin("size of the bin", settings.binSize, 0.0, Unbounded, " mm");
  requireWithin("width of the bin", settings.binWidth, 0.0, Unbounded, " mm");
  requireWithin("height of the bin's walls", settings.wallHeight, 0.0, Unbounded, " mm");
  requireWithin("height of the sensor", settings.sensorHeight, 0.0, Unbounded, " mm");
  requireWithin("baseline of the sensor", settings.baseline, 0.0, Unbounded, " mm");
  requireQuality(settings.quality);
}

/// A camera of a size in pixels whose image a rectangle fills, `distance` mm away.
Camera cameraFor(int width, int height, const Eigen::Vector2d& size, double distance)
{
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = std::min(FilledView * width * distance / size.x(), FilledView * height * distance / size.y());
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

/// The camera `baseline` mm to the right of the sensor, turned to the middle of the floor.
Camera cameraBeside(const Camera& sensor, double baseline, double floor)
{
  Camera camera = sensor;
  camera.fx = camera.fy = sensor.fx * std::hypot(floor, baseline) / floor;
  Eigen::Isometry3d T_scene_camera = Eigen::Isometry3d::Identity();
  T_scene_camera.translation().x() = baseline;
  T_scene_camera.linear() = Eigen::AngleAxisd(-std::atan2(baseline, floor), Eigen::Vector3d::UnitY()).matrix();
  camera.T_camera_scene = T_scene_camera.inverse();
  return camera;
}
}

BinSceneSettings binSettings(SensorKind kind)
{
  BinSceneSettings settings;
  settings.quality = sensorQuality(kind);
  if (kind == SensorKind::ActiveStereo)
  {
    settings.width = 1280;
    settings.height = 720;
  }
  else if (kind == SensorKind::TimeOfFlight)
  {
    settings.width = 640;
    settings.height = 480;
  }
  return settings;
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
  const std::size_t copies = settings.poses.empty() ? settings.copies : settings.poses.size();
  BinScene scene;
  scene.binSize = settings.binSize > 0.0
                    ? settings.binSize
                    : partDiameter * std::max(LeastBinSize, SpacePerCopy * std::sqrt(static_cast<double>(copies)));
  const Eigen::Vector2d size(scene.binSize, settings.binWidth > 0.0 ? settings.binWidth : scene.binSize);
  if (size.maxCoeff() > 100.0 * partDiameter)
  {
    throw Error("The bin is more than a hundred times larger than the part: check their units.");
  }
  const double sensorHeight = settings.sensorHeight > 0.0 ? settings.sensorHeight : 3.0 * size.maxCoeff();
  const double wallHeight = settings.wallHeight > 0.0 ? settings.wallHeight : WallHeight * partDiameter;
  const double wallThickness = WallThickness * partDiameter;
  Random random(settings.seed);
  // The sensor's z looks down, its x along the bin's x.
  Eigen::Isometry3d T_scene_bin = Eigen::Isometry3d::Identity();
  T_scene_bin.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  T_scene_bin.translation().z() = sensorHeight;
  scene.bin = { T_scene_bin, { size.x(), size.y(), wallHeight }, wallThickness };
  std::vector<Eigen::Isometry3d> poses = settings.poses;
  if (poses.empty() || settings.settle)
  {
    const Progress falling = subProgress(progress, 0.0, 0.6);
    std::transform(poses.begin(), poses.end(), poses.begin(),
      [&](const Eigen::Isometry3d& pose) { return T_scene_bin.inverse() * pose; });
    const FilledBin bin =
      poses.empty() ? fillBin(part, size, settings.copies, random, falling) : settleBin(part, size, poses, falling);
    poses = bin.poses;
    std::transform(
      poses.begin(), poses.end(), poses.begin(), [&](const Eigen::Isometry3d& pose) { return T_scene_bin * pose; });
  }
  if (sensorHeight <= wallHeight)
  {
    throw Error("The sensor is not above the bin: raise it.");
  }
  std::vector<Body> bodies;
  for (const auto& pose : poses)
  {
    const double brightness = random.uniform(0.72, 0.88);
    bodies.push_back({ &part, pose, brightness * PartTint });
  }
  const std::vector<TriangleMesh> sides = walls(size, wallHeight, wallThickness);
  for (const auto& side : sides)
  {
    bodies.push_back({ &side, T_scene_bin, WallAlbedo });
  }
  const std::vector<Facet> facets = facetsOf(bodies);
  scene.sensor = cameraFor(
    settings.width, settings.height, size + Eigen::Vector2d::Constant(2.0 * wallThickness), sensorHeight - wallHeight);
  scene.camera = settings.baseline > 0.0 ? cameraBeside(scene.sensor, settings.baseline, sensorHeight) : scene.sensor;

  const View view = rasterize(facets, sensorHeight, scene.sensor);
  report(progress, 0.65);
  const auto lightOf = [&](const View& seen)
  {
    return illuminate(
      seen, scene.camera, facets, bodies, FloorAlbedo, Nearness * partDiameter, subProgress(progress, 0.65, 0.85));
  };
  const std::vector<Eigen::Vector3f> colors =
    settings.baseline > 0.0 ? lightOf(rasterize(facets, sensorHeight, scene.camera)) : lightOf(view);
  scene.image = takeImage(colors, scene.camera, settings.colored, settings.quality, random);
  scene.cloud = measureDepth(view, scene.sensor, settings.quality, random, subProgress(progress, 0.85, 0.95));

  const int count = static_cast<int>(copies);
  std::vector<Mask> silhouettes = silhouettesOf(facets, count, scene.sensor);
  for (int i = 0; i < count; ++i)
  {
    scene.instances.push_back({ bodies[i].T_scene_model, std::move(silhouettes[i]), 0 });
  }
  scene.instanceOfPixel = view.bodies;
  for (int& body : scene.instanceOfPixel)
  {
    body = body < count ? body : -1;
    scene.instances[std::max(body, 0)].visiblePixels += body >= 0;
  }
  report(progress, 1.0);
  return scene;
}
}
