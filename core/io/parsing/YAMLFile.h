// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace meam
{
/// The first document of a YAML text, as JSON: plain scalars that are finite numbers are numbers, all others are texts,
/// and tags such as !!opencv-matrix are left out. Throws Error, naming the file `path` it is from, when it is not YAML,
/// has aliases, keys that are no scalars or a key twice in a map, or is nested as no file for this program is.
nlohmann::json parseYAML(const std::string& path, const std::string& text);
}
