// SPDX-License-Identifier: BSD-3-Clause
#include "io/BOPDataset.h"

#include "base/Frames.h"
#include "io/DepthImage.h"
#include "io/ImageFile.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/JSONFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <initializer_list>

namespace meam
{
namespace fs = std::filesystem;

namespace
{

[[noreturn]] void failBOP(const std::string& path, const std::string& what)
{
  throw Error("The BOP file '" + path + "' " + what + ".");
}

/// `count` numbers under a name. Fails without them.
std::vector<double> numbersUnder(
  const nlohmann::json& object, const char* name, std::size_t count, const std::string& path)
{
  std::vector<double> numbers;
  if (object.is_object() && object.contains(name))
  {
    numbers = numbersOf(object[name], path, name);
  }
  if (numbers.size() != count)
  {
    failBOP(
      path, "has " + std::to_string(numbers.size()) + " numbers as " + name + " instead of " + std::to_string(count));
  }
  return numbers;
}

/// The JSON object in a file.
nlohmann::json objectIn(const std::string& path)
{
  nlohmann::json object = parseJSON(path, readFile(path));
  if (!object.is_object())
  {
    failBOP(path, "is not a JSON object of images");
  }
  return object;
}

/// What a file says of an image as a list; empty when there is neither.
nlohmann::json listOf(const BOPImage& image, const std::string& path)
{
  nlohmann::json list = nlohmann::json::array();
  std::error_code failure;
  if (fs::exists(path, failure))
  {
    const nlohmann::json images = objectIn(path);
    const auto found = images.find(std::to_string(image.imageId));
    list = found == images.end() ? list : *found;
  }
  if (!list.is_array())
  {
    failBOP(path, "has no list of objects for image " + std::to_string(image.imageId));
  }
  return list;
}

/// The number in a folder's name, such as 000012; -1 for another name.
int numberOf(const std::string& name)
{
  int number = -1;
  const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), number);
  return failure == std::errc() && end == name.data() + name.size() ? number : -1;
}

bool isScene(const fs::path& folder)
{
  std::error_code failure;
  return fs::is_regular_file(folder / "scene_camera.json", failure);
}

/// The scenes in the folder of a split, by number.
std::vector<std::pair<int, fs::path>> scenesIn(const fs::path& folder)
{
  std::vector<std::pair<int, fs::path>> scenes;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure))
  {
    const int number = numberOf(entry.path().filename().string());
    if (number >= 0 && isScene(entry.path()))
    {
      scenes.emplace_back(number, entry.path());
    }
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

void appendImages(int sceneId, const fs::path& folder, std::vector<BOPImage>& images)
{
  const std::string path = (folder / "scene_camera.json").string();
  const std::size_t first = images.size();
  const nlohmann::json entries = objectIn(path);
  for (const auto& [key, entry] : entries.items())
  {
    BOPImage image;
    image.sceneId = sceneId;
    image.imageId = idOf(key, path);
    image.folder = folder.string();
    const std::vector<double> K = numbersUnder(entry, "cam_K", 9, path);
    image.camera.fx = K[0];
    image.camera.cx = K[2];
    image.camera.fy = K[4];
    image.camera.cy = K[5];
    image.depthScale = entry.contains("depth_scale") ? numbersUnder(entry, "depth_scale", 1, path)[0] : 1.0;
    if (!(image.camera.fx > 0.0 && image.camera.fy > 0.0 && image.depthScale > 0.0))
    {
      failBOP(path, "has a focal length or a depth scale that is not positive for image " + key.substr(0, 40));
    }
    images.push_back(image);
  }
  std::sort(images.begin() + static_cast<std::ptrdiff_t>(first), images.end(),
    [](const BOPImage& a, const BOPImage& b) { return a.imageId < b.imageId; });
}

/// The first file of the image that is there; empty without.
std::string fileOf(
  const BOPImage& image, std::initializer_list<const char*> folders, std::initializer_list<const char*> extensions)
{
  char stem[16];
  std::snprintf(stem, sizeof(stem), "%06d", image.imageId);
  std::error_code failure;
  for (const char* folder : folders)
  {
    for (const char* extension : extensions)
    {
      const fs::path path = fs::path(image.folder) / folder / (std::string(stem) + extension);
      if (fs::exists(path, failure))
      {
        return path.string();
      }
    }
  }
  return {};
}

std::string depthFileOf(const BOPImage& image)
{
  std::string path = fileOf(image, { "depth" }, { ".png", ".tif", ".tiff", ".pgm", ".pfm" });
  if (path.empty())
  {
    throw Error("The scene '" + image.folder + "' has no depth image number " + std::to_string(image.imageId) +
                ": the folder depth or the file in it is missing.");
  }
  return path;
}

Eigen::Isometry3d poseOf(const nlohmann::json& entry, const std::string& path)
{
  const std::vector<double> R = numbersUnder(entry, "cam_R_m2c", 9, path);
  const std::vector<double> t = numbersUnder(entry, "cam_t_m2c", 3, path);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.data());
  pose.translation() = Eigen::Map<const Eigen::Vector3d>(t.data());
  const std::optional<Eigen::Isometry3d> rigid = rigidOf(pose.matrix());
  if (!rigid)
  {
    failBOP(path, "has a cam_R_m2c that is not a rotation");
  }
  return *rigid;
}
}

