// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/JSONFile.h"

#include "base/Error.h"
#include "io/parsing/TextLines.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <set>

namespace meam
{
namespace
{
constexpr int MostNested = 4;          // arrays in arrays: a matrix has two
constexpr std::size_t MostLevels = 64; // of a file; copies and comparisons call themselves for each

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

/// What the parser lets pass, and keeps for itself: how deep lists and objects stand in each other, and keys.
class Check : public nlohmann::json_sax<nlohmann::json>
{
public:
  bool isNestedTooDeep = false;
  std::string keyTwice;
  bool hasKeyTwice = false;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return this->open(); }
  bool start_array(std::size_t) override { return this->open(); }
  bool end_object() override { return this->close(); }
  bool end_array() override { return this->close(); }
  bool key(string_t& key) override
  {
    this->hasKeyTwice = !this->Keys.back().insert(key).second;
    this->keyTwice = this->hasKeyTwice ? key : "";
    return !this->hasKeyTwice;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

private:
  bool open()
  {
    this->isNestedTooDeep = this->Keys.size() == MostLevels;
    this->Keys.emplace_back();
    return !this->isNestedTooDeep;
  }
  bool close()
  {
    this->Keys.pop_back();
    return true;
  }

  std::vector<std::set<std::string>> Keys; // of what is open
};
}

void failKeyTwice(const std::string& path, const std::string& key)
{
  throw Error(
    "The file '" + path + "' has the key '" + key.substr(0, 40) + "' twice in one object: leave the one that counts.");
}

nlohmann::json parseJSON(const std::string& path, const std::string& text)
{
  // Not by the parser's callback: with one it goes, at the end of each object, through all that the list so far has.
  Check check;
  nlohmann::json::sax_parse(text, &check);
  if (check.isNestedTooDeep)
  {
    throw Error("The file '" + path + "' has lists in lists " + std::to_string(MostLevels) +
                " times over: it is damaged, or no file of this kind.");
  }
  if (check.hasKeyTwice)
  {
    failKeyTwice(path, check.keyTwice);
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
