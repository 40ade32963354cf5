// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>

namespace meam
{
/// Numbers by the names that lead to them, as in "transform.translation.x"; those with names of more than 256
/// characters are left out.
using NestedNumbers = std::map<std::string, double>;

/// The numbers of a JSON value. Places in arrays are names from 0 on.
NestedNumbers numbersInJSONTree(const nlohmann::json& value);

/// The numbers in lines `name: value` that indentation puts under others, as YAML of messages has them; the lines of a
/// list's item, "- ", are under the item's place, from 0 on. What is no number is left out, as are all other forms of
/// YAML.
NestedNumbers numbersInIndentedText(const std::string& text);
}
