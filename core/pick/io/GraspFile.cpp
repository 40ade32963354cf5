// SPDX-License-Identifier: BSD-3-Clause
#include "pick/io/GraspFile.h"

#include "base/Error.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/JSONFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace meam
{
namespace
{
constexpr const char* Format = "meam-grasps";
constexpr int Version = 1;

template <typename Value>
using Names = std::array<std::pair<const char*, Value>, std::is_same_v<Value, FreeTurn> ? 3 : 2>;

const Names<GraspKind> KindNames{ { { "parallel", GraspKind::Parallel }, { "suction", GraspKind::Suction } } };
const Names<FreeTurn> TurnNames{ { { "none", FreeTurn::None }, { "approach", FreeTurn::Approach },
  { "closing", FreeTurn::Closing } } };
const std::set<std::string> KnownEntries{ "name", "kind", "position", "approach", "closing", "width", "free_turn",
  "quality" };

template <typename Value>
const char* nameIn(const Names<Value>& names, Value value)
{
  return std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.second == value; })->first;
}

/// The entries of one grasp of a file.
class GraspEntry
{
public:
  GraspEntry(const std::string& path, const nlohmann::json& json, std::size_t place)
    : Path(path)
    , JSON(json)
    , Name("grasp " + std::to_string(place))
  {
    if (!json.is_object())
    {
      this->fail("is not an object with the entries of a grasp");
    }
    if (json.contains("name"))
    {
      if (!json["name"].is_string() || json["name"].get<std::string>().empty())
      {
        this->fail("has a 'name' that is not a text");
      }
      this->Name = json["name"];
    }
    for (const auto& [key, value] : json.items())
    {
      if (KnownEntries.count(key) == 0)
      {
        this->fail("has an entry '" + key.substr(0, 40) + "', which grasps do not have");
      }
    }
  }

  const std::string& name() const { return this->Name; }
  bool has(const char* entry) const { return this->JSON.contains(entry); }

  [[noreturn]] void fail(const std::string& what) const
  {
    throw Error("The file '" + this->Path + "': the grasp '" + this->Name + "' " + what + ".");
  }

  Eigen::Vector3d vector(const char* entry) const
  {
    this->require(entry);
    const nlohmann::json& value = this->JSON[entry];
    Eigen::Vector3d result;
    bool good = value.is_array() && value.size() == 3;
    for (int k = 0; good && k < 3; ++k)
    {
      good = value[k].is_number();
      result[k] = good ? value[k].get<double>() : 0.0;
    }
    if (!good || !result.allFinite())
    {
      this->fail(std::string("has a '") + entry + "' that is not three numbers");
    }
    return result;
  }

  double number(const char* entry) const
  {
    this->require(entry);
    const nlohmann::json& value = this->JSON[entry];
    if (!value.is_number() || !std::isfinite(value.get<double>()))
    {
      this->fail(std::string("has a '") + entry + "' that is not a number");
    }
    return value;
  }

  template <typename Value>
  Value choice(const char* entry, const Names<Value>& names) const
  {
    this->require(entry);
    std::string known;
    for (const auto& [name, value] : names)
    {
      if (this->JSON[entry] == name)
      {
        return value;
      }
      known += (known.empty() ? "" : ", ") + std::string(name);
    }
    this->fail(std::string("has a '") + entry + "' that is none of " + known);
  }

private:
  void require(const char* entry) const
  {
    if (!this->has(entry))
    {
      this->fail(std::string("has no '") + entry + "'");
    }
  }

  const std::string& Path;
  const nlohmann::json& JSON;
  std::string Name;
};

/// Some direction across another.
Eigen::Vector3d across(const Eigen::Vector3d& direction)
{
  Eigen::Index least = 0;
  direction.cwiseAbs().minCoeff(&least);
  return Eigen::Vector3d::Unit(least);
}

