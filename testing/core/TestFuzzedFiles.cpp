// SPDX-License-Identifier: BSD-3-Clause
// Damaged files: every reader ends with a result or with a meam::Error. Under the sanitizers also without a
// wrong access and without a block of memory that is larger than files this small can justify.
#include "TestFiles.h"
#include "TestImages.h"
#include "calibration/HandEyeFile.h"
#include "calibration/RobotFrameFile.h"
#include "io/BOPDataset.h"
#include "io/CameraFile.h"
#include "io/DepthImage.h"
#include "io/ImageFile.h"
#include "io/MeshFile.h"
#include "io/ModelsInfo.h"
#include "io/OFFFile.h"
#include "io/PCDFile.h"
#include "io/PLYFile.h"
#include "io/PoseFile.h"
#include "model/ModelFile.h"
#include "pick/io/GraspFile.h"

#include <liblzf/lzf.h>

#include <fstream>
#include <functional>
#include <random>

#if defined(__SANITIZE_ADDRESS__)
extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=64"; }
#endif

namespace
{
/// Damages files as disks, networks and other programs do. The same every time.
class Damage
{
public:
  std::string operator()(std::string bytes)
  {
    for (int times = 1 + this->upTo(3); times > 0; --times)
    {
      this->once(bytes);
    }
    return bytes;
  }

  /// A whole number from 0 to `most`.
  std::size_t upTo(std::size_t most) { return this->Random() % (most + 1); }

private:
  void once(std::string& bytes)
  {
    const std::size_t at = this->upTo(bytes.size());
    const std::size_t length = std::min(this->upTo(20), bytes.size() - at);
    switch (this->upTo(7))
    {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(this->upTo(bytes.size()), length));
        break;
      case 3:
        bytes.insert(at, 1, static_cast<char>(this->upTo(255)));
        break;
      case 4:
        if (at + 4 <= bytes.size())
        {
          bytes.replace(at, 4, files::raw(this->oneOf<std::uint32_t>({ 0, 1, 255, 65536, 0x7fffffff, 0xffffffff })));
        }
        break;
      case 5:
        this->replaceNumber(bytes, at);
        break;
      default:
        if (at < bytes.size())
        {
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << this->upTo(7)));
        }
    }
  }

  /// The next number of a text becomes an absurd one.
  void replaceNumber(std::string& bytes, std::size_t at)
  {
    constexpr const char* digits = "0123456789.";
    const std::size_t first = bytes.find_first_of(digits, at);
    if (first != std::string::npos)
    {
      const std::size_t end = std::min(bytes.find_first_not_of(digits, first), bytes.size());
      bytes.replace(first, end - first,
        this->oneOf<const char*>({ "0", "-1", "1e999", "nan", "65536", "2147483647", "4294967295",
          "18446744073709551615", "99999999999999999999", "", "\"a\"", "[", "1e-300" }));
    }
  }

  template <typename T>
  T oneOf(std::initializer_list<T> values)
  {
    return *(values.begin() + this->upTo(values.size() - 1));
  }

  std::mt19937 Random{ 5489 };
};

/// The parameter is how many files a reader gets.
class FuzzedFiles : public testing::TestWithParam<int>
{
};

/// Reads damaged copies of the files, which all have the same name. `mend` repairs what would hide the damage.
template <typename Read>
void fuzz(const std::string& path, const std::vector<std::string>& whole, Read&& read,
  const std::function<std::string(std::string)>& mend = {})
{
  const int cases = FuzzedFiles::GetParam();
  Damage damage;
  int readable = 0;
  for (int i = 0; i < cases; ++i)
  {
    std::string bytes = damage(whole[i % whole.size()]);
    bytes = mend && i % 4 != 0 ? mend(bytes) : bytes;
    std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    try
    {
      read(path);
      ++readable;
    }
    catch (const meam::Error& error)
    {
      EXPECT_STRNE(error.what(), "");
    }
  }
  EXPECT_GT(readable, 0) << "all files were refused: the damage is too large, or the whole file is bad";
  EXPECT_LT(readable, cases) << "no file was refused";
}

