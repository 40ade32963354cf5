// SPDX-License-Identifier: BSD-3-Clause
#include "Readers.h"

#include "CheckSums.h"
#include "calibration/HandEyeFile.h"
#include "calibration/RobotFrameFile.h"
#include "io/BOPDataset.h"
#include "io/CameraFile.h"
#include "io/DepthImage.h"
#include "io/ImageFile.h"
#include "io/MeshFile.h"
#include "io/ModelsInfo.h"
#include "io/cloud/PCDFile.h"
#include "io/cloud/XYZFile.h"
#include "io/PLYFile.h"
#include "io/PoseFile.h"
#include "io/cad/CADFile.h"
#include "model/file/ModelFile.h"
#include "pick/io/GraspFile.h"
#include "scene/preparation/CloudOrganization.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace fuzz
{
namespace
{
namespace fs = std::filesystem;

/// What a reader promises of its result.
void require(bool good, const char* what)
{
  if (!good)
  {
    throw std::logic_error(what);
  }
}

/// Its size is that of no image.
meam::Camera smallCamera()
{
  meam::Camera camera;
  camera.fx = camera.fy = 10.0;
  camera.cx = 16.0;
  camera.cy = 12.0;
  return camera;
}

void readMesh(const std::string& path)
{
  const meam::TriangleMesh mesh = meam::readCAD(path).mesh;
  require(!mesh.triangles.empty(), "a mesh without triangles");
  const int most = static_cast<int>(mesh.vertices.size());
  for (const Eigen::Vector3i& triangle : mesh.triangles)
  {
    require(triangle.minCoeff() >= 0 && triangle.maxCoeff() < most, "a corner that does not exist");
  }
}

void requireArrays(const meam::MeasuredCloud& measured)
{
  const std::size_t points = measured.cloud.size();
  const auto fits = [&](std::size_t size, std::size_t each) { return size == 0 || size == each * points; };
  require(points > 0 && points == static_cast<std::size_t>(measured.cloud.width) * measured.cloud.height,
    "a cloud of another size than its grid");
  require(fits(measured.normals.size(), 1) && fits(measured.intensities.size(), 1) && fits(measured.colors.size(), 3),
    "an array of another length than the points");
  meam::greyValues(measured.intensities);
}

void readPCD(const std::string& path)
{
  const auto [width, height] = meam::readPCDSize(path);
  const meam::MeasuredCloud data = meam::readPCD(path);
  requireArrays(data);
  require(data.cloud.width == width && data.cloud.height == height, "another size than the header's");
}

/// A cloud that is not organized comes onto the pixels of a camera.
void organize(const meam::MeasuredCloud& measured)
{
  requireArrays(measured);
  meam::Camera camera = smallCamera();
  camera.width = 32;
  camera.height = 24;
  requireArrays(meam::organizeCloud(measured, camera));
}

void readPLYCloud(const std::string& path)
{
  meam::isPLYCloud(path);
  organize(meam::readPLYCloud(path));
}

void readXYZ(const std::string& path)
{
  const bool isXYZ = meam::isXYZ(path);
  const meam::MeasuredCloud measured = meam::readXYZ(path);
  require(isXYZ, "points in a file that does not begin with them");
  organize(measured);
}

void readCamera(const std::string& path) { require(meam::readCamera(path).camera.fx > 0.0, "no focal length"); }

void readDepth(const std::string& path)
{
  const meam::OrganizedCloud cloud = meam::readDepthImage(path, smallCamera());
  require(cloud.size() > 0 && cloud.size() == static_cast<std::size_t>(cloud.width) * cloud.height, "another size");
}

void readImage(const std::string& path)
{
  const auto [width, height] = meam::readImageSize(path);
  const meam::Image image = meam::readImage(path);
  require(image.width == width && image.height == height &&
            image.pixels.size() == static_cast<std::size_t>(image.width) * image.height * image.channels,
    "another size than the header's");
}

void readSceneCamera(const std::string& path) { require(!meam::listBOPImages(path).empty(), "no image"); }

/// The file is scene_gt.json and scene_gt_info.json at once.
void readTruth(const std::string& path)
{
  meam::BOPImage image;
  image.imageId = 2;
  image.folder = fs::path(path).parent_path().string();
  const fs::path info = fs::path(image.folder) / "scene_gt_info.json";
  std::error_code failure;
  fs::create_symlink(path, info, failure); // it may be there
  meam::readBOPTruth(image);
}

void readModelsInfo(const std::string& path) { meam::readModelsInfo(path, 1); }

void readModel(const std::string& path)
{
  const bool isModel = meam::isModel(path);
  const meam::TrainedModel model = meam::readModel(path);
  require(isModel, "a file of a model that does not start like one");
  require(std::max(model.table.votingPoints, model.surfaceTable.votingPoints) >= 0, "a table without votes");
}

void readPoses(const std::string& path) { meam::readPoses(path); }
void readGrasps(const std::string& path) { meam::readGrasps(path); }
void readRobotFrame(const std::string& path) { require(meam::readRobotFrame(path).matrix().allFinite(), "no frame"); }
void readHandEye(const std::string& path) { meam::readHandEye(path); }

// What a byte of a packed file may stand for: 88 in a PCD file, whose smallest points are three bytes and become 12 and
// more; pixels of an image, as readImage() has it, which are decoded into 8 bytes and converted.
constexpr std::size_t Unpacked = 500, Pixels = 4096 * 24;
// A byte of a text of points: a comma stands for a number, and two for a point, in arrays that grow twofold.
constexpr std::size_t Words = 60;
// What a byte of JSON may become: empty lists and objects are three bytes with their comma, and in memory a hundred.
constexpr std::size_t JSON = 40;
// MB of the distance fields of a trained model, however short its file is.
constexpr std::size_t Fields = 64;
// MB of Open CASCADE, which knows hundreds of kinds of entities, in a process of its own that each file gets.
constexpr std::size_t OpenCascade = 512;
constexpr int Processes = 20;
constexpr std::size_t Usual = Reader{}.timesLength, UsualMB = Reader{}.megabytes;
}

const std::vector<Reader>& readers()
{
  static const std::vector<Reader> all = {
    { "stl", "a.stl", readMesh },
    { "obj", "a.obj", readMesh },
    { "ply-mesh", "a.ply", readMesh },
    { "off", "a.off", readMesh },
    { "step", "a.step", readMesh, Usual, OpenCascade, nullptr, Processes },
    { "iges", "a.igs", readMesh, Usual, OpenCascade, nullptr, Processes },
    { "pcd", "a.pcd", readPCD, Unpacked },
    { "ply-cloud", "a.ply", readPLYCloud },
    { "xyz", "a.xyz", readXYZ, Words },
    { "camera", "camera.yaml", readCamera, JSON },
    { "depth-image", "depth.png", readDepth, Pixels, UsualMB, withPNGCheckSums },
    { "image", "image.png", readImage, Pixels, UsualMB, withPNGCheckSums },
    { "scene-camera", "scene_camera.json", readSceneCamera, JSON },
    { "truth", "scene_gt.json", readTruth, JSON },
    { "models-info", "models_info.json", readModelsInfo, JSON },
    { "model", "a.meam", readModel, Usual, Fields, withModelCheckSum },
    { "poses", "poses.txt", readPoses, JSON },
    { "grasps", "grasps.json", readGrasps, JSON },
    { "robot-frame", "robot.yaml", readRobotFrame, JSON },
    { "hand-eye", "pairs.json", readHandEye, JSON },
  };
  return all;
}

const Reader* readerOf(const std::string& name)
{
  const auto found = std::find_if(readers().begin(), readers().end(), [&](const Reader& r) { return r.name == name; });
  return found == readers().end() ? nullptr : &*found;
}
}