std::vector<BOPImage> listBOPImages(const std::string& path, const std::string& split)
{
  std::error_code failure;
  fs::path folder = fs::absolute(path, failure);
  folder = fs::is_regular_file(folder, failure) || !folder.has_filename() ? folder.parent_path() : folder;
  std::vector<std::pair<int, fs::path>> scenes;
  if (isScene(folder))
  {
    scenes = { { std::max(numberOf(folder.filename().string()), 0), folder } };
  }
  for (const fs::path& place : { folder, folder / split })
  {
    scenes = scenes.empty() ? scenesIn(place) : scenes;
  }
  if (scenes.empty())
  {
    throw Error(
      "There is no scene in '" + path + "' nor in its folder '" + split +
      "': the folder of a BOP dataset is expected, with the name of a split in it, or of one of its splits or scenes.");
  }
  std::vector<BOPImage> images;
  for (const auto& [number, scene] : scenes)
  {
    appendImages(number, scene, images);
  }
  if (images.empty())
  {
    throw Error("The scenes in '" + path + "' have no images: their files scene_camera.json are empty.");
  }
  return images;
}

std::array<int, 2> readBOPSize(const BOPImage& image) { return readImageSize(depthFileOf(image)); }

OrganizedCloud readBOPDepth(const BOPImage& image, const Progress& progress)
{
  return readDepthImage(depthFileOf(image), image.camera, image.depthScale, progress);
}

std::optional<Image> readBOPColors(const BOPImage& image, const OrganizedCloud& cloud)
{
  const std::string path = fileOf(image, { "rgb", "gray" }, { ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp" });
  if (path.empty())
  {
    return std::nullopt;
  }
  Image colors = readImage(path);
  requireRegistered(colors, cloud, path);
  return colors;
}

std::vector<BOPInstance> readBOPTruth(const BOPImage& image)
{
  const std::string path = (fs::path(image.folder) / "scene_gt.json").string();
  const std::string infoPath = (fs::path(image.folder) / "scene_gt_info.json").string();
  const nlohmann::json entries = listOf(image, path);
  const nlohmann::json infos = listOf(image, infoPath);
  if (!infos.empty() && infos.size() != entries.size())
  {
    failBOP(infoPath, "has " + std::to_string(infos.size()) + " objects for image " + std::to_string(image.imageId) +
                        ", but scene_gt.json has " + std::to_string(entries.size()));
  }
  std::vector<BOPInstance> instances;
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    BOPInstance instance;
    const double id = numbersUnder(entries[i], "obj_id", 1, path)[0];
    if (!(id >= 0.0 && id <= 1e9))
    {
      failBOP(path, "has an obj_id that is not the number of an object");
    }
    instance.objectId = static_cast<int>(id);
    instance.pose.T_scene_model = poseOf(entries[i], path);
    if (!infos.empty())
    {
      instance.pose.visibleFraction = std::clamp(numbersUnder(infos[i], "visib_fract", 1, infoPath)[0], 0.0, 1.0);
    }
    instances.push_back(instance);
  }
  return instances;
}
}