/// Where files are written: in memory, where that can be.
std::string place() { return std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : testing::TempDir(); }

std::string pcd(const std::string& encoding, const std::string& data)
{
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z intensity rgb\nSIZE 4 4 4 4 4\nTYPE F F F F U\nCOUNT 1 1 1 1 1\n"
         "WIDTH 3\nHEIGHT 2\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 6\nDATA " +
         encoding + "\n" + data;
}

std::string ply(const std::string& format, const std::string& data)
{
  return "ply\nformat " + format +
         " 1.0\nelement face 2\nproperty list uchar int vertex_indices\nelement vertex 3\n"
         "property float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
         "property uchar blue\nproperty float intensity\nend_header\n" +
         data;
}

/// CRC-32, as PNG and our own files have it.
std::uint32_t checksum(std::string_view bytes)
{
  std::uint32_t sum = 0xffffffff;
  for (const char byte : bytes)
  {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit)
    {
      sum = sum >> 1 ^ (sum & 1 ? 0xedb88320 : 0);
    }
  }
  return ~sum;
}

/// Gives a trained model's file its right check sum again.
std::string withChecksum(std::string bytes)
{
  constexpr std::size_t start = 12; // signature and version
  if (bytes.size() >= start + 4)
  {
    const std::size_t end = bytes.size() - 4;
    bytes.replace(end, 4, files::raw(checksum(std::string_view(bytes).substr(start, end - start))));
  }
  return bytes;
}

/// Eight edge points of a part of 10 mm, all close to each other, and two pairs of them.
meam::TrainedModel smallModel()
{
  meam::TrainedModel model;
  model.diameter = 10.0;
  model.digest = "0123";
  model.settings.distanceStep = 1.0;
  model.settings.angleStep = 90.0;
  model.viewDirections = { Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX() };
  for (int i = 0; i < 8; ++i)
  {
    const Eigen::Vector3f point(0.1f * (i & 1), 0.1f * (i >> 1 & 1), 0.1f * (i >> 2));
    model.edges.points.push_back(point);
    model.edges.tangents.push_back(Eigen::Vector3f::UnitY());
    model.edgeViews.push_back(1 + i % 3);
    model.edgeVisible.push_back(3);
    model.surface.points.push_back(point);
    model.surface.normals.push_back(Eigen::Vector3f::UnitZ());
  }
  model.symmetries.discrete = { Eigen::Isometry3d::Identity() };
  model.symmetries.continuous = { { Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero() } };
  model.symmetries.near = { { Eigen::Isometry3d::Identity(), 0.9, 0.1 } };
  model.table.offsets.assign(static_cast<std::size_t>(model.quantizer().numberOfKeys()) + 1, 2);
  model.table.offsets.front() = 0;
  model.table.references = { 0, 1 };
  model.table.referreds = { 7, 6 };
  model.table.angles = { 0.5f, -0.5f };
  model.table.viewBits = { 1, 2 };
  model.settings.surface = { 1.0, 90.0, 0.5 };
  model.surfacePairPoints = model.surface;
  model.surfaceTable = model.table;
  model.surfaceTable.offsets.assign(static_cast<std::size_t>(model.surfaceQuantizer().numberOfKeys()) + 1, 2);
  model.surfaceTable.offsets.front() = 0;
  return model;
}

/// Gives every chunk of a PNG file its right check sum again, as far as chunks can be told apart.
std::string withChecksums(std::string png)
{
  const auto byteAt = [&](std::size_t at) { return static_cast<unsigned char>(png[at]); };
  for (std::size_t at = 8; at + 12 <= png.size();)
  {
    const std::size_t length =
      std::size_t(byteAt(at)) << 24 | byteAt(at + 1) << 16 | byteAt(at + 2) << 8 | byteAt(at + 3);
    if (length > png.size() - at - 12)
    {
      break;
    }
    const std::uint32_t sum = checksum(std::string_view(png).substr(at + 4, 4 + length));
    for (int i = 0; i < 4; ++i)
    {
      png[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    }
    at += 12 + length;
  }
  return png;
}

cv::Mat gradient(int type)
{
  cv::Mat pixels(12, 16, type);
  for (std::size_t i = 0; i < pixels.total() * pixels.elemSize(); ++i)
  {
    pixels.data[i] = static_cast<unsigned char>(37 * i % 251);
  }
  return pixels;
}

const char* const camera = R"({ "camera_matrix": { "rows": 3, "cols": 3, "dt": "d",
  "data": [ 800.0, 0.0, 320.0, 0.0, 801.0, 240.0, 0.0, 0.0, 1.0 ] }, "dist_coeffs": [ 0.1, 0, 0, 0, 0 ],
  "image_width": 640, "image_height": 480, "T_camera_scene": [[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]] })";
