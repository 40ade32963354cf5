// SPDX-License-Identifier: BSD-3-Clause
#include "io/PoseFile.h"

#include "base/Frames.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/JSONFile.h"
#include "io/parsing/TextLines.h"

#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace meam
{
namespace
{
constexpr double MostIds = 1e9; // of scenes, images, objects, ranks
constexpr const char* JSONFormat = "meam-poses";
constexpr int JSONVersion = 1;

/// What is not known of every pose, by its name in JSON.
constexpr std::pair<const char*, double PoseRow::*> Judgements[] = { { "visible_fraction", &PoseRow::visibleFraction },
  { "place_probability", &PoseRow::placeProbability }, { "probability", &PoseRow::probability },
  { "certainty", &PoseRow::certainty } };

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

namespace
{
constexpr std::string_view BOPHeader = "scene_id,im_id,obj_id,score,R,t,time";

Eigen::Isometry3d requirePose(const Eigen::Matrix4d& matrix, const std::string& what, std::size_t place)
{
  const std::optional<Eigen::Isometry3d> pose = rigidOf(matrix);
  if (!pose)
  {
    throw Error(what + "has a matrix that is not a rotation and a translation: number " + std::to_string(place) + ".");
  }
  return *pose;
}

/// The numbers of a text, between blanks.
std::vector<double> numbersIn(std::string_view text, const std::string& what)
{
  constexpr std::string_view blanks = " \t\r";
  std::vector<double> numbers;
  for (std::size_t at = text.find_first_not_of(blanks); at < text.size(); at = text.find_first_not_of(blanks, at))
  {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    double value = 0.0;
    const auto [stop, failure] = std::from_chars(text.data() + at, text.data() + end, value);
    if (failure != std::errc() || stop != text.data() + end || !std::isfinite(value))
    {
      throw Error(what + "has a value that is not a number: '" + std::string(text.substr(at, 40)) + "'.");
    }
    numbers.push_back(value);
    at = end;
  }
  return numbers;
}

int idIn(double value, const std::string& what)
{
  if (!(std::abs(value) <= MostIds) || value != std::floor(value))
  {
    throw Error(
      what + "has a number of a scene, an image or an object that is not a whole one: " + number(value) + ".");
  }
  return static_cast<int>(value);
}

std::vector<PoseRow> readBOP(const std::string& bytes, const std::string& what)
{
  std::vector<PoseRow> poses;
  TextLines lines(bytes);
  lines.next(); // the header
  while (lines.next())
  {
    std::vector<double> fields[7];
    std::string_view rest = lines.line();
    for (int k = 0; k < 7; ++k)
    {
      const std::size_t end = std::min(rest.find(','), rest.size());
      fields[k] = numbersIn(rest.substr(0, end), what);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (fields[k].size() != (k == 4 ? 9u : k == 5 ? 3u : 1u))
      {
        throw Error(what + "has a row that is not " + std::string(BOPHeader) + ": row " +
                    std::to_string(poses.size() + 1) + ". It is cut off or damaged.");
      }
    }
    PoseRow row;
    row.sceneId = idIn(fields[0][0], what);
    row.imageId = idIn(fields[1][0], what);
    row.objectId = idIn(fields[2][0], what);
    row.score = fields[3][0];
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(fields[4].data());
    matrix.topRightCorner<3, 1>() = Eigen::Map<const Eigen::Vector3d>(fields[5].data());
    row.T_scene_model = requirePose(matrix, what, poses.size() + 1);
    row.time = fields[6][0];
    poses.push_back(row);
  }
  return poses;
}

std::vector<PoseRow> readJSON(const std::string& bytes, const std::string& path, const std::string& what)
{
  const nlohmann::json file = parseJSON(path, bytes);
  if (!file.is_object() || !file.contains("poses") || !file["poses"].is_array())
  {
    throw Error(what + "has no list 'poses'.");
  }
  if (file.value("format", nlohmann::json(JSONFormat)) != JSONFormat ||
      file.value("version", nlohmann::json(JSONVersion)) != JSONVersion)
  {
    throw Error(what + "has another 'format' than \"" + JSONFormat + "\" or another 'version' than " +
                std::to_string(JSONVersion) + ", those that are known.");
  }
  std::vector<PoseRow> poses;
  for (const nlohmann::json& json : file["poses"])
  {
    const auto numbers = [&](const char* name)
    { return json.is_object() && json.contains(name) ? numbersOf(json[name], path, name) : std::vector<double>(); };
    const auto value = [&](const char* name, double unknown)
    {
      const std::vector<double> found = numbers(name);
      return found.size() == 1 ? found.front() : unknown;
    };
    const std::vector<double> matrix = numbers("matrix");
    if (matrix.size() != 16)
    {
      throw Error(what + "has a pose without a 4x4 'matrix': number " + std::to_string(poses.size() + 1) + ".");
    }
    PoseRow row;
    row.T_scene_model = requirePose(transformOf(matrix.data()).matrix(), what, poses.size() + 1);
    row.sceneId = idIn(value("scene_id", row.sceneId), what);
    row.imageId = idIn(value("im_id", row.imageId), what);
    row.objectId = idIn(value("obj_id", row.objectId), what);
    row.rank = idIn(value("rank", row.rank), what);
    row.votes = idIn(value("votes", row.votes), what);
    row.viewId = idIn(value("view", row.viewId), what);
    row.score = value("score", row.score);
    row.time = value("time", row.time);
    for (const auto& [name, judgement] : Judgements)
    {
      row.*judgement = value(name, row.*judgement);
    }
    poses.push_back(row);
  }
  return poses;
}
}

std::vector<PoseRow> readPoses(const std::string& path)
{
  const std::string bytes = readFile(path);
  const std::string what = "The pose file '" + path + "' ";
  const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  if (bytes.compare(first, 1, "{") == 0)
  {
    return readJSON(bytes, path, what);
  }
  if (bytes.compare(first, BOPHeader.size(), BOPHeader) == 0)
  {
    return readBOP(bytes, what);
  }
  std::vector<PoseRow> poses;
  for (const Eigen::Isometry3d& T_scene_model : readMatrices(path))
  {
    poses.emplace_back();
    poses.back().T_scene_model = T_scene_model;
  }
  return poses;
}

std::vector<Eigen::Isometry3d> readMatrices(const std::string& path)
{
  const std::string bytes = readFile(path);
  const std::string what = "The pose file '" + path + "' ";
  constexpr const char* blanks = " \t\r\n,;[]";
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
    poses.push_back(requirePose(transformOf(&numbers[i]).matrix(), what, i / 16 + 1));
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
  std::string text = std::string(BOPHeader) + "\n";
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
  std::string text = "{\n\"format\": \"" + std::string(JSONFormat) +
                     "\",\n\"version\": " + std::to_string(JSONVersion) +
                     ",\n\"units\": \"mm\",\n\"transform\": "
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
    for (const auto& [name, judgement] : Judgements)
    {
      if (std::isfinite(row.*judgement))
      {
        json[name] = row.*judgement;
      }
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
