// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/HandEyeFile.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/JSONFile.h"
#include "io/parsing/TextLines.h"
#include "scene/Units.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace meam
{
namespace
{
constexpr std::string_view Separators = ",; \t";

[[noreturn]] void failHandEye(const std::string& path, const std::string& what)
{
  throw Error("The hand-eye file '" + path + "' " + what + ".");
}

Eigen::Isometry3d poseOf(
  const std::string& path, const double* numbers, double unit, const char* name, std::size_t pair)
{
  std::optional<Eigen::Isometry3d> T = rigidOf(transformOf(numbers).matrix());
  if (!T)
  {
    failHandEye(path,
      std::string("has a ") + name + " that is not a rotation and a translation: pair " + std::to_string(pair + 1));
  }
  T->translation() *= unit;
  return *T;
}

HandEyeFile readJSON(const std::string& path, const std::string& bytes)
{
  nlohmann::json file = parseJSON(path, bytes);
  if (file.is_array()) // the pairs alone
  {
    file = { { "pairs", std::move(file) } };
  }
  if (!file.contains("pairs") || !file["pairs"].is_array())
  {
    failHandEye(path, "has no list 'pairs'");
  }
  const nlohmann::json units = file.value("units", nlohmann::json("mm"));
  if (units != "mm" && units != "m")
  {
    failHandEye(path, "has 'units' other than \"mm\" and \"m\"");
  }
  const double unit = units == "m" ? Metre : 1.0;
  HandEyeFile result;
  if (file.contains("mount"))
  {
    if (file["mount"] != "beside" && file["mount"] != "hand")
    {
      failHandEye(path, "has a 'mount' other than \"beside\" and \"hand\"");
    }
    result.mount = file["mount"] == "hand" ? CameraMount::Hand : CameraMount::Beside;
  }
  for (const nlohmann::json& json : file["pairs"])
  {
    const std::size_t pair = result.pairs.size();
    const auto pose = [&](const char* name)
    {
      const std::vector<double> numbers =
        json.is_object() && json.contains(name) ? numbersOf(json[name], path, name) : std::vector<double>();
      if (numbers.size() != 16)
      {
        failHandEye(path, std::string("has no 4x4 '") + name + "' in pair " + std::to_string(pair + 1));
      }
      return poseOf(path, numbers.data(), unit, name, pair);
    };
    const Eigen::Isometry3d T_base_gripper = pose("T_base_gripper");
    result.pairs.push_back({ T_base_gripper, pose("T_camera_target") });
  }
  return result;
}

HandEyeFile readTable(const std::string& path, const std::string& bytes)
{
  HandEyeFile result;
  TextLines lines(bytes);
  bool first = true;
  while (lines.next())
  {
    std::vector<double> numbers;
    std::string_view rest = lines.line();
    bool good = true, isWords = true;
    for (std::size_t at = rest.find_first_not_of(Separators); at != std::string_view::npos;
         at = rest.find_first_not_of(Separators))
    {
      rest.remove_prefix(at);
      const std::size_t end = std::min(rest.find_first_of(Separators), rest.size());
      double value = 0.0;
      const bool isNumber = parseNumber(rest.substr(0, end), value);
      good &= isNumber;
      isWords &= !isNumber;
      numbers.push_back(value);
      rest.remove_prefix(end);
    }
    const bool isHeader = first && isWords;
    first = false;
    if (isHeader)
    {
      continue;
    }
    const std::size_t pair = result.pairs.size();
    if (!good || numbers.size() != 32)
    {
      failHandEye(
        path, "has a row that is not 32 numbers, T_base_gripper and T_camera_target as matrices of 4x4, but " +
                std::to_string(numbers.size()) + " words: pair " + std::to_string(pair + 1));
    }
    const Eigen::Isometry3d T_base_gripper = poseOf(path, numbers.data(), 1.0, "T_base_gripper", pair);
    result.pairs.push_back({ T_base_gripper, poseOf(path, numbers.data() + 16, 1.0, "T_camera_target", pair) });
  }
  return result;
}
}

HandEyeFile readHandEye(const std::string& path)
{
  const std::string bytes = readFile(path);
  const std::string_view bare = bareText(bytes);
  const bool isJSON = !bare.empty() && (bare[0] == '{' || bare[0] == '[');
  return isJSON ? readJSON(path, bytes) : readTable(path, bytes);
}
}