const char* const cameraOfBOP =
  R"({"cx": 325.26, "cy": 242.05, "depth_scale": 0.1, "fx": 572.41, "fy": 573.57, "height": 480, "width": 640})";
const char* const cameraYAML =
  "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n"
  "   dt: d\n   data: [ 800., 0., 320., 0., 801., 240., 0., 0., 1. ]\ndist_coeffs: !!opencv-matrix\n   rows: 1\n"
  "   cols: 5\n   dt: d\n   data: [ 0.1, 0., 0., 0., 0. ]\nname: \"left\"\nnested: { a: 1, b: [ 2, 3 ] }\n";
const char* const cameraXML =
  "<?xml version=\"1.0\"?>\n<opencv_storage>\n<camera_matrix type_id=\"opencv-matrix\">\n  <rows>3</rows>\n"
  "  <cols>3</cols>\n  <dt>d</dt>\n  <data>\n    800. 0. 320. 0. 801. 240. 0. 0. 1.</data></camera_matrix>\n"
  "<!-- a comment -->\n<image_width>640</image_width>\n<name>\"left\"</name>\n</opencv_storage>\n";
const char* const sceneCamera = R"({ "2": { "cam_K": [100, 0, 1, 0, 200, 0.5, 0, 0, 1], "depth_scale": 0.1 },
  "10": { "cam_K": [100, 0, 1, 0, 200, 0.5, 0, 0, 1] } })";
const char* const sceneTruth = R"({ "2": [
  { "obj_id": 5, "cam_R_m2c": [0, -1, 0, 1, 0, 0, 0, 0, 1], "cam_t_m2c": [1, 2, 300] },
  { "obj_id": 6, "cam_R_m2c": [1, 0, 0, 0, 1, 0, 0, 0, 1], "cam_t_m2c": [0, 0, 400] } ] })";
const char* const sceneTruthInfo = R"({ "2": [ { "visib_fract": 0.75 }, { "visib_fract": 0 } ] })";
const char* const modelsInfo =
  R"({ "1": { "diameter": 50, "symmetries_discrete": [[1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,0,1]],
  "symmetries_continuous": [{ "axis": [0, 0, 1], "offset": [0, 0, 0] }] } })";
}

INSTANTIATE_TEST_SUITE_P(Quick, FuzzedFiles, testing::Values(2000));
INSTANTIATE_TEST_SUITE_P(Long, FuzzedFiles, testing::Values(30000));

TEST_P(FuzzedFiles, pcd)
{
  const files::Folder folder(place());
  const std::string columns(120, '\x3f');
  std::string packed(200, '\0');
  packed.resize(lzf_compress(columns.data(), 120, packed.data(), 200));
  ASSERT_GT(packed.size(), 0u);
  const std::string sizes = files::raw<std::uint32_t>(packed.size()) + files::raw<std::uint32_t>(120);
  std::string rows;
  for (int i = 0; i < 6; ++i)
  {
    rows += "1.5 -2 nan 3e2 1056816\n";
  }
  fuzz(folder.path("a.pcd"), { pcd("ascii", rows), pcd("binary", columns), pcd("binary_compressed", sizes + packed) },
    [](const std::string& path)
    {
      const meam::PCDData data = meam::readPCD(path);
      EXPECT_EQ(data.cloud.size(), static_cast<std::size_t>(data.cloud.width) * data.cloud.height);
    });
}

