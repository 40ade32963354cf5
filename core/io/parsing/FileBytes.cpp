// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/FileBytes.h"

#include "base/Error.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace meam
{
namespace fs = std::filesystem;

namespace
{
std::string reason() { return errno != 0 ? std::string(": ") + std::strerror(errno) + "." : "."; }

/// What a download leaves in place of a file, and what to do; empty: nothing of this kind.
std::string standInOf(const std::string& bytes)
{
  constexpr std::size_t Longest = 200; // letters, of white space before a page, too
  std::string start = bytes.substr(0, Longest);
  start.erase(0, std::min(start.find_first_not_of(" \t\r\n"), start.size()));
  std::transform(start.begin(), start.end(), start.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  const auto begins = [&](const std::string& word) { return start.compare(0, word.size(), word) == 0; };
  return begins("version https://git-lfs")             ? "a pointer of Git LFS: git lfs pull fetches the file"
         : begins("<!doctype html") || begins("<html") ? "a web page: download the file itself, which pages call raw"
                                                       : "";
}

/// False, with errno set where the system gave a reason, unless every byte arrived.
bool put(const std::string& path, const std::string& bytes)
{
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  return static_cast<bool>(file);
}
}

void writeFile(const std::string& path, const std::string& bytes)
{
  const std::string what = "The file '" + path + "' cannot be written";
  std::error_code failure;
  if (fs::exists(path, failure) && !fs::is_regular_file(path, failure))
  {
    // A device or a pipe must not be renamed over.
    if (fs::is_directory(path, failure) || !put(path, bytes))
    {
      throw Error(what + (fs::is_directory(path, failure) ? ": it is a folder." : reason()));
    }
    return;
  }
  static std::atomic<unsigned> counter{ 0 };
  const std::string temporary = path + "." + std::to_string(getpid()) + "-" + std::to_string(counter++) + ".part";
  if (!put(temporary, bytes))
  {
    const std::string why = reason();
    fs::remove(temporary, failure);
    throw Error(what + why);
  }
  fs::rename(temporary, path, failure);
  if (failure)
  {
    const std::string why = failure.message();
    fs::remove(temporary, failure);
    throw Error(what + ": " + why + ".");
  }
}

std::string readFile(const std::string& path, std::int64_t most)
{
  const std::string what = "The file '" + path + "' cannot be read";
  std::error_code failure;
  if (fs::is_directory(path, failure))
  {
    throw Error(what + ": it is a folder.");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::int64_t size = file ? std::min<std::int64_t>(file.tellg(), most) : -1;
  if (size < 0)
  {
    throw Error(what + reason());
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.seekg(0);
  if (!file.read(bytes.data(), size))
  {
    throw Error(what + (file.eof() ? ": it was cut off while it was read." : reason()));
  }
  const std::string standIn = standInOf(bytes);
  if (!standIn.empty())
  {
    throw Error(what + ": it is " + standIn + ".");
  }
  return bytes;
}

std::string readText(const std::string& path, std::int64_t most)
{
  std::string bytes = readFile(path, most);
  const std::string mark = bytes.substr(0, 2);
  const std::size_t low = mark == "\xff\xfe" ? 0 : 1; // where the low byte of a letter is
  if (low == 1 && mark != "\xfe\xff")
  {
    return bytes;
  }
  const std::size_t letters = bytes.size() / 2 - 1;
  for (std::size_t i = 0; i < letters; ++i)
  {
    const char letter = bytes[2 * i + 2 + low], page = bytes[2 * i + 3 - low];
    bytes[i] = page == 0 && static_cast<unsigned char>(letter) < 128 ? letter : '?';
  }
  bytes.resize(letters);
  return bytes;
}

std::string extensionOf(const std::string& path)
{
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}
}
