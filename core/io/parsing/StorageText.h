// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace meam
{
/// What a text of OpenCV's FileStorage holds, in YAML, JSON or XML; of XML the elements without their attributes,
/// where a word among numbers that is none becomes NaN. OpenCV's own reader ends the program on damaged files.
/// Throws Error, naming the file `path` that the text is from, when it is none of them.
nlohmann::json parseStorage(const std::string& path, const std::string& text);

/// The numbers of an entry, row by row: a number, a list, or a matrix with its list `data`. Throws Error as
/// numbersOf().
std::vector<double> numbersOfMatrix(const nlohmann::json& value, const std::string& path, const std::string& what);
}
