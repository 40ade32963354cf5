// SPDX-License-Identifier: BSD-3-Clause
#include "io/ImageFile.h"

#include "base/Error.h"
#include "io/PortableMap.h"
#include "io/parsing/FileBytes.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

namespace meam
{
namespace
{
// No file that a camera writes has more pixels, and none of the formats packs more of them into a byte.
constexpr std::uint64_t MostPixels = 1 << 26;
constexpr std::uint64_t MostPixelsOfByte = 4096;

/// Of a file of so many bytes.
std::uint64_t mostPixels(std::uint64_t length)
{
  return std::min<std::uint64_t>(MostPixels, MostPixelsOfByte * length);
}

constexpr float NoDepth = std::numeric_limits<float>::quiet_NaN();

// Of a value: of an image, and of real numbers of a depth image.
constexpr std::uint64_t MostImageBits = 16;
constexpr std::uint64_t MostDepthBits = 64;

// A progressive JPEG has about ten; each goes through all pixels, however few bytes it has.
constexpr int MostScans = 500;

// Where the size stands in nearly all files: a JPEG may have a preview before it, a TIFF its pixels.
constexpr std::int64_t HeadLength = 1 << 16;

[[noreturn]] void failImage(const std::string& path, const std::string& what)
{
  throw Error("The image '" + path + "' " + what + ".");
}

struct Size
{
  std::uint64_t width = 0;
  std::uint64_t height = 0;
};

/// `count` bytes from a place in the file as a whole number; 0 beyond its end.
std::uint64_t numberAt(const std::string& bytes, std::uint64_t at, int count, bool bigEndian)
{
  std::uint64_t value = 0;
  for (int i = 0; at + count <= bytes.size() && i < count; ++i)
  {
    const auto byte = static_cast<unsigned char>(bytes[at + (bigEndian ? i : count - 1 - i)]);
    value = value << 8 | byte;
  }
  return value;
}

/// The first start-of-frame segment tells the size.
Size sizeOfJPEG(const std::string& bytes)
{
  for (std::uint64_t at = 2; at + 9 < bytes.size() && numberAt(bytes, at, 1, true) == 0xff;)
  {
    const std::uint64_t marker = numberAt(bytes, at + 1, 1, true);
    if (marker == 0)
    {
      break; // no marker: libjpeg looks for the next one
    }
    if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
    {
      return { numberAt(bytes, at + 7, 2, true), numberAt(bytes, at + 5, 2, true) };
    }
    const bool isAlone = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7); // TEM, RSTm: no length behind them
    // 0xff may be repeated in front of a marker.
    at += marker == 0xff ? 1 : isAlone ? 2 : 2 + std::max<std::uint64_t>(numberAt(bytes, at + 2, 2, true), 2);
  }
  return {};
}

namespace tiff
{
enum Name : std::uint64_t
{
  Width = 256,
  Height = 257,
  BitsPerSample = 258,
  Compression = 259,
  SamplesPerPixel = 277,
  RowsPerStrip = 278,
  TileWidth = 322,
  TileHeight = 323,
  SampleFormat = 339
};
enum Type : std::uint64_t
{
  Short = 3,
  Long = 4
};
enum Format : std::uint64_t
{
  Unsigned = 1,
  Signed = 2,
  Real = 3
};

struct Tag
{
  std::uint64_t at = 0; ///< where its first value stands in the file; 0: there is no such tag
  std::uint64_t type = 0;
  std::uint64_t value = 0; ///< the first of several; 0 beyond the file's end

