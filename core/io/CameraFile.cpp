// SPDX-License-Identifier: BSD-3-Clause
#include "io/CameraFile.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/StorageText.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <tuple>

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
  // ROS has an R of its own, which rectifies the image.
  const bool isOfROS = entries.is_object() && (entries.contains("K") || entries.contains("distortion_model"));
  const bool isRectification = isOfROS && !entries.contains("T");
  const std::vector<double> rotation = isRectification ? std::vector<double>() : find(path, entries, { "R" }, 9, 9);
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

/// Focal lengths and principal point.
struct Intrinsics
{
  double fx, fy, cx, cy;
};

std::optional<Intrinsics> intrinsicsOf(const std::string& path, const nlohmann::json& entries)
{
  auto m = find(path, entries, { "camera_matrix", "cameraMatrix", "K", "k" }, 9, 9);
  if (m.empty())
  {
    m = find(path, entries, { "intrinsic_matrix" }, 9, 9); // Open3D's, column by column
    m = m.empty() ? m : std::vector{ m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8] };
  }
  if (!m.empty())
  {
    if (m[1] != 0.0 || m[3] != 0.0 || m[6] != 0.0 || m[7] != 0.0 || m[8] != 1.0)
    {
      failCamera(path, "has a camera matrix that is not fx 0 cx, 0 fy cy, 0 0 1");
    }
    return Intrinsics{ m[0], m[4], m[2], m[5] };
  }
  if (const auto row = find(path, entries, { "intrinsics" }, 4, 4); !row.empty()) // Kalibr's
  {
    return Intrinsics{ row[0], row[1], row[2], row[3] };
  }
  Intrinsics result{};
  const std::tuple<double*, const char*, const char*> values[] = { { &result.fx, "fx", "fx" },
    { &result.fy, "fy", "fy" }, { &result.cx, "cx", "ppx" }, { &result.cy, "cy", "ppy" } }; // ppx: RealSense's
  for (const auto& [value, name, other] : values)
  {
    const auto number = find(path, entries, { name, other }, 1, 1);
    if (number.empty())
    {
      return std::nullopt;
    }
    *value = number.front();
  }
  return result;
}

/// The name that a file gives its lens model, in lower case, blanks and underscores left out; empty without.
std::string lensModelOf(const nlohmann::json& entries)
{
  for (const char* name : { "distortion_model", "model" })
  {
    if (!entries.is_object() || !entries.contains(name) || !entries[name].is_string())
    {
      continue;
    }
    std::string model;
    for (const char letter : entries[name].get<std::string>())
    {
      if (std::isalnum(static_cast<unsigned char>(letter)))
      {
        model += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      }
    }
    return model;
  }
  return {};
}

/// k1 k2 p1 p2 k3 k4 k5 k6.
std::array<double, 8> distortionOf(const std::string& path, const nlohmann::json& entries)
{
  std::array<double, 8> result{};
  const auto numbers =
    find(path, entries, { "distortion_coefficients", "dist_coeffs", "distortion_coeffs", "coeffs", "D", "d" }, 0, 14);
  if (std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0.0; }))
  {
    return result; // of any model
  }
  // By their number of coefficients, where they are named; a name that is not known may be of any lens.
  const std::string model = lensModelOf(entries);
  const bool isBrown = model.empty() || model == "plumbbob" || model == "radtan" || model == "browndistortion" ||
                       model.rfind("browncon", 0) == 0 || model == "distortionbrownconrady" || model == "pinhole";
  const bool isRational = model == "rationalpolynomial" || model == "rational";
  if (!isBrown && !isRational)
  {
    failCamera(path, "has a lens of the model '" + model +
                       "', which is not read: calibrate it as plumb_bob or rational_polynomial, or undistort the "
                       "images and leave the coefficients away");
  }
  if (numbers.size() < 4 || (isRational && numbers.size() < 8))
  {
    failCamera(path, "has " + std::to_string(numbers.size()) + " numbers of its lens's distortion instead of " +
                       (isRational ? "8: k1 k2 p1 p2 k3 k4 k5 k6" : "4 or 5: k1 k2 p1 p2 k3"));
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (i < result.size())
    {
      result[i] = numbers[i];
    }
    else if (numbers[i] != 0.0)
    {
      failCamera(path, "has a lens with a thin prism or a tilted sensor: calibrate with k1 k2 p1 p2 k3 k4 k5 k6 alone");
    }
  }
  return result;
}

/// Where the one camera stands among a file's entries, as Open3D and Kalibr have it a level deeper.
const nlohmann::json& entriesOfCamera(const std::string& path, const nlohmann::json& file)
{
  const nlohmann::json* found = &file;
  int cameras = 0;
  for (const auto& [name, entry] : file.items()) // of a list the names are numbers
  {
    if (entry.is_object() && (name == "intrinsic" || name == "intrinsics" || name.rfind("cam", 0) == 0) &&
        (entry.contains("intrinsics") || entry.contains("intrinsic_matrix") || entry.contains("fx")))
    {
      found = &entry;
      ++cameras;
    }
  }
  if (cameras > 1)
  {
    failCamera(path, "has " + std::to_string(cameras) + " cameras: leave the one that is meant");
  }
  return *found;
}

Camera cameraOf(const std::string& path, const nlohmann::json& entries)
{
  const std::optional<Intrinsics> intrinsics = intrinsicsOf(path, entries);
  if (!intrinsics)
  {
    failCamera(path, "has neither a camera_matrix nor all of fx, fy, cx and cy: it is not a camera's calibration");
  }
  Camera camera;
  camera.fx = intrinsics->fx;
  camera.fy = intrinsics->fy;
  camera.cx = intrinsics->cx;
  camera.cy = intrinsics->cy;
  camera.width = pixels(path, find(path, entries, { "image_width", "width" }, 1, 1));
  camera.height = pixels(path, find(path, entries, { "image_height", "height" }, 1, 1));
  if (const auto size = find(path, entries, { "resolution" }, 2, 2); !size.empty())
  {
    camera.width = pixels(path, { size[0] });
    camera.height = pixels(path, { size[1] });
  }
  camera.distortion = distortionOf(path, entries);
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
  const nlohmann::json file = parseStorage(path, bytes);
  const nlohmann::json& entries = entriesOfCamera(path, file);
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
