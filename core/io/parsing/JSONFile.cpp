// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/JSONFile.h"

#include "base/Error.h"
#include "io/parsing/TextLines.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>

namespace meam
{
namespace
{
constexpr int MostNested = 4;  // arrays in arrays: a matrix has two
constexpr int MostLevels = 64; // of a file; copies and comparisons call themselves for each

void append(const nlohmann::json& value, int nested, std::vector<double>& numbers, bool& good)
{
  double number = 0.0;
  const bool isQuoted = value.is_string() && parseNumber(value.get_ref<const std::string&>(), number);
  if (value.is_number() || isQuoted)
  {
    numbers.push_back(isQuoted ? number : value.get<double>());
    good = good && std::isfinite(numbers.back());
    return;
  }
  good = good && value.is_array() && nested < MostNested;
  for (std::size_t i = 0; good && i < value.size(); ++i)
  {
    append(value[i], nested + 1, numbers, good);
  }
}

/// Whether lists and objects of a JSON text stand in each other more than so many times over.
bool isNestedDeeper(const std::string& text, int levels)
{
  int open = 0;
  bool isQuoted = false;
  for (std::size_t at = 0; at < text.size() && open <= levels; ++at)
  {
    const char letter = text[at];
    if (isQuoted)
    {
      at += letter == '\\' ? 1 : 0;
      isQuoted = letter != '"';
      continue;
    }
    isQuoted = letter == '"';
    open += letter == '[' || letter == '{' ? 1 : letter == ']' || letter == '}' ? -1 : 0;
  }
  return open > levels;
}
}

nlohmann::json parseJSON(const std::string& path, const std::string& text)
{
  // Not by the parser's callback: with one it goes, at the end of each object, through all that the list so far has.
  if (isNestedDeeper(text, MostLevels))
  {
    throw Error("The file '" + path + "' has lists in lists " + std::to_string(MostLevels) +
                " times over: it is damaged, or no file of this kind.");
  }
  try
  {
    return nlohmann::json::parse(text);
  }
  catch (const nlohmann::json::parse_error& error)
  {
    throw Error(
      "The file '" + path + "' is not JSON from byte " + std::to_string(error.byte) + " on: it is cut off or damaged.");
  }
  catch (const nlohmann::json::exception&) // a number that no computer holds
  {
    throw Error("The file '" + path + "' has a number that is too large.");
  }
}

std::vector<double> numbersOf(const nlohmann::json& value, const std::string& path, const std::string& what)
{
  std::vector<double> numbers;
  bool good = true;
  append(value, 0, numbers, good);
  if (!good)
  {
    throw Error("The file '" + path + "' has a " + what + " that is not made of numbers.");
  }
  return numbers;
}

int idOf(const std::string& key, const std::string& path)
{
  int id = 0;
  const auto [end, failure] = std::from_chars(key.data(), key.data() + key.size(), id);
  if (failure != std::errc() || end != key.data() + key.size() || id < 0)
  {
    throw Error("The file '" + path + "' has the key '" + key.substr(0, 40) +
                "': the number of an image or an object is "
                "expected.");
  }
  return id;
}
}