  /// libtiff takes values of other types from elsewhere.
  bool isNumber() const { return this->type == Short || this->type == Long; }
};

bool isBigEndian(const std::string& bytes) { return bytes[0] == 'M'; }

/// Of the first directory; of several the first one, as libtiff has it.
Tag tagOf(const std::string& bytes, Name name)
{
  const bool big = isBigEndian(bytes);
  const std::uint64_t directory = numberAt(bytes, 4, 4, big);
  const std::uint64_t tags = numberAt(bytes, directory, 2, big);
  for (std::uint64_t k = 0; k < tags; ++k)
  {
    const std::uint64_t at = directory + 2 + 12 * k;
    if (numberAt(bytes, at, 2, big) == name)
    {
      const std::uint64_t type = numberAt(bytes, at + 2, 2, big), count = numberAt(bytes, at + 4, 4, big);
      const int length = type == Short ? 2 : 4;
      const std::uint64_t first = length * count > 4 ? numberAt(bytes, at + 8, 4, big) : at + 8;
      return { first, type, numberAt(bytes, first, length, big) };
    }
  }
  return {};
}

Size sizeOf(const std::string& bytes)
{
  const Tag width = tagOf(bytes, Width), height = tagOf(bytes, Height);
  return width.isNumber() && height.isNumber() ? Size{ width.value, height.value } : Size{};
}

/// Writes a number in place of that of a tag.
void set(std::string& bytes, const Tag& tag, std::uint64_t value)
{
  const int length = tag.type == Short ? 2 : 4;
  for (int i = 0; i < length; ++i)
  {
    const int shift = 8 * (isBigEndian(bytes) ? length - 1 - i : i);
    bytes[tag.at + i] = static_cast<char>(value >> shift & 0xff);
  }
}
}

Size sizeOf(const std::string& path, const std::string& bytes)
{
  const auto starts = [&](const std::string& magic) { return bytes.compare(0, magic.size(), magic) == 0; };
  if (starts("\x89PNG\r\n\x1a\n"))
  {
    const bool isHeader = numberAt(bytes, 12, 4, true) == 0x49484452; // IHDR
    return isHeader ? Size{ numberAt(bytes, 16, 4, true), numberAt(bytes, 20, 4, true) } : Size{};
  }
  if (starts("\xff\xd8"))
  {
    return sizeOfJPEG(bytes);
  }
  if (starts("BM"))
  {
    const auto height = static_cast<std::int32_t>(numberAt(bytes, 22, 4, false));
    return { numberAt(bytes, 18, 4, false), static_cast<std::uint64_t>(std::abs(static_cast<std::int64_t>(height))) };
  }
  if (starts(std::string("II*\0", 4)) || starts(std::string("MM\0*", 4)))
  {
    return tiff::sizeOf(bytes);
  }
  if (isPortableMap(bytes))
  {
    const auto [width, height] = portableMapSize(bytes);
    return { width, height };
  }
  if (starts("\x76\x2f\x31\x01"))
  {
    failImage(path, "is an OpenEXR image, which is not read: save depth as PFM, or as TIFF of real numbers");
  }
  failImage(
    path, "is not a PNG, JPEG, BMP or TIFF image: save images as PNG, depth as PNG, TIFF, PGM or PFM of one channel");
}

/// The size that a file's first bytes tell, once it is sure that a file of that length can have it.
Size checkedSize(const std::string& path, const std::string& bytes, std::uint64_t length)
{
  const Size size = sizeOf(path, bytes);
  if (size.width == 0 || size.height == 0)
  {
    failImage(path, "is cut off or damaged: its header has no size");
  }
  const std::uint64_t most = mostPixels(length);
  if (size.width > most || size.height > most || size.width * size.height > most)
  {
    failImage(path, "promises " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                      " pixels, more than the file has room for: it is cut off or damaged");
  }
  return size;
}

/// What makes a decoder take memory that neither the size nor the length of a TIFF file justifies is refused; strips
/// that are higher than the image are made as high as it.
void checkTIFF(const std::string& path, std::string& bytes, const Size& size, std::uint64_t mostBits)
{
  // Without JBIG and LZMA, which take as much memory as their own headers say.
  constexpr std::array<std::uint64_t, 9> known{ 1, 2, 3, 4, 5, 7, 8, 32773, 32946 };
  constexpr std::uint64_t mostSamples = 4; // what images are read of
  const auto isDamaged = [](const tiff::Tag& tag) { return tag.at > 0 && !tag.isNumber(); };
  const tiff::Tag compression = tiff::tagOf(bytes, tiff::Compression);
  if (isDamaged(compression) ||
      (compression.at > 0 && std::find(known.begin(), known.end(), compression.value) == known.end()))
  {
    failImage(path, "is compressed in a way that is not read (" + std::to_string(compression.value) +
                      "): save it without, with LZW or with Deflate");
  }
  const tiff::Tag bits = tiff::tagOf(bytes, tiff::BitsPerSample), samples = tiff::tagOf(bytes, tiff::SamplesPerPixel);
  if (isDamaged(bits) || isDamaged(samples) || bits.value > mostBits || samples.value > mostSamples)
  {
    failImage(path, "is neither grey nor coloured with 8 or 16 bits");
  }
  const tiff::Tag rows = tiff::tagOf(bytes, tiff::RowsPerStrip);
  const tiff::Tag tileWidth = tiff::tagOf(bytes, tiff::TileWidth), tileHeight = tiff::tagOf(bytes, tiff::TileHeight);
  if (isDamaged(rows) || isDamaged(tileWidth) || isDamaged(tileHeight) || (tileWidth.at > 0) != (tileHeight.at > 0) ||
      tileWidth.value * tileHeight.value > mostPixels(bytes.size()))
  {
    failImage(
      path, "is cut off or damaged: its strips or tiles have no size, or more pixels than the file has room for");
  }
  if (rows.value > size.height)
  {
    tiff::set(bytes, rows, size.height);
  }
}

/// OpenCV reads whole numbers of 32 bits with a sign alone: what they have without one is none, as what is too far. Of
/// other numbers it prints, or takes real ones of 16 bits for whole ones.
void checkSamples(const std::string& path, std::string& bytes)
{
  const tiff::Tag bits = tiff::tagOf(bytes, tiff::BitsPerSample), format = tiff::tagOf(bytes, tiff::SampleFormat);
  const std::uint64_t kind = format.at > 0 ? format.value : std::uint64_t(tiff::Unsigned);
  if (bits.value == 32 && kind == tiff::Unsigned && format.type == tiff::Short)
  {
    tiff::set(bytes, format, tiff::Signed);
    return;
  }
  const bool isKnown = kind == tiff::Real ? bits.value == 32 || bits.value == 64
                                          : bits.value <= 16 || (bits.value == 32 && kind == tiff::Signed);
  if (!isKnown)
  {
    failImage(path, std::string("has ") + (kind == tiff::Real ? "real" : "whole") + " numbers of " +
                      std::to_string(bits.value) +
                      " bits, which are not read: save whole ones of 16 or 32 bits, or real ones of 32 or 64");
  }
}

/// Whether a JPEG file has more scans than can be. Within one the two bytes that start another do not stand.
bool hasTooManyScans(const std::string& bytes)
{
  int scans = 0;
  for (std::size_t at = 0; (at = bytes.find("\xff\xda", at)) != std::string::npos && scans <= MostScans; at += 2)
  {
    ++scans;
  }
  return bytes[0] == '\xff' && scans > MostScans;
}

/// Whether a PNG file has its last chunk.
bool isWholePNG(const std::string& bytes)
{
  std::uint64_t at = 8;
  while (at + 12 <= bytes.size() && numberAt(bytes, at + 4, 4, true) != 0x49454e44) // IEND
  {
    at += 12 + numberAt(bytes, at, 4, true);
  }
  return at + 12 <= bytes.size();
}

/// Whether a BMP file has all of its rows; of a packed one only its decoder can tell.
bool isWholeBMP(const std::string& bytes, const Size& size)
{
  constexpr std::uint64_t PlainHeader = 40;
  if (numberAt(bytes, 14, 4, false) < PlainHeader || numberAt(bytes, 30, 4, false) != 0)
  {
    return true;
  }
  const std::uint64_t row = (size.width * numberAt(bytes, 28, 2, false) + 31) / 32 * 4;
  return numberAt(bytes, 10, 4, false) + row * size.height <= bytes.size();
}

/// Finds most files that are cut off before a decoder writes to the console about them.
bool isWhole(const std::string& bytes, const Size& size)
{
  return bytes[0] == '\x89' ? isWholePNG(bytes) : bytes[0] != 'B' || isWholeBMP(bytes, size);
}

/// What OpenCV makes of the bytes of a file, channels and depth as they are.
cv::Mat decode(const std::string& path, std::string bytes, std::uint64_t mostBits)
{
  const Size size = checkedSize(path, bytes, bytes.size());
  if (bytes[0] == 'I' || bytes[0] == 'M')
  {
    checkTIFF(path, bytes, size, mostBits);
    checkSamples(path, bytes);
  }
  if (!isWhole(bytes, size))
  {
    failImage(path, "is cut off or damaged");
  }
  if (hasTooManyScans(bytes))
  {
    failImage(path, "is damaged: it goes through its pixels more than " + std::to_string(MostScans) + " times");
  }
  cv::Mat pixels;
  try
  {
    const cv::Mat file(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data());
    pixels = cv::imdecode(file, cv::IMREAD_UNCHANGED);
  }
  catch (const cv::Exception&)
  {
    pixels.release();
  }
  if (pixels.cols != static_cast<int>(size.width) || pixels.rows != static_cast<int>(size.height))
  {
    failImage(path, "is cut off or damaged");
  }
  return pixels;
}

/// Whether neighbouring values of two bytes would be far nearer to each other with these in the other order, as some
/// programs write them.
bool isSwapped(const std::vector<float>& values)
{
  constexpr float Most = std::numeric_limits<std::uint16_t>::max();
  constexpr std::uint64_t FarNearer = 8; // times
  std::uint64_t steps = 0, stepsSwapped = 0;
  bool hasLowerBytes = false; // without, they may be of one byte, in the higher one
  const auto stepOf = [](std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; };
  const auto swapped = [](std::uint32_t value) { return (value & 0xff) << 8 | value >> 8; };
  for (std::size_t i = 1; i < values.size(); ++i)
  {
    const float before = values[i - 1], value = values[i];
    if (value > Most || value != std::floor(value))
    {
      if (!std::isnan(value))
      {
        return false; // not of two bytes
      }
    }
    else if (before > 0.0f && value > 0.0f)
    {
      const auto a = static_cast<std::uint32_t>(before), b = static_cast<std::uint32_t>(value);
      hasLowerBytes = hasLowerBytes || (b & 0xff) != 0;
      steps += stepOf(a, b);
      stepsSwapped += stepOf(swapped(a), swapped(b));
    }
  }
  return hasLowerBytes && steps > FarNearer * stepsSwapped;
}

/// The largest value that a camera has whose values, in 16 bits, are of 8, 10, 12, 14 or 16 bits; labels are of 8.
double mostOfDeep(const cv::Mat& pixels)
{
  double most = 0.0;
  cv::minMaxLoc(pixels.reshape(1), nullptr, &most);
  int bits = 8;
  while (most >= std::exp2(bits))
  {
    bits += 2;
  }
  return std::exp2(bits) - 1.0;
}

/// The values of a depth image; those that stand for what was too far are none.
DepthPixels decodeDepth(const std::string& path, std::string bytes)
{
  if (isPortableMap(bytes))
  {
    checkedSize(path, bytes, bytes.size());
    return readPortableMap(path, bytes);
  }
  cv::Mat pixels = decode(path, std::move(bytes), MostDepthBits);
  const int depth = pixels.depth();
  if (pixels.channels() != 1 || pixels.elemSize1() < 2)
  {
    failImage(path, "has " + std::to_string(pixels.channels()) + " channels of " +
                      std::to_string(8 * pixels.elemSize1()) +
                      " bits: a depth image has one of whole numbers of 16 "
                      "or 32 bits, or of real ones");
  }
  const float saturated = depth == CV_16U   ? std::numeric_limits<std::uint16_t>::max()
                          : depth == CV_16S ? std::numeric_limits<std::int16_t>::max()
                                            : std::numeric_limits<float>::infinity();
  pixels.convertTo(pixels, CV_32F);
  DepthPixels image{ pixels.cols, pixels.rows, {} };
  image.pixels.assign(pixels.begin<float>(), pixels.end<float>());
  std::replace_if(
    image.pixels.begin(), image.pixels.end(), [&](float value) { return value >= saturated; }, NoDepth);
  return image;
}
}

