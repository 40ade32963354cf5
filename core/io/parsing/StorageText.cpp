// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/StorageText.h"

#include "base/Error.h"
#include "io/parsing/JSONFile.h"
#include "io/parsing/TextLines.h"
#include "io/parsing/YAMLFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace meam
{
namespace
{
constexpr const char* Blanks = " \t\r\n";
constexpr std::size_t MostElements = 64; // copies and comparisons call themselves for each
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void failStorage(const std::string& path, const std::string& what)
{
  throw Error("The file '" + path + "' " + what + ".");
}

/// The words as numbers; a word that is none becomes NaN.
std::vector<double> numbersIn(std::string_view text)
{
  std::vector<double> numbers;
  for (std::size_t at = text.find_first_not_of(Blanks); at < text.size();)
  {
    const std::size_t end = std::min(text.find_first_of(Blanks, at), text.size());
    double value = 0.0;
    numbers.push_back(parseNumber(text.substr(at, end - at), value) ? value : NaN);
    at = text.find_first_not_of(Blanks, end);
  }
  return numbers;
}

/// Of elements <name>words</name> within the first one numbers, or of words alone their text; of elements in elements
/// objects.
nlohmann::json valuesInXML(const std::string& path, const std::string& text)
{
  nlohmann::json result = nlohmann::json::object();
  std::vector<std::string> open;
  std::vector<nlohmann::json*> values; // of what is open: an object keeps its values where they are
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
  {
    const bool comment = text.compare(at, 4, "<!--") == 0;
    const std::string_view close = comment ? "-->" : ">";
    std::size_t end = text.find(close, at);
    if (end == std::string::npos)
    {
      failStorage(path, "ends within a tag: it is cut off");
    }
    std::string tag = text.substr(at + 1, end - at - 1);
    at = end + close.size();
    if (comment || tag.empty() || tag[0] == '?' || tag[0] == '!' || tag.back() == '/')
    {
      continue;
    }
    if (tag[0] == '/')
    {
      if (open.empty() || tag.substr(1) != open.back())
      {
        failStorage(path, "has a tag '" + tag.substr(0, 40) + "' in the wrong place: it is damaged");
      }
      open.pop_back();
      values.pop_back();
      continue;
    }
    if (open.size() == MostElements)
    {
      failStorage(path, "has elements in elements " + std::to_string(MostElements) + " times over: it is damaged");
    }
    open.push_back(tag.substr(0, tag.find_first_of(Blanks)));
    if (open.size() == 1)
    {
      values.push_back(&result);
      continue;
    }
    if (!values.back()->is_object())
    {
      *values.back() = nlohmann::json::object();
    }
    std::string name = open.back();
    for (int next = 2; values.back()->contains(name); ++next) // another of the name
    {
      name = open.back() + '#' + std::to_string(next);
    }
    nlohmann::json& value = (*values.back())[name];
    values.push_back(&value);
    end = std::min(text.find('<', at), text.size());
    const std::string words = text.substr(at, end - at);
    const std::vector<double> numbers = numbersIn(words);
    const bool isText = std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isnan(number); });
    if (!numbers.empty())
    {
      value = isText                ? nlohmann::json(words)
              : numbers.size() == 1 ? nlohmann::json(numbers.front())
                                    : nlohmann::json(numbers);
    }
  }
  if (!open.empty())
  {
    failStorage(path, "has no end of <" + open.back().substr(0, 40) + ">: it is cut off");
  }
  return result;
}
}

nlohmann::json parseStorage(const std::string& path, const std::string& text)
{
  const std::string_view bare = bareText(text);
  if (bare.empty())
  {
    failStorage(path, "is empty");
  }
  const std::size_t first = bare.find_first_not_of(Blanks, 1);
  const bool isJSON = bare[0] == '{' && (first == std::string_view::npos || bare[first] == '"' || bare[first] == '}');
  return bare[0] == '<' ? valuesInXML(path, text) : isJSON ? parseJSON(path, text) : parseYAML(path, text);
}

std::vector<double> numbersOfMatrix(const nlohmann::json& value, const std::string& path, const std::string& what)
{
  return numbersOf(value.is_object() && value.contains("data") ? value["data"] : value, path, what);
}
}
