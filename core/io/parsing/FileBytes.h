// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace meam
{
/// Writes `bytes` to a temporary file beside `path` and renames it, so that nobody ever finds half
/// a file. Throws Error, naming the file, when that is not possible.
void writeFile(const std::string& path, const std::string& bytes);

/// The bytes of a file, at most so many from its start. Throws Error, naming the file, when it is missing or
/// unreadable, and when it is a web page or a pointer of Git LFS.
std::string readFile(const std::string& path, std::int64_t most = INT64_MAX);

/// The bytes of a file of text, as readFile() has them; of one in UTF-16 that begins with a byte order mark, as some
/// programs of Windows write it, the letters of ASCII, with '?' in place of others.
std::string readText(const std::string& path, std::int64_t most = INT64_MAX);

/// The extension of a file's name in lower case: ".ply".
std::string extensionOf(const std::string& path);
}
