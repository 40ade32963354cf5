// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace meam
{
/// Writes `bytes` to a temporary file beside `path` and renames it, so that nobody ever finds half
/// a file. Throws Error, naming the file, when that is not possible.
void writeFile(const std::string& path, const std::string& bytes);

/// All bytes of a file. Throws Error, naming the file, when it is missing or unreadable.
std::string readFile(const std::string& path);

/// The extension of a file's name in lower case: ".ply".
std::string extensionOf(const std::string& path);
}
