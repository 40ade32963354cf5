// SPDX-License-Identifier: BSD-3-Clause
#include "io/PortableMap.h"

#include "base/Error.h"
#include "io/parsing/TextLines.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace meam
{
namespace
{
constexpr std::string_view Blanks = " \t\r\n\v\f";
constexpr std::uint32_t MostOfByte = 255, MostOfTwo = 65535;

[[noreturn]] void failMap(const std::string& path, const std::string& what)
{
  throw Error("The image '" + path + "' " + what + ".");
}

/// Goes through the words of a PGM or PFM; a comment goes from # to the end of the line.
class MapWords
{
public:
  explicit MapWords(std::string_view bytes)
    : Bytes(bytes)
  {
  }

  /// The next word; empty at the end of the file.
  std::string_view next()
  {
    while (
      (this->At = std::min(this->Bytes.find_first_not_of(Blanks, this->At), this->Bytes.size())) < this->Bytes.size() &&
      this->Bytes[this->At] == '#')
    {
      this->At = std::min(this->Bytes.find_first_of("\r\n", this->At), this->Bytes.size());
    }
    const std::size_t end = std::min(this->Bytes.find_first_of(" \t\r\n\v\f#", this->At), this->Bytes.size());
    const std::string_view word = this->Bytes.substr(this->At, end - this->At);
    this->At = end;
    return word;
  }

  /// What follows the last word.
  std::string_view rest() const { return this->Bytes.substr(this->At); }

private:
  std::string_view Bytes;
  std::size_t At = 0;
};

struct MapHeader
{
  char kind = 0; ///< the second letter: 2 plain PGM, 5 binary PGM, f PFM
  std::uint64_t width = 0, height = 0;
  std::string_view last; ///< the largest value of a PGM, the scale of a PFM
  std::string_view rest; ///< from the end of the header on
};

MapHeader mapHeaderOf(std::string_view bytes)
{
  MapWords words(bytes);
  MapHeader header;
  header.kind = words.next()[1];
  const bool isSize = parseNumber(words.next(), header.width) && parseNumber(words.next(), header.height);
  header.last = words.next();
  header.rest = words.rest();
  if (!isSize || header.last.empty())
  {
    header.width = header.height = 0;
  }
  return header;
}

/// The bytes of the pixels, one blank behind the header; some programs write two where lines end with CR and LF.
std::string_view pixelBytes(const std::string& path, const MapHeader& header, std::uint64_t bytesOfPixel)
{
  const std::uint64_t length = header.width * header.height * bytesOfPixel;
  std::string_view rest = header.rest;
  rest.remove_prefix(
    rest.size() == length + 2 && rest.substr(0, 2) == "\r\n" ? 2 : std::min<std::size_t>(rest.size(), 1));
  if (rest.size() < length)
  {
    failMap(path, "is cut off or damaged");
  }
  return rest.substr(0, length);
}

std::vector<float> plainValues(const std::string& path, const MapHeader& header, std::uint32_t most)
{
  std::vector<float> values;
  values.reserve(std::min<std::uint64_t>(header.width * header.height, header.rest.size()));
  MapWords words(header.rest);
  while (values.size() < header.width * header.height)
  {
    std::uint32_t value = 0;
    if (!parseNumber(words.next(), value) || value > most)
    {
      failMap(path, "is cut off or damaged");
    }
    values.push_back(static_cast<float>(value));
  }
  return values;
}

std::vector<float> binaryValues(const std::string& path, const MapHeader& header, std::uint32_t most)
{
  const std::size_t size = most > MostOfByte ? 2 : 1;
  const std::string_view bytes = pixelBytes(path, header, size);
  std::vector<float> values(header.width * header.height);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const auto high = static_cast<unsigned char>(bytes[size * i]);
    values[i] = static_cast<float>(size == 1 ? high : high << 8 | static_cast<unsigned char>(bytes[size * i + 1]));
  }
  return values;
}

std::vector<float> realValues(const std::string& path, const MapHeader& header)
{
  double scale = 0.0;
  if (!parseNumber(header.last, scale) || !std::isfinite(scale) || scale == 0.0)
  {
    failMap(path, "is damaged: its scale is '" + std::string(header.last.substr(0, 20)) + "'");
  }
  if (std::abs(scale) != 1.0)
  {
    failMap(path, "has a scale of " + std::string(header.last.substr(0, 20)) +
                    ", which programs take in different ways: write " + (scale < 0.0 ? "-1.0" : "1.0") +
                    " in its header, and give the depth scale (--depth-scale)");
  }
  const std::string_view bytes = pixelBytes(path, header, sizeof(float));
  std::vector<float> values(header.width * header.height);
  for (std::uint64_t i = 0; i < values.size(); ++i)
  {
    const std::uint64_t row = header.height - 1 - i / header.width, from = row * header.width + i % header.width;
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k)
    {
      bits =
        bits << 8 | static_cast<unsigned char>(bytes[4 * from + (scale < 0.0 ? 3 - k : k)]); // below 0: little-endian
    }
    std::memcpy(&values[i], &bits, sizeof bits);
  }
  return values;
}
}

bool isPortableMap(std::string_view bytes)
{
  return bytes.size() > 2 && bytes[0] == 'P' && std::string_view("25f").find(bytes[1]) != std::string_view::npos &&
         Blanks.find(bytes[2]) != std::string_view::npos;
}

std::array<std::uint64_t, 2> portableMapSize(std::string_view bytes)
{
  const MapHeader header = mapHeaderOf(bytes);
  return { header.width, header.height };
}

DepthPixels readPortableMap(const std::string& path, std::string_view bytes)
{
  const MapHeader header = mapHeaderOf(bytes);
  DepthPixels image{ static_cast<int>(header.width), static_cast<int>(header.height), {} };
  if (header.kind == 'f')
  {
    image.pixels = realValues(path, header);
    return image;
  }
  std::uint32_t most = 0;
  if (!parseNumber(header.last, most) || most < 1 || most > MostOfTwo)
  {
    failMap(path, "is damaged: its largest value is '" + std::string(header.last.substr(0, 20)) + "'");
  }
  image.pixels = header.kind == '2' ? plainValues(path, header, most) : binaryValues(path, header, most);
  if (most == MostOfByte || most == MostOfTwo)
  {
    std::replace(
      image.pixels.begin(), image.pixels.end(), static_cast<float>(most), std::numeric_limits<float>::quiet_NaN());
  }
  return image;
}
}
