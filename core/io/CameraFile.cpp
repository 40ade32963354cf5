// SPDX-License-Identifier: BSD-3-Clause
#include "io/CameraFile.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/StorageText.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <initializer_list>

namespace meam
{
namespace
{
// A calibration is a page of text; more is another kind of file.
constexpr std::size_t MostBytes = 1 << 20;
constexpr double MostPixels = 65535.0; // in a row or a column

[[noreturn]] void failCamera(const std::string& path, const std::string& what)
{
  throw Error("The camera file '" + path + "' " + what + ".");
}

/// Numbers by any of the names, empty without; fails when there are not as many as there should be.
std::vector<double> find(const std::string& path, const nlohmann::json& entries,
  std::initializer_list<const char*> names, std::size_t fewest, std::size_t most)
{
  for (const char* name : names)
  {
    if (!entries.is_object() || !entries.contains(name))
    {
      continue;
    }
    const std::vector<double> numbers = numbersOfMatrix(entries[name], path, name);
    if (numbers.size() < fewest || numbers.size() > most)
    {
      failCamera(path,
        "has " + std::to_string(numbers.size()) + " numbers as " + name + " instead of " + std::to_string(fewest));
    }
    return numbers;
  }
  return {};
}

int pixels(const std::string& path, const std::vector<double>& numbers)
{
  const double value = numbers.empty() ? 0.0 : numbers.front();
  if (!(value >= 0.0 && value <= MostPixels) || value != std::floor(value))
  {
    failCamera(path, "has an impossible width or height of the image");
  }
  return static_cast<int>(value);
}

/// Where the camera is, from `T_camera_scene` or `R` and `T`; the identity without.
Eigen::Isometry3d placeOf(const std::string& path, const nlohmann::json& entries)
{
  const std::vector<double> whole = find(path, entries, { "T_camera_scene" }, 16, 16);
  const std::vector<double> rotation = find(path, entries, { "R" }, 9, 9);
  const std::vector<double> translation = find(path, entries, { "T" }, 3, 3);
  Eigen::Isometry3d T_camera_scene = Eigen::Isometry3d::Identity();
  if (!whole.empty())
  {
    T_camera_scene = transformOf(whole.data());
  }
  else if (!rotation.empty() && !translation.empty())
  {
    T_camera_scene.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data());
    T_camera_scene.translation() = Eigen::Map<const Eigen::Vector3d>(translation.data());
  }
  else if (!rotation.empty() || !translation.empty())
  {
    failCamera(path, "has only one of R and T: the camera's place needs both, or T_camera_scene");
  }
  if (!isRigid(T_camera_scene.matrix()))
  {
    failCamera(path, "has a place of the camera that is not a rotation and a translation");
  }
  return T_camera_scene;
}

Camera cameraOf(const std::string& path, const nlohmann::json& entries)
{
  Camera camera;
  if (const auto m = find(path, entries, { "camera_matrix", "cameraMatrix" }, 9, 9); !m.empty())
  {
    if (m[1] != 0.0 || m[3] != 0.0 || m[6] != 0.0 || m[7] != 0.0 || m[8] != 1.0)
    {
      failCamera(path, "has a camera matrix that is not fx 0 cx, 0 fy cy, 0 0 1");
    }
    camera.fx = m[0];
    camera.cx = m[2];
    camera.fy = m[4];
    camera.cy = m[5];
  }
  else
  {
    const std::pair<const char*, double*> values[] = { { "fx", &camera.fx }, { "fy", &camera.fy }, { "cx", &camera.cx },
      { "cy", &camera.cy } };
    for (const auto& [name, value] : values)
    {
      const auto number = find(path, entries, { name }, 1, 1);
      if (number.empty())
      {
        failCamera(path, "has neither a camera_matrix nor all of fx, fy, cx and cy: it is not a camera's calibration");
      }
      *value = number.front();
    }
  }
  camera.width = pixels(path, find(path, entries, { "image_width", "width" }, 1, 1));
  camera.height = pixels(path, find(path, entries, { "image_height", "height" }, 1, 1));
  // OpenCV also knows models of up to 14 numbers; the first five are Brown's.
  const auto numbers = find(path, entries, { "distortion_coefficients", "dist_coeffs" }, 4, 14);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (i < camera.distortion.size())
    {
      camera.distortion[i] = numbers[i];
    }
    else if (numbers[i] != 0.0)
    {
      failCamera(path, "has a lens of the rational or a still larger model: calibrate with k1 k2 p1 p2 k3 alone");
    }
  }
  camera.T_camera_scene = placeOf(path, entries);
  return camera;
}
}

CameraFile readCamera(const std::string& path)
{
  const std::string bytes = readFile(path);
  if (bytes.size() > MostBytes || bytes.find('\0') != std::string::npos)
  {
    failCamera(path, "is not a text of a camera's calibration");
  }
  const nlohmann::json entries = parseStorage(path, bytes);
  CameraFile result;
  result.camera = cameraOf(path, entries);
  try
  {
    requireCamera(result.camera);
  }
  catch (const Error& error)
  {
    throw Error("The camera file '" + path + "' does not fit. " + error.what());
  }
  if (const auto scale = find(path, entries, { "depth_scale" }, 1, 1); !scale.empty())
  {
    result.depthScale = scale.front();
    if (!(result.depthScale > 0.0))
    {
      failCamera(path, "has a depth_scale that is not positive");
    }
  }
  return result;
}
}
