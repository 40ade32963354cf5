// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace meam
{
/// Names, and the numbers under them.
using NamedNumbers = std::map<std::string, std::vector<double>>;

/// The numbers in a text that OpenCV's FileStorage wrote, in YAML or XML: those of the first level, lists and
/// matrices among them, row by row. What holds no numbers is left out; a word in a list of numbers becomes NaN.
/// OpenCV's own reader ends the program on damaged files. Throws Error, naming the file `path` that the text is from,
/// when it is neither.
NamedNumbers numbersInStorage(const std::string& path, const std::string& text);
}
