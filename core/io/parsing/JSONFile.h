// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace meam
{
/// What a JSON text holds. Throws Error, naming the file `path` it is from, when it is not JSON, has a key twice in an
/// object, or is nested as no file for this program is.
nlohmann::json parseJSON(const std::string& path, const std::string& text);

/// Throws the Error for a key that comes twice, of which a parser keeps one.
[[noreturn]] void failKeyTwice(const std::string& path, const std::string& key);

/// The numbers of a JSON value: one, or those of an array and of arrays in it, in their order. Throws Error,
/// naming the file and `what`, for anything else and for a number that is not finite.
std::vector<double> numbersOf(const nlohmann::json& value, const std::string& path, const std::string& what);

/// The number that a key of a JSON object is: "12". Throws Error, naming the file, for another key.
int idOf(const std::string& key, const std::string& path);
}