TEST_P(FuzzedFiles, ply)
{
  const files::Folder folder(place());
  const std::string faces = "\x03" + std::string(12, '\1') + "\x04" + std::string(16, '\2');
  const std::string vertices(57, '\x3f');
  const std::string ascii = "3 0 1 2\n4 0 1 2 0\n1 2 3 4 5 6 0.5\n1 2 3 4 5 6 7\nnan -2 3 4 5 6 7\n";
  fuzz(folder.path("a.ply"),
    { ply("ascii", ascii), ply("binary_little_endian", faces + vertices), ply("binary_big_endian", faces + vertices) },
    [](const std::string& path)
    {
      meam::isPLYCloud(path);
      EXPECT_EQ(meam::readPLYCloud(path).cloud.height, 1);
    });
}

TEST_P(FuzzedFiles, off)
{
  const files::Folder folder(place());
  fuzz(folder.path("a.off"),
    { "OFF\n# a comment\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n",
      "COFF 3 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1e3 0 0 0 255\n3 0 1 2 1 0 0\n" },
    [](const std::string& path)
    {
      for (const Eigen::Vector3i& triangle : meam::readOFF(path).triangles)
      {
        EXPECT_GE(triangle.minCoeff(), 0);
      }
    });
}

TEST_P(FuzzedFiles, poses)
{
  const files::Folder folder(place());
  fuzz(folder.path("a.txt"),
    { "# poses\n0 -1 0 1.5\n1 0 0 -2\n0 0 1 +1e-1\n0 0 0 1\n\n1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1" },
    [](const std::string& path) { meam::readPoses(path); });
  fuzz(folder.path("a.csv"),
    { "scene_id,im_id,obj_id,score,R,t,time\n3,7,2,0.75,0 -1 0 1 0 0 0 0 1,0.1 -2.5 3e-1,0.5\n",
      "scene_id,im_id,obj_id,score,R,t,time\n" },
    [](const std::string& path) { meam::readPoses(path); });
  fuzz(folder.path("a.json"),
    { R"({"poses": [{"rank": 1, "obj_id": 2, "score": 0.5, "matrix": [[1,0,0,4],[0,1,0,5],[0,0,1,6],[0,0,0,1]]}]})" },
    [](const std::string& path) { meam::readPoses(path); });
}

TEST_P(FuzzedFiles, grasps)
{
  const files::Folder folder(place());
  fuzz(folder.path("a.json"), { R"({"format": "meam-grasps", "version": 1, "units": "mm", "grasps": [
         {"name": "a", "kind": "parallel", "position": [1,2,3], "approach": [0,0,1], "closing": [1,0,0], "width": 20},
         {"kind": "suction", "position": [1,2,3], "approach": [0,0,1], "free_turn": "approach", "quality": 0.5}]})" },
    [](const std::string& path) { meam::readGrasps(path); });
}

TEST_P(FuzzedFiles, robotFrame)
{
  const files::Folder folder(place());
  fuzz(folder.path("a.yaml"),
    { "transforms:\n- header:\n    frame_id: base\n  transform:\n    translation:\n      x: 0.1\n      y: 0.2\n      "
      "z: 0.3\n"
      "    rotation:\n      x: 0.0\n      y: 0.0\n      z: 0.0\n      w: 1.0\n",
      R"({"units": "m", "T_robot_camera": [[1,0,0,4],[0,1,0,5],[0,0,1,6],[0,0,0,1]]})",
      "%YAML:1.0\n---\nT_robot_camera: !!opencv-matrix\n   rows: 4\n   data: [ 1,0,0,4,0,1,0,5,0,0,1,6,0,0,0,1 ]\n" },
    [](const std::string& path) { meam::readRobotFrame(path); });
  fuzz(folder.path("a.json"),
    { R"({"mount": "hand", "pairs": [{"T_base_gripper": [[1,0,0,4],[0,1,0,5],[0,0,1,6],[0,0,0,1]],
          "T_camera_target": [[1,0,0,4],[0,1,0,5],[0,0,1,6],[0,0,0,1]]}]})",
      "1,0,0,4,0,1,0,5,0,0,1,6,0,0,0,1,1,0,0,4,0,1,0,5,0,0,1,6,0,0,0,1\n" },
    [](const std::string& path) { meam::readHandEye(path); });
}

