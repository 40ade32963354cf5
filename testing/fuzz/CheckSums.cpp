// SPDX-License-Identifier: BSD-3-Clause
#include "CheckSums.h"

#include <boost/crc.hpp>

#include <cstdint>
#include <string_view>

namespace fuzz
{
namespace
{
/// CRC-32, as PNG and our own files have it.
std::uint32_t checkSum(std::string_view bytes)
{
  boost::crc_32_type sum;
  sum.process_bytes(bytes.data(), bytes.size());
  return sum.checksum();
}
}

std::string withModelCheckSum(std::string bytes)
{
  constexpr std::size_t start = 12; // signature and version
  if (bytes.size() >= start + 4)
  {
    const std::size_t end = bytes.size() - 4;
    const std::uint32_t sum = checkSum(std::string_view(bytes).substr(start, end - start));
    bytes.replace(end, 4, reinterpret_cast<const char*>(&sum), 4);
  }
  return bytes;
}

std::string withPNGCheckSums(std::string png)
{
  const auto byteAt = [&](std::size_t at) { return static_cast<unsigned char>(png[at]); };
  for (std::size_t at = 8; png[0] == '\x89' && at + 12 <= png.size();)
  {
    const std::size_t length =
      std::size_t(byteAt(at)) << 24 | byteAt(at + 1) << 16 | byteAt(at + 2) << 8 | byteAt(at + 3);
    if (length > png.size() - at - 12)
    {
      break;
    }
    const std::uint32_t sum = checkSum(std::string_view(png).substr(at + 4, 4 + length));
    for (int i = 0; i < 4; ++i)
    {
      png[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    }
    at += 12 + length;
  }
  return png;
}
}
