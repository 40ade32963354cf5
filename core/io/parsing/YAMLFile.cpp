// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/YAMLFile.h"

#include "base/Error.h"
#include "io/parsing/JSONFile.h"
#include "io/parsing/TextLines.h"

#include <nlohmann/json.hpp>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <cmath>
#include <sstream>
#include <vector>

namespace meam
{
namespace
{
constexpr std::size_t MostOpen = 64; // the parser calls itself for each

/// Builds JSON from what the parser comes across.
class JSONBuilder : public YAML::EventHandler
{
public:
  nlohmann::json root;

  explicit JSONBuilder(const std::string& path)
    : Path(path)
  {
  }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { this->addScalar(mark, "", nullptr); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override
  {
    throw Error("The file '" + this->Path + "' has an alias in line " + std::to_string(mark.line + 1) +
                ", which is not read: write there what it stands for.");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& value) override
  {
    double number = 0.0;
    const bool isQuoted = tag == "!";
    const bool isNumber = !isQuoted && parseNumber(std::string_view(value), number) && std::isfinite(number);
    this->addScalar(mark, value, isNumber ? nlohmann::json(number) : nlohmann::json(value));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override
  {
    this->open(mark, nlohmann::json::array());
  }
  void OnSequenceEnd() override { this->Open.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override
  {
    this->open(mark, nlohmann::json::object());
  }
  void OnMapEnd() override { this->Open.pop_back(); }

private:
  struct Level
  {
    nlohmann::json* list; ///< or map
    nlohmann::json* next; ///< value of the key that came last; null: a key comes next
  };

  void addScalar(const YAML::Mark& mark, const std::string& text, nlohmann::json value)
  {
    if (!this->Open.empty() && this->Open.back().list->is_object() && !this->Open.back().next)
    {
      const auto [place, isNew] = this->Open.back().list->emplace(text, nullptr);
      if (!isNew)
      {
        failKeyTwice(this->Path, text);
      }
      this->Open.back().next = &*place;
      return;
    }
    this->add(mark, std::move(value));
  }

  /// The value, where it stands now.
  nlohmann::json& add(const YAML::Mark& mark, nlohmann::json value)
  {
    if (this->Open.empty())
    {
      return this->root = std::move(value);
    }
    Level& level = this->Open.back();
    if (level.list->is_array())
    {
      level.list->push_back(std::move(value));
      return level.list->back();
    }
    if (!level.next)
    {
      throw YAML::ParserException(mark, "a list is no name");
    }
    nlohmann::json& place = *level.next = std::move(value);
    level.next = nullptr;
    return place;
  }

  void open(const YAML::Mark& mark, nlohmann::json list)
  {
    if (this->Open.size() == MostOpen)
    {
      throw YAML::ParserException(mark, "lists in lists " + std::to_string(MostOpen) + " times over");
    }
    nlohmann::json& place = this->add(mark, std::move(list)); // stays there until it is closed
    this->Open.push_back({ &place, nullptr });
  }

  const std::string& Path;
  std::vector<Level> Open;
};
}

nlohmann::json parseYAML(const std::string& path, const std::string& text)
{
  // Before the parser, which keeps all that opens until it closes.
  int open = 0;
  for (const char letter : text)
  {
    open += letter == '[' || letter == '{' ? 1 : letter == ']' || letter == '}' ? -1 : 0;
    if (open > static_cast<int>(MostOpen))
    {
      throw Error("The file '" + path + "' has lists in lists " + std::to_string(MostOpen) +
                  " times over: it is damaged, or no file of this kind.");
    }
  }
  JSONBuilder builder(path);
  try
  {
    std::istringstream stream(text);
    YAML::Parser(stream).HandleNextDocument(builder);
  }
  catch (const YAML::Exception& error)
  {
    throw Error("The file '" + path + "' is not YAML in line " + std::to_string(error.mark.line + 1) + ": " +
                error.msg + ". It is cut off or damaged.");
  }
  return std::move(builder.root);
}
}
