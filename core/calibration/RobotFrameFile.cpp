// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/RobotFrameFile.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "io/PoseFile.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/StorageText.h"
#include "scene/Units.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace meam
{
namespace
{
constexpr std::size_t MostBytes = 1 << 20; // a transform is a page of text
constexpr std::size_t MostName = 256;      // characters; numbers with a longer name would fill the memory
constexpr double Tolerance = 1e-3;         // of entries that were printed with few digits
constexpr const char* Entry = "T_robot_camera";

[[noreturn]] void failRobotFrame(const std::string& path, const std::string& what)
{
  throw Error("The robot frame file '" + path + "' " + what + ".");
}

[[noreturn]] void failSeveral(const std::string& path)
{
  failRobotFrame(path, "has several transforms: leave the one from the robot's base to the camera alone");
}

Eigen::Isometry3d poseOf(const std::string& path, const std::vector<double>& numbers, double unit)
{
  if (numbers.size() != 16)
  {
    failRobotFrame(path, "has " + std::to_string(numbers.size()) + " numbers as " + Entry + " instead of 16");
  }
  std::optional<Eigen::Isometry3d> T = rigidOf(transformOf(numbers.data()).matrix());
  if (!T)
  {
    failRobotFrame(path, std::string("has a ") + Entry + " that is not a rotation and a translation");
  }
  T->translation() *= unit;
  return *T;
}

/// Numbers by the names that lead to them, as in "transform.translation.x".
using NestedNumbers = std::map<std::string, double>;

/// Places in lists are names from 0 on.
void append(const nlohmann::json& value, const std::string& name, NestedNumbers& numbers)
{
  if (name.size() > MostName)
  {
    return;
  }
  if (value.is_number())
  {
    numbers[name] = value.get<double>();
  }
  else if (value.is_structured())
  {
    for (const auto& [key, entry] : value.items())
    {
      append(entry, (name.empty() ? "" : name + ".") + key, numbers);
    }
  }
}

/// The numbers whose names end in each of these, within one transform: `a.` + each. None when there is none of them.
std::optional<Eigen::Isometry3d> transformIn(
  const std::string& path, const NestedNumbers& numbers, const std::array<std::string, 7>& names)
{
  std::optional<Eigen::Isometry3d> found;
  for (const auto& [key, first] : numbers)
  {
    const std::string& name = names[0];
    if (key.size() < name.size() || key.compare(key.size() - name.size(), name.size(), name) != 0 ||
        (key.size() > name.size() && key[key.size() - name.size() - 1] != '.'))
    {
      continue;
    }
    const std::string parent = key.substr(0, key.size() - name.size());
    std::array<double, 7> values{};
    bool whole = true;
    for (std::size_t k = 0; k < names.size(); ++k)
    {
      const auto entry = numbers.find(parent + names[k]);
      whole = whole && entry != numbers.end();
      values[k] = whole ? entry->second : 0.0;
    }
    if (!whole)
    {
      continue;
    }
    if (found)
    {
      failSeveral(path);
    }
    Eigen::Quaterniond turn(values[6], values[3], values[4], values[5]);
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() = Metre * Eigen::Vector3d(values[0], values[1], values[2]);
    if (!T.translation().allFinite() || !(std::abs(turn.norm() - 1.0) < Tolerance))
    {
      failRobotFrame(path, "has a rotation that is not a quaternion of length 1, or a number that is not finite");
    }
    T.linear() = turn.normalized().toRotationMatrix();
    found = T;
  }
  return found;
}

/// The forms of ROS.
std::optional<Eigen::Isometry3d> transformIn(const std::string& path, const NestedNumbers& numbers)
{
  const auto apart = transformIn(path, numbers,
    { "translation.x", "translation.y", "translation.z", "rotation.x", "rotation.y", "rotation.z", "rotation.w" });
  const auto pose = transformIn(path, numbers,
    { "position.x", "position.y", "position.z", "orientation.x", "orientation.y", "orientation.z", "orientation.w" });
  const auto words = transformIn(path, numbers, { "x", "y", "z", "qx", "qy", "qz", "qw" });
  if (apart.has_value() + pose.has_value() + words.has_value() > 1)
  {
    failSeveral(path);
  }
  return apart ? apart : pose ? pose : words;
}

std::optional<Eigen::Isometry3d> frameIn(const std::string& path, const nlohmann::json& file)
{
  if (!file.is_object() || !file.contains(Entry))
  {
    NestedNumbers numbers;
    append(file, "", numbers);
    return transformIn(path, numbers);
  }
  const nlohmann::json units = file.value("units", nlohmann::json("mm"));
  if (units != "mm" && units != "m")
  {
    failRobotFrame(path, "has 'units' other than \"mm\" and \"m\"");
  }
  return poseOf(path, numbersOfMatrix(file[Entry], path, Entry), units == "m" ? Metre : 1.0);
}
}

Eigen::Isometry3d readRobotFrame(const std::string& path)
{
  const std::string bytes = readFile(path);
  if (bytes.size() > MostBytes || bytes.find('\0') != std::string::npos)
  {
    failRobotFrame(path, "is not a text with a transform");
  }
  std::optional<Eigen::Isometry3d> found;
  if (bytes.find_first_of("{<:") != std::string::npos)
  {
    found = frameIn(path, parseStorage(path, bytes));
  }
  else
  {
    const std::vector<Eigen::Isometry3d> matrices = readMatrices(path);
    if (matrices.size() == 1)
    {
      found = matrices.front();
    }
  }
  if (!found)
  {
    failRobotFrame(
      path, std::string("has no ") + Entry +
              " (4x4), no translation and rotation, or position and orientation, and not one matrix alone");
  }
  const std::string doubt = cameraUnitDoubt(found->translation().norm());
  if (!doubt.empty())
  {
    failRobotFrame(path, "has " + doubt);
  }
  return *found;
}

void writeRobotFrame(const std::string& path, const Eigen::Isometry3d& T_robot_camera, const std::string& robotFrame,
  const std::string& cameraFrame)
{
  if (!T_robot_camera.matrix().allFinite())
  {
    throw Error("The file '" + path + "' was not written: the transform has a value that is not a number.");
  }
  const Eigen::Quaterniond q = Eigen::Quaterniond(T_robot_camera.linear()).normalized();
  const Eigen::Vector3d t = T_robot_camera.translation() / Metre;
  const std::string extension = extensionOf(path);
  if (extension == ".yaml" || extension == ".yml")
  {
    const auto line = [](const char* name, double value)
    { return std::string("    ") + name + ": " + nlohmann::json(value).dump() + "\n"; };
    const auto text = [](const std::string& value) { return nlohmann::json(value).dump(); }; // quotes are YAML's, too
    writeFile(path, "header:\n  frame_id: " + text(robotFrame) + "\nchild_frame_id: " + text(cameraFrame) +
                      "\ntransform:\n  translation:\n" + line("x", t.x()) + line("y", t.y()) + line("z", t.z()) +
                      "  rotation:\n" + line("x", q.x()) + line("y", q.y()) + line("z", q.z()) + line("w", q.w()));
    return;
  }
  nlohmann::ordered_json json;
  json["format"] = "meam-robot-frame";
  json["version"] = 1;
  json["units"] = "mm";
  for (int row = 0; row < 4; ++row)
  {
    const Eigen::RowVector4d values = T_robot_camera.matrix().row(row);
    json[Entry].push_back({ values[0], values[1], values[2], values[3] });
  }
  writeFile(path, json.dump(1) + "\n");
}
}