Grasp graspOf(const GraspEntry& entry)
{
  Grasp grasp;
  grasp.name = entry.name();
  grasp.kind = entry.choice("kind", KindNames);
  const bool isCup = grasp.kind == GraspKind::Suction;
  const bool isRound = isCup && !entry.has("closing");
  const Eigen::Vector3d position = entry.vector("position");
  const Eigen::Vector3d approach = entry.vector("approach");
  const Eigen::Vector3d closing = isRound ? across(approach) : entry.vector("closing");
  grasp.width = isCup && !entry.has("width") ? grasp.width : entry.number("width");
  grasp.freeTurn = entry.has("free_turn") ? entry.choice("free_turn", TurnNames)
                   : isRound              ? FreeTurn::Approach
                                          : FreeTurn::None;
  grasp.quality = entry.has("quality") ? entry.number("quality") : grasp.quality;
  try
  {
    grasp.T_model_grasp = graspFrame(position, approach, closing);
  }
  catch (const Error&)
  {
    entry.fail("has an 'approach' and a 'closing' that are parallel, or of no length");
  }
  return grasp;
}

/// What requireGrasp says, with the file's name; no name twice.
void requireGrasps(const std::string& path, const Grasps& grasps)
{
  std::set<std::string> names;
  for (const Grasp& grasp : grasps)
  {
    try
    {
      requireGrasp(grasp);
    }
    catch (const Error& error)
    {
      throw Error("The file '" + path + "' does not fit. " + error.what());
    }
    if (!names.insert(grasp.name).second)
    {
      throw Error(
        "The file '" + path + "' has two grasps with the 'name' '" + grasp.name + "': give each one of its own.");
    }
  }
}

void requireHeader(const std::string& path, const nlohmann::json& file)
{
  if (!file.is_object() || !file.contains("format") || file["format"] != Format)
  {
    throw Error("The file '" + path + "' holds no grasps: it has no 'format' \"" + Format + "\".");
  }
  if (!file.contains("version") || file["version"] != Version)
  {
    throw Error("The file '" + path + "' has a 'version' of grasps other than " + std::to_string(Version) +
                ", the one that is known.");
  }
  if (!file.contains("units") || file["units"] != "mm")
  {
    throw Error("The file '" + path + "' has 'units' other than \"mm\": bring its lengths to mm.");
  }
  if (!file.contains("grasps") || !file["grasps"].is_array())
  {
    throw Error("The file '" + path + "' has no list 'grasps'.");
  }
}

nlohmann::ordered_json jsonOf(const Eigen::Vector3d& vector) { return { vector.x(), vector.y(), vector.z() }; }
}

Grasps readGrasps(const std::string& path)
{
  const nlohmann::json file = parseJSON(path, readFile(path));
  requireHeader(path, file);
  Grasps grasps;
  for (const nlohmann::json& json : file["grasps"])
  {
    grasps.push_back(graspOf({ path, json, grasps.size() + 1 }));
  }
  requireGrasps(path, grasps);
  return grasps;
}

void writeGrasps(const std::string& path, const Grasps& grasps)
{
  requireGrasps(path, grasps);
  const nlohmann::ordered_json header{ { "format", Format }, { "version", Version }, { "units", "mm" } };
  std::string text = header.dump();
  text.pop_back(); // the bracket
  text += ",\n\"grasps\": [";
  for (const Grasp& grasp : grasps)
  {
    const Eigen::Matrix3d R = grasp.T_model_grasp.linear();
    nlohmann::ordered_json json;
    json["name"] = grasp.name;
    json["kind"] = nameIn(KindNames, grasp.kind);
    json["position"] = jsonOf(grasp.T_model_grasp.translation());
    json["approach"] = jsonOf(R.col(2));
    json["closing"] = jsonOf(R.col(0));
    json["width"] = grasp.width;
    json["free_turn"] = nameIn(TurnNames, grasp.freeTurn);
    json["quality"] = grasp.quality;
    text +=
      (&grasp == grasps.data() ? "\n" : ",\n") + json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  writeFile(path, text + "\n]}\n");
}
}
