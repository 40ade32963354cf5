// SPDX-License-Identifier: BSD-3-Clause
#include "io/PoseFile.h"

#include "io/parsing/FileBytes.h"

#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <cmath>

namespace meam
{
namespace
{
// The entries of a rotation that was printed with few digits.
constexpr double RotationTolerance = 1e-3;

/// The shortest text that reads back as the same number, in any locale.
std::string number(double value)
{
  std::array<char, 32> text;
  const auto [end, failure] = std::to_chars(text.data(), text.data() + text.size(), value);
  (void)failure; // 32 characters are enough for any double
  return std::string(text.data(), end);
}

void requireFinite(const std::string& path, const std::vector<PoseRow>& poses)
{
  for (const PoseRow& pose : poses)
  {
    if (!pose.T_scene_model.matrix().allFinite())
    {
      throw Error("The file '" + path + "' was not written: a pose has a value that is not a number.");
    }
  }
}

/// The upper left rows x columns of a pose, row by row.
std::string values(const Eigen::Isometry3d& pose, int firstColumn, int columns)
{
  std::string text;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = firstColumn; column < firstColumn + columns; ++column)
    {
      text += (text.empty() ? "" : " ") + number(pose(row, column));
    }
  }
  return text;
}
}

std::vector<Eigen::Isometry3d> readMatrices(const std::string& path)
{
  const std::string bytes = readFile(path);
  const std::string what = "The pose file '" + path + "' ";
  constexpr const char* blanks = " \t\r\n,";
  std::vector<double> numbers;
  std::size_t at = bytes.find_first_not_of(blanks);
  while (at != std::string::npos)
  {
    if (bytes[at] == '#')
    {
      at = bytes.find('\n', at);
    }
    else
    {
      const std::size_t end = std::min(bytes.find_first_of(std::string(blanks) + "#", at), bytes.size());
      const char* first = bytes.data() + at + (bytes[at] == '+' ? 1 : 0);
      double value = 0.0;
      const auto [stop, failure] = std::from_chars(first, bytes.data() + end, value);
      if (failure != std::errc() || stop != bytes.data() + end || !std::isfinite(value))
      {
        throw Error(
          what + "has a value that is not a number: '" + bytes.substr(at, std::min<std::size_t>(end - at, 40)) + "'.");
      }
      numbers.push_back(value);
      at = end;
    }
    at = at == std::string::npos ? at : bytes.find_first_not_of(blanks, at);
  }
  if (numbers.size() % 16 != 0)
  {
    throw Error(what + "has " + std::to_string(numbers.size()) +
                " numbers, which does not make whole 4x4 matrices: it is cut off, or not a pose file.");
  }

  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(numbers.size() / 16);
  for (std::size_t i = 0; i < numbers.size(); i += 16)
  {
    const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&numbers[i]);
    const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
    const double skew = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(skew < RotationTolerance) || rotation.determinant() < 0.0 ||
        matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
    {
      throw Error(
        what + "has a matrix that is not a rotation and a translation: number " + std::to_string(i / 16 + 1) + ".");
    }
    Eigen::Isometry3d pose;
    pose.matrix() = matrix;
    poses.push_back(pose);
  }
  return poses;
}

void writeMatrices(const std::string& path, const std::vector<PoseRow>& poses)
{
  requireFinite(path, poses);
  std::string text;
  for (const PoseRow& pose : poses)
  {
    for (int row = 0; row < 4; ++row)
    {
      for (int column = 0; column < 4; ++column)
      {
        text += number(pose.T_scene_model(row, column)) + (column < 3 ? " " : "\n");
      }
    }
    text += "\n";
  }
  writeFile(path, text);
}

void writeBOP(const std::string& path, const std::vector<PoseRow>& poses)
{
  requireFinite(path, poses);
  std::string text = "scene_id,im_id,obj_id,score,R,t,time\n";
  for (const PoseRow& pose : poses)
  {
    text += std::to_string(pose.sceneId) + "," + std::to_string(pose.imageId) + "," + std::to_string(pose.objectId) +
            "," + number(pose.score) + "," + values(pose.T_scene_model, 0, 3) + "," + values(pose.T_scene_model, 3, 1) +
            "," + number(pose.time) + "\n";
  }
  writeFile(path, text);
}

void writeJSON(const std::string& path, const std::vector<PoseRow>& poses)
{
  requireFinite(path, poses);
  std::string text = "{\n\"units\": \"mm\",\n\"transform\": "
                     "\"T_scene_model\",\n\"quaternion_order\": \"xyzw\",\n\"poses\": [";
  int place = 0;
  for (const PoseRow& row : poses)
  {
    ++place;
    const Eigen::Isometry3d& pose = row.T_scene_model;
    const Eigen::Quaterniond q = Eigen::Quaterniond(pose.linear()).normalized();
    nlohmann::ordered_json json;
    json["rank"] = row.rank > 0 ? row.rank : place;
    json["scene_id"] = row.sceneId;
    json["im_id"] = row.imageId;
    json["obj_id"] = row.objectId;
    json["score"] = row.score;
    if (row.votes >= 0)
    {
      json["votes"] = row.votes;
    }
    if (row.viewId >= 0)
    {
      json["view"] = row.viewId;
    }
    if (std::isfinite(row.visibleFraction))
    {
      json["visible_fraction"] = row.visibleFraction;
    }
    if (row.time >= 0.0)
    {
      json["time"] = row.time;
    }
    json["translation"] = { pose(0, 3), pose(1, 3), pose(2, 3) };
    json["quaternion"] = { q.x(), q.y(), q.z(), q.w() };
    for (int i = 0; i < 4; ++i)
    {
      json["matrix"].push_back({ pose(i, 0), pose(i, 1), pose(i, 2), pose(i, 3) });
    }
    text += (place > 1 ? ",\n" : "\n") + json.dump();
  }
  writeFile(path, text + "\n]\n}\n");
}
}
