// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/NestedText.h"

#include "io/parsing/TextLines.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

namespace meam
{
namespace
{
constexpr std::string_view Blanks = " \t\r";
constexpr int MostNested = 32;
constexpr std::size_t MostName = 256; // characters of a whole name; numbers with a longer one would fill the memory

void append(const nlohmann::json& value, const std::string& name, int nested, NestedNumbers& numbers)
{
  if (nested > MostNested || name.size() > MostName)
  {
    return;
  }
  if (value.is_number())
  {
    numbers[name] = value.get<double>();
    return;
  }
  const std::string start = name.empty() ? "" : name + ".";
  if (value.is_object())
  {
    for (const auto& [key, entry] : value.items())
    {
      append(entry, start + key, nested + 1, numbers);
    }
  }
  else if (value.is_array())
  {
    for (std::size_t k = 0; k < value.size(); ++k)
    {
      append(value[k], start + std::to_string(k), nested + 1, numbers);
    }
  }
}

std::string_view trimmed(std::string_view text)
{
  text.remove_prefix(std::min(text.find_first_not_of(Blanks), text.size()));
  return text.substr(0, text.find_last_not_of(Blanks) + 1);
}

/// A name on the way to a number, and how far its line is indented.
struct Level
{
  std::size_t indent;
  std::string name;
  int items; ///< of a list under it, so far
};
}

NestedNumbers numbersInJSONTree(const nlohmann::json& value)
{
  NestedNumbers numbers;
  append(value, "", 0, numbers);
  return numbers;
}

NestedNumbers numbersInIndentedText(const std::string& text)
{
  NestedNumbers numbers;
  std::vector<Level> open;
  int topItems = 0;
  TextLines lines(text);
  while (lines.next())
  {
    std::string_view line = lines.line();
    std::size_t indent = line.find_first_not_of(Blanks);
    line.remove_prefix(indent);
    const auto closeTo = [&](std::size_t least)
    {
      while (!open.empty() && open.back().indent >= least)
      {
        open.pop_back();
      }
    };
    if (line.substr(0, 2) == "- ")
    {
      // An item may stand as far to the left as the name that its list is under; items before it are closed.
      while (!open.empty() && (open.back().indent > indent || (open.back().indent == indent && open.back().items < 0)))
      {
        open.pop_back();
      }
      const int place = open.empty() ? topItems++ : open.back().items++;
      open.push_back({ indent, std::to_string(place), -1 });
      const std::size_t blanks = line.find_first_not_of(Blanks, 1);
      indent += std::min(blanks, line.size());
      line.remove_prefix(std::min(blanks, line.size()));
    }
    else
    {
      closeTo(indent);
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || open.size() > static_cast<std::size_t>(MostNested))
    {
      continue;
    }
    std::string name;
    for (const Level& level : open)
    {
      name += level.name + ".";
    }
    const std::string_view value = trimmed(line.substr(colon + 1));
    const std::string key(trimmed(line.substr(0, colon)).substr(0, MostName));
    double number = 0.0;
    if (value.empty())
    {
      open.push_back({ indent, key, 0 });
    }
    else if (name.size() + key.size() < MostName && parseNumber(value, number))
    {
      numbers[name + key] = number;
    }
  }
  return numbers;
}
}
