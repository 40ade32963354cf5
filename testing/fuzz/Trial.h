// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Readers.h"

#include <filesystem>

namespace fuzz
{
/// A folder of its own, in memory where that can be, in which a reader gets one file after the other.
class Trial
{
public:
  explicit Trial(const Reader& reader);
  ~Trial();
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  /// Whether the reader takes a file of these bytes; false when it refuses it by a meam::Error with a message. Any
  /// other exception comes out. Under the sanitizers more memory than the reader may take for it ends the program.
  bool reads(const std::string& bytes) const;

private:
  const Reader& Tried;
  std::filesystem::path Folder;
};
}
