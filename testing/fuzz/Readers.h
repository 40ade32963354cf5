// SPDX-License-Identifier: BSD-3-Clause
// Every reader of files that core/ has, for the tests that give them damaged ones.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace fuzz
{
struct Reader
{
  const char* name;                      ///< also of its folder in corpus/
  const char* file;                      ///< name of the file it reads
  void (*read)(const std::string& path); ///< throws meam::Error for a file that it refuses
  // Of memory it may take at once so many times the file's length, and so many MB beside.
  std::size_t timesLength = 10;
  std::size_t megabytes = 16;
  /// Gives check sums that hide all other damage their right value again; null without such.
  std::string (*mend)(std::string bytes) = nullptr;
  int oneOf = 1; ///< of so many damaged files it gets one, for it takes as much longer
};

/// How a test that fails shows it.
inline void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }

const std::vector<Reader>& readers();

/// The reader of that name; null without.
const Reader* readerOf(const std::string& name);
}