TEST_P(FuzzedFiles, cameraInJSON)
{
  const files::Folder folder(place());
  fuzz(folder.path("camera.json"), { camera, cameraOfBOP },
    [](const std::string& path) { EXPECT_GT(meam::readCamera(path).camera.fx, 0.0); });
}

TEST_P(FuzzedFiles, cameraInYAMLAndXML)
{
  const files::Folder folder(place());
  fuzz(folder.path("camera.yaml"), { cameraYAML, cameraXML },
    [](const std::string& path) { EXPECT_GT(meam::readCamera(path).camera.fx, 0.0); });
}

TEST_P(FuzzedFiles, depthImage)
{
  const files::Folder folder(place());
  meam::Camera camera;
  camera.fx = camera.fy = 100.0;
  fuzz(
    folder.path("depth.png"), { images::encoded(".png", gradient(CV_16UC1)) },
    [&](const std::string& path) { EXPECT_GT(meam::readDepthImage(path, camera).size(), 0u); }, withChecksums);
}

TEST_P(FuzzedFiles, image)
{
  const files::Folder folder(place());
  std::vector<std::string> whole;
  for (const char* form : { ".png", ".jpg", ".bmp", ".tiff" })
  {
    whole.push_back(images::encoded(form, gradient(CV_8UC1)));
    whole.push_back(images::encoded(form, gradient(CV_8UC3)));
  }
  fuzz(folder.path("image.png"), whole,
    [](const std::string& path)
    {
      const meam::Image image = meam::readImage(path);
      EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) * image.height * image.channels);
    });
}

TEST_P(FuzzedFiles, sceneCameraOfBOP)
{
  const files::Folder folder(place());
  fuzz(folder.path("scene_camera.json"), { sceneCamera },
    [](const std::string& path) { EXPECT_FALSE(meam::listBOPImages(path).empty()); });
}

TEST_P(FuzzedFiles, truthOfBOP)
{
  const files::Folder folder(place());
  meam::BOPImage image;
  image.imageId = 2;
  image.folder = folder.path();
  const auto read = [&](const std::string&) { meam::readBOPTruth(image); };
  fuzz(folder.path("scene_gt.json"), { sceneTruth }, read);
  folder.write("scene_gt.json", sceneTruth);
  fuzz(folder.path("scene_gt_info.json"), { sceneTruthInfo }, read);
}

TEST_P(FuzzedFiles, modelsInfo)
{
  const files::Folder folder(place());
  fuzz(folder.path("models_info.json"), { modelsInfo }, [](const std::string& path) { meam::readModelsInfo(path, 1); });
}

TEST_P(FuzzedFiles, trainedModel)
{
  const files::Folder folder(place());
  const std::string path = folder.path("a.meam");
  meam::writeModel(path, smallModel());
  fuzz(
    path, { meam::readFile(path) },
    [](const std::string& file) { EXPECT_GT(meam::readModel(file).table.votingPoints, 0); }, withChecksum);
}

TEST_P(FuzzedFiles, mesh)
{
  const files::Folder folder(place());
  const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1e0 0\nendloop\nendfacet\n";
  const std::string corners(36, '\x3f');
  const auto read = [](const std::string& path) { EXPECT_FALSE(meam::readMesh(path).triangles.empty()); };
  fuzz(folder.path("a.stl"),
    { "solid part\n" + facet + facet + "endsolid part\n",
      std::string(80, ' ') + files::raw<std::uint32_t>(2) + std::string(12, '\0') + corners + "  " +
        std::string(12, '\0') + std::string(9, '\0') + std::string(27, '\x3e') + "  " },
    read);
  fuzz(folder.path("a.obj"),
    { "# a part\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\nf -4 -3 -2 -1\n" }, read);
  const std::string header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                             "property list uchar int vertex_indices\nend_header\n";
  fuzz(folder.path("a.ply"),
    { "ply\nformat ascii 1.0\n" + header + "0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n",
      "ply\nformat binary_little_endian 1.0\n" + header + std::string(12, '\0') + corners.substr(0, 24) + "\3" +
        files::raw(0) + files::raw(1) + files::raw(2) },
    read);
}