std::array<int, 2> readImageSize(const std::string& path)
{
  std::string bytes = readFile(path, HeadLength);
  std::uint64_t length = bytes.size();
  if (bytes.size() == HeadLength)
  {
    std::error_code failure;
    length = std::filesystem::file_size(path, failure);
    const Size size = sizeOf(path, bytes);
    if (size.width == 0 || size.height == 0)
    {
      bytes = readFile(path);
    }
  }
  const Size size = checkedSize(path, bytes, length);
  return { static_cast<int>(size.width), static_cast<int>(size.height) };
}

Image readImage(const std::string& path)
{
  std::string bytes = readFile(path);
  if (isPortableMap(bytes))
  {
    failImage(path, "is a PGM or PFM image, which is read as a depth image alone: save images as PNG");
  }
  cv::Mat pixels = decode(path, std::move(bytes), MostImageBits);
  if (pixels.depth() == CV_16U)
  {
    if (pixels.channels() == 4)
    {
      cv::cvtColor(pixels, pixels, cv::COLOR_BGRA2BGR); // an alpha of 65535 is no brightness
    }
    const cv::Mat deep = pixels;
    const double most = mostOfDeep(deep);
    deep.convertTo(pixels, CV_8U, 255.0 / most);
    if (most < std::numeric_limits<std::uint16_t>::max())
    {
      pixels.reshape(1).setTo(1, (deep.reshape(1) > 0) & (pixels.reshape(1) == 0)); // labels of a mask stay
    }
  }
  if (pixels.depth() != CV_8U || (pixels.channels() != 1 && pixels.channels() != 3 && pixels.channels() != 4))
  {
    failImage(path, "is neither grey nor coloured with 8 or 16 bits");
  }
  if (pixels.channels() > 1)
  {
    cv::cvtColor(cv::Mat(pixels), pixels, pixels.channels() == 3 ? cv::COLOR_BGR2RGB : cv::COLOR_BGRA2RGB);
  }
  Image image;
  image.width = pixels.cols;
  image.height = pixels.rows;
  image.channels = pixels.channels();
  image.pixels.assign(pixels.datastart, pixels.dataend);
  return image;
}

void requireRegistered(const Image& image, const OrganizedCloud& cloud, const std::string& path)
{
  if (image.width != cloud.width || image.height != cloud.height)
  {
    failImage(path, "has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                      " pixels, but the scan has " + std::to_string(cloud.width) + " x " +
                      std::to_string(cloud.height) + ": it is not registered with the scan");
  }
}

DepthPixels readDepthPixels(const std::string& path)
{
  DepthPixels image = decodeDepth(path, readFile(path));
  std::replace_if(
    image.pixels.begin(), image.pixels.end(), [](float value) { return !(value > 0.0f && std::isfinite(value)); },
    NoDepth);
  if (isSwapped(image.pixels))
  {
    failImage(path,
      "has the two bytes of its values in the wrong order, for with the other one neighbouring pixels are "
      "far nearer to each other: swap them (PNG and PGM have the higher byte first)");
  }
  return image;
}
}
