// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's way in: the reader is the one that the environment variable MEAM_READER names.
#include "Trial.h"

#include <cstdint>
#include <cstdlib>

namespace
{
const fuzz::Reader& chosen()
{
  const char* name = std::getenv("MEAM_READER");
  const fuzz::Reader* reader = fuzz::readerOf(name ? name : "");
  if (!reader)
  {
    std::fprintf(stderr, "MEAM_READER has to name a reader:");
    for (const fuzz::Reader& known : fuzz::readers())
    {
      std::fprintf(stderr, " %s", known.name);
    }
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  return *reader;
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const fuzz::Reader& reader = chosen();
  static const fuzz::Trial trial(reader);
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  trial.reads(reader.mend ? reader.mend(bytes) : bytes);
  return 0;
}
