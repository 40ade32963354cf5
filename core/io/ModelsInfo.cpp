// SPDX-License-Identifier: BSD-3-Clause
#include "io/ModelsInfo.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/JSONFile.h"

#include <nlohmann/json.hpp>

namespace meam
{
namespace
{

[[noreturn]] void failModelsInfo(const std::string& path, const std::string& what)
{
  throw Error("The file '" + path + "' " + what + ".");
}

/// The list under a name; empty when it is not there.
nlohmann::json listUnder(const nlohmann::json& entry, const char* name, const std::string& path)
{
  const auto found = entry.find(name);
  nlohmann::json list = found == entry.end() ? nlohmann::json::array() : *found;
  if (!list.is_array())
  {
    failModelsInfo(path, std::string("has ") + name + " that is not a list");
  }
  return list;
}

Eigen::Vector3d vectorUnder(const nlohmann::json& entry, const char* name, const std::string& path)
{
  std::vector<double> numbers;
  if (entry.is_object() && entry.contains(name))
  {
    numbers = numbersOf(entry[name], path, name);
  }
  if (numbers.size() != 3)
  {
    failModelsInfo(path, std::string("has a continuous symmetry without three numbers as ") + name);
  }
  return { numbers[0], numbers[1], numbers[2] };
}
}

std::string modelsInfo(const Symmetries& symmetries, double diameter, const Eigen::AlignedBox3f& bounds)
{
  const auto list = [](const auto& values)
  { return std::vector<double>(values.data(), values.data() + values.size()); };
  nlohmann::ordered_json entry;
  entry["diameter"] = diameter;
  for (int axis = 0; axis < 3; ++axis)
  {
    entry[std::string("min_") + "xyz"[axis]] = bounds.min()[axis];
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    entry[std::string("size_") + "xyz"[axis]] = bounds.sizes()[axis];
  }
  for (const Eigen::Isometry3d& S : symmetries.discrete)
  {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = S.matrix();
    entry["symmetries_discrete"].push_back(list(rows));
  }
  for (const ContinuousSymmetry& symmetry : symmetries.continuous)
  {
    entry["symmetries_continuous"].push_back({ { "axis", list(symmetry.axis) }, { "offset", list(symmetry.point) } });
  }
  return entry.dump(2);
}

Symmetries readModelsInfo(const std::string& path, int objectId)
{
  const nlohmann::json objects = parseJSON(path, readFile(path));
  const auto entry = objects.is_object() ? objects.find(std::to_string(objectId)) : objects.end();
  if (entry == objects.end() || !entry->is_object())
  {
    failModelsInfo(path, "knows no object " + std::to_string(objectId));
  }
  Symmetries symmetries;
  for (const nlohmann::json& matrix : listUnder(*entry, "symmetries_discrete", path))
  {
    const std::vector<double> numbers = numbersOf(matrix, path, "discrete symmetry");
    const std::optional<Eigen::Isometry3d> S =
      numbers.size() == 16 ? rigidOf(transformOf(numbers.data()).matrix()) : std::nullopt;
    if (!S)
    {
      failModelsInfo(path, "has a discrete symmetry that is not a 4x4 matrix of a rotation and a translation");
    }
    if (!S->isApprox(Eigen::Isometry3d::Identity()))
    {
      symmetries.discrete.push_back(*S);
    }
  }
  for (const nlohmann::json& turn : listUnder(*entry, "symmetries_continuous", path))
  {
    ContinuousSymmetry symmetry{ vectorUnder(turn, "axis", path), vectorUnder(turn, "offset", path) };
    if (!(symmetry.axis.norm() > 0.0))
    {
      failModelsInfo(path, "has a continuous symmetry without a direction");
    }
    symmetry.axis.normalize();
    symmetries.continuous.push_back(symmetry);
  }
  return symmetries;
}
}
