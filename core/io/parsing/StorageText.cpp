// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/StorageText.h"

#include "base/Error.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

namespace meam
{
namespace
{
constexpr const char* Blanks = " \t\r\n";
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void fail(const std::string& path, const std::string& what)
{
  throw Error("The file '" + path + "' " + what + ".");
}

/// The words between separators as numbers; a word that is none becomes NaN.
std::vector<double> numbersIn(std::string_view text, const char* separators)
{
  std::vector<double> numbers;
  for (std::size_t at = text.find_first_not_of(separators); at < text.size();)
  {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    const char* first = text.data() + at + (text[at] == '+' ? 1 : 0);
    double value = 0.0;
    const auto [stop, failure] = std::from_chars(first, text.data() + end, value);
    numbers.push_back(failure == std::errc() && stop == text.data() + end ? value : NaN);
    at = text.find_first_not_of(separators, end);
  }
  return numbers;
}

/// One past the bracket that closes the one at `at`; npos without.
std::size_t endOfList(const std::string& text, std::size_t at)
{
  int open = 0;
  for (; at < text.size(); ++at)
  {
    open += text[at] == '[' ? 1 : text[at] == ']' ? -1 : 0;
    if (open == 0)
    {
      return at + 1;
    }
  }
  return std::string::npos;
}

/// Lines `name: value` and, below a name, `data: [...]`, as of a matrix.
NamedNumbers numbersInYAML(const std::string& path, const std::string& text)
{
  NamedNumbers result;
  std::string name;
  for (std::size_t line = 0; line < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', line), text.size());
    const std::size_t first = std::min(text.find_first_not_of(" \t", line), end);
    const std::size_t colon = std::min(std::string_view(text).substr(0, end).find(':', first), end);
    const bool skipped = colon == end || text[first] == '%' || text[first] == '#';
    const std::string key = skipped ? "" : text.substr(first, colon - first);
    name = !skipped && first == line ? key : name;
    line = end + 1;
    if (skipped || (key != name && key != "data"))
    {
      continue;
    }
    std::size_t value = text.find_first_not_of(Blanks, colon + 1);
    if (value < text.size() && text[value] == '!') // the type, such as !!opencv-matrix
    {
      value = text.find_first_not_of(Blanks, text.find_first_of(Blanks, value));
    }
    if (value < text.size() && text[value] == '[')
    {
      const std::size_t stop = endOfList(text, value);
      if (stop == std::string::npos)
      {
        fail(path, "ends within a list of numbers: it is cut off");
      }
      result[name] = numbersIn(std::string_view(text).substr(value, stop - value), "[], \t\r\n");
      line = std::max(line, stop);
    }
    else if (value < end)
    {
      const std::vector<double> number = numbersIn(std::string_view(text).substr(value, end - value), Blanks);
      if (number.size() == 1)
      {
        result[name] = number;
      }
    }
  }
  return result;
}

/// Elements <name>numbers</name> and <name><data>numbers</data></name> within the first one.
NamedNumbers numbersInXML(const std::string& path, const std::string& text)
{
  NamedNumbers result;
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
  {
    const bool comment = text.compare(at, 4, "<!--") == 0;
    const std::string_view close = comment ? "-->" : ">";
    std::size_t end = text.find(close, at);
    if (end == std::string::npos)
    {
      fail(path, "ends within a tag: it is cut off");
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
        fail(path, "has a tag '" + tag.substr(0, 40) + "' in the wrong place: it is damaged");
      }
      open.pop_back();
      continue;
    }
    open.push_back(tag.substr(0, tag.find_first_of(Blanks)));
    if (open.size() == 2 || (open.size() == 3 && open.back() == "data"))
    {
      end = std::min(text.find('<', at), text.size());
      const std::vector<double> numbers = numbersIn(std::string_view(text).substr(at, end - at), Blanks);
      if (!numbers.empty())
      {
        result[open[1]] = numbers;
      }
    }
  }
  if (!open.empty())
  {
    fail(path, "has no end of <" + open.back().substr(0, 40) + ">: it is cut off");
  }
  return result;
}
}

NamedNumbers numbersInStorage(const std::string& path, const std::string& text)
{
  const std::size_t first = text.find_first_not_of(Blanks);
  if (first == std::string::npos)
  {
    fail(path, "is empty");
  }
  return text[first] == '<' ? numbersInXML(path, text) : numbersInYAML(path, text);
}
}
