// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud/PCDFile.h"

#include "io/parsing/FileBytes.h"
#include "io/parsing/TextLines.h"

#include <liblzf/lzf.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace meam
{
namespace
{
enum class Encoding
{
  Ascii,
  Binary,
  Compressed
};

struct Field
{
  std::string name;
  char type = 'F';
  std::uint64_t size = 4;
  std::uint64_t count = 1;
  std::uint64_t offset = 0; ///< bytes, or values in ascii, before it in a record
};

struct Header
{
  std::vector<Field> fields;
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  std::uint64_t points = 0;
  std::uint64_t record = 0; ///< bytes, or values in ascii, of a point
  Encoding encoding = Encoding::Ascii;
  std::size_t dataAt = 0; ///< position in the file
  std::optional<Eigen::Isometry3d> T_cloud_sensor;
};

/// Of a VIEWPOINT, x y z and a quaternion, w first; none of the default, and of one that is no pose.
std::optional<Eigen::Isometry3d> poseOf(const std::vector<std::string>& values)
{
  std::array<double, 7> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (i >= values.size() || !parseNumber(values[i], numbers[i]) || !std::isfinite(numbers[i]))
    {
      return std::nullopt;
    }
  }
  const Eigen::Quaterniond rotation(numbers[3], numbers[4], numbers[5], numbers[6]);
  const Eigen::Isometry3d T = Eigen::Translation3d(numbers[0], numbers[1], numbers[2]) * rotation.normalized();
  return rotation.norm() > 0.0 && !T.matrix().isIdentity(0.0) ? std::optional(T) : std::nullopt;
}

[[noreturn]] void failPCD(const std::string& path, const std::string& what)
{
  throw Error("The PCD file '" + path + "' " + what + ".");
}

/// Bytes of an image would make the message unreadable.
std::string quotedKey(const std::string& key)
{
  const bool isText = std::all_of(key.begin(), key.end(), [](unsigned char c) { return c > 0x20 && c < 0x7f; });
  return isText ? " '" + key.substr(0, 40) + "'" : "";
}

template <typename Number>
Number parseOrFail(const std::string& path, const std::string& key, const std::string& text)
{
  Number value{};
  if (!parseNumber(text, value))
  {
    failPCD(path, "has a header line " + key + " that is not a number: '" + text.substr(0, 40) + "'");
  }
  return value;
}

Header parseHeader(const std::string& path, const std::string& bytes)
{
  Header header;
  bool hasWidth = false;
  bool hasHeight = false;
  bool hasPoints = false;
  header.dataAt = bytes.size() - withoutMark(bytes).size();
  std::vector<std::string> sizes, types, counts;
  std::string encoding;
  while (encoding.empty())
  {
    const std::size_t end = bytes.find('\n', header.dataAt);
    if (end == std::string::npos)
    {
      failPCD(path, "has no DATA line: it is not a PCD file, or it is cut off");
    }
    std::istringstream line(bytes.substr(header.dataAt, end - header.dataAt));
    header.dataAt = end + 1;
    std::string key;
    line >> key;
    std::vector<std::string> values;
    for (std::string value; line >> value;)
    {
      values.push_back(value);
    }
    if (key.empty() || key[0] == '#' || key == "VERSION")
    {
      continue;
    }
    if (values.empty())
    {
      failPCD(path, "has a header line" + quotedKey(key) + " without a value: it is not a PCD file");
    }
    if (key == "FIELDS" || key == "COLUMNS")
    {
      for (const auto& value : values)
      {
        header.fields.emplace_back();
        header.fields.back().name = value;
      }
    }
    else if (key == "SIZE")
    {
      sizes = values;
    }
    else if (key == "TYPE")
    {
      types = values;
    }
    else if (key == "COUNT")
    {
      counts = values;
    }
    else if (key == "WIDTH")
    {
      header.width = parseOrFail<std::uint64_t>(path, key, values[0]);
      hasWidth = true;
    }
    else if (key == "HEIGHT")
    {
      header.height = parseOrFail<std::uint64_t>(path, key, values[0]);
      hasHeight = true;
    }
    else if (key == "POINTS")
    {
      header.points = parseOrFail<std::uint64_t>(path, key, values[0]);
      hasPoints = true;
    }
    else if (key == "DATA")
    {
      encoding = values[0];
      std::transform(
        encoding.begin(), encoding.end(), encoding.begin(), [](unsigned char c) { return std::tolower(c); });
    }
    else if (key == "VIEWPOINT")
    {
      header.T_cloud_sensor = poseOf(values);
    }
    else
    {
      failPCD(path, "has an unknown header line" + quotedKey(key) + ": it is not a PCD file");
    }
  }

  if (encoding == "binary")
  {
    header.encoding = Encoding::Binary;
  }
  else if (encoding == "binary_compressed")
  {
    header.encoding = Encoding::Compressed;
  }
  else if (encoding != "ascii")
  {
    failPCD(path,
      "has data of the unknown kind '" + encoding.substr(0, 40) + "'; known are ascii, binary and binary_compressed");
  }

  const std::size_t fields = header.fields.size();
  if (fields == 0)
  {
    failPCD(path, "has no line FIELDS with the names of its values");
  }
  const auto checkCount = [&](const char* key, const std::vector<std::string>& values)
  {
    if (!values.empty() && values.size() != fields)
    {
      failPCD(
        path, "has " + std::to_string(fields) + " FIELDS but " + std::to_string(values.size()) + " values of " + key);
    }
  };
  checkCount("SIZE", sizes);
  checkCount("TYPE", types);
  checkCount("COUNT", counts);
  for (std::size_t i = 0; i < fields; ++i)
  {
    Field& field = header.fields[i];
    if (!types.empty())
    {
      field.type =
        types[i].size() == 1 ? static_cast<char>(std::toupper(static_cast<unsigned char>(types[i][0]))) : '?';
    }
    if (!sizes.empty())
    {
      field.size = parseOrFail<std::uint64_t>(path, "SIZE", sizes[i]);
    }
    if (!counts.empty())
    {
      field.count = parseOrFail<std::uint64_t>(path, "COUNT", counts[i]);
    }
    const bool real = field.type == 'F' && (field.size == 4 || field.size == 8);
    const bool integer = (field.type == 'I' || field.type == 'U') &&
                         (field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8);
    if ((!real && !integer) || field.count < 1 || field.count > bytes.size())
    {
      failPCD(path, "has a field '" + field.name.substr(0, 40) + "' of an impossible SIZE, TYPE or COUNT");
    }
    field.offset = header.record;
    header.record += header.encoding == Encoding::Ascii ? field.count : field.count * field.size;
  }
  if (header.record > std::numeric_limits<std::uint32_t>::max())
  {
    failPCD(path, "has points of an impossible size");
  }

  if (!hasWidth)
  {
    header.width = hasHeight && header.height > 0 ? header.points / header.height : header.points;
  }
  if (!hasHeight)
  {
    header.height = 1;
  }
  constexpr std::uint64_t most = std::numeric_limits<int>::max();
  if (header.width > most || header.height > most || header.width * header.height > most)
  {
    failPCD(path, "promises an impossible number of points (WIDTH x HEIGHT)");
  }
  if (!hasPoints)
  {
    header.points = header.width * header.height;
  }
  if (header.points != header.width * header.height)
  {
    failPCD(path, "promises " + std::to_string(header.points) + " POINTS, but WIDTH x HEIGHT is " +
                    std::to_string(header.width) + " x " + std::to_string(header.height));
  }
  if (header.points == 0)
  {
    failPCD(path, "has no points");
  }
  return header;
}

template <typename T>
T load(const char* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

double numberAt(const char* bytes, const Field& field)
{
  if (field.type == 'F')
  {
    return field.size == 4 ? static_cast<double>(load<float>(bytes)) : load<double>(bytes);
  }
  const bool sign = field.type == 'I';
  switch (field.size)
  {
    case 1:
      return sign ? load<std::int8_t>(bytes) : load<std::uint8_t>(bytes);
    case 2:
      return sign ? load<std::int16_t>(bytes) : load<std::uint16_t>(bytes);
    case 4:
      return sign ? static_cast<double>(load<std::int32_t>(bytes)) : static_cast<double>(load<std::uint32_t>(bytes));
    default:
      return sign ? static_cast<double>(load<std::int64_t>(bytes)) : static_cast<double>(load<std::uint64_t>(bytes));
  }
}

/// Where one field's values are.
struct FieldData
{
  const Field* field = nullptr;
  bool text = false; ///< a double parsed from an ascii file, not the declared type
  const char* first = nullptr;
  std::uint64_t step = 0;

  double number(std::uint64_t point) const
  {
    const char* at = this->first + point * this->step;
    return this->text ? load<double>(at) : numberAt(at, *this->field);
  }
  /// 0x..RRGGBB. In a float field it is the float's bits, read as they are: many are not numbers.
  std::uint32_t color(std::uint64_t point) const
  {
    if (!this->text && this->field->size == 4)
    {
      return load<std::uint32_t>(this->first + point * this->step);
    }
    if (this->field->type == 'F')
    {
      const float value = static_cast<float>(this->number(point));
      std::uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof(bits));
      return bits;
    }
    const double value = this->number(point);
    const bool fits = value >= -2147483648.0 && value <= 4294967295.0;
    return fits ? static_cast<std::uint32_t>(static_cast<std::int64_t>(value)) : 0;
  }
};

/// The values of an ascii file as the binary records that the header describes; `header` is changed
/// to fit.
std::string binaryOfAscii(const std::string& path, const std::string& bytes, Header& header, const Progress& progress)
{
  const std::uint64_t values = header.record;
  // A value takes at least one character and one separator.
  if (values > 0 && header.points > (bytes.size() - header.dataAt + 1) / (2 * values))
  {
    failPCD(path, "is cut off: it promises " + std::to_string(header.points) + " points of " + std::to_string(values) +
                    " values, more than the file has room for");
  }
  header.record = 0;
  for (Field& field : header.fields)
  {
    field.offset = header.record;
    header.record += 8 * field.count;
  }
  std::string records(header.points * header.record, '\0');
  char* to = records.data();
  std::size_t at = header.dataAt;
  const auto skipBlanks = [&]
  {
    while (at < bytes.size() && std::strchr(" \t\r\n", bytes[at]) && bytes[at] != '\0')
    {
      ++at;
    }
  };
  for (std::uint64_t point = 0; point < header.points; ++point)
  {
    for (const Field& field : header.fields)
    {
      for (std::uint64_t k = 0; k < field.count; ++k, to += 8)
      {
        skipBlanks();
        if (at == bytes.size())
        {
          failPCD(path,
            "is cut off: it ends after " + std::to_string(point) + " of " + std::to_string(header.points) + " points");
        }
        const std::size_t start = at;
        at = std::min(bytes.find_first_of(" \t\r\n", at), bytes.size());
        const char* first = bytes.data() + start + (bytes[start] == '+' ? 1 : 0);
        double value = 0.0;
        const auto [end, failure] = std::from_chars(first, bytes.data() + at, value);
        const std::string_view word = std::string_view(bytes).substr(start, at - start);
        if (isNaNOfWindows(word))
        {
          value = std::numeric_limits<double>::quiet_NaN();
        }
        else if (end != bytes.data() + at || failure != std::errc())
        {
          failPCD(path, "has a value that is not a number in point " + std::to_string(point) + ": '" +
                          bytes.substr(start, std::min<std::size_t>(at - start, 40)) + "'");
        }
        std::memcpy(to, &value, sizeof(value));
      }
    }
    reportStep(progress, point, 0.9 * static_cast<double>(point) / static_cast<double>(header.points));
  }
  skipBlanks();
  if (at != bytes.size())
  {
    failPCD(
      path, "has more values than its " + std::to_string(header.points) + " points can have: its header does not fit");
  }
  return records;
}

std::string decompressed(const std::string& path, const std::string& bytes, const Header& header)
{
  if (bytes.size() - header.dataAt < 8)
  {
    failPCD(path, "is cut off: its data have no length");
  }
  const std::uint64_t packed = load<std::uint32_t>(bytes.data() + header.dataAt);
  const std::uint64_t unpacked = load<std::uint32_t>(bytes.data() + header.dataAt + 4);
  if (packed > bytes.size() - header.dataAt - 8)
  {
    failPCD(path, "is cut off: it promises " + std::to_string(packed) + " bytes of compressed data and has " +
                    std::to_string(bytes.size() - header.dataAt - 8));
  }
  // Three bytes of LZF stand for 264 at most.
  if (unpacked != header.points * header.record || unpacked > 88 * (packed + 1))
  {
    failPCD(path, "has compressed data for another number of points than its header promises");
  }
  std::string data(unpacked, '\0');
  if (lzf_decompress(bytes.data() + header.dataAt + 8, static_cast<unsigned>(packed), data.data(),
        static_cast<unsigned>(unpacked)) != unpacked)
  {
    failPCD(path, "has compressed data that are damaged");
  }
  return data;
}
}

MeasuredCloud readPCD(const std::string& path, const Progress& progress)
{
  std::string bytes = readFile(path);
  report(progress, 0.0);
  Header header = parseHeader(path, bytes);
  const char* data = nullptr;
  std::string own;
  switch (header.encoding)
  {
    case Encoding::Ascii:
      own = binaryOfAscii(path, bytes, header, progress);
      data = own.data();
      break;
    case Encoding::Binary:
      if (header.record > 0 && header.points > (bytes.size() - header.dataAt) / header.record)
      {
        failPCD(path, "is cut off: it promises " + std::to_string(header.points) + " points of " +
                        std::to_string(header.record) + " bytes and has " +
                        std::to_string(bytes.size() - header.dataAt) + " bytes");
      }
      data = bytes.data() + header.dataAt;
      break;
    case Encoding::Compressed:
      own = decompressed(path, bytes, header);
      data = own.data();
      break;
  }
  report(progress, 0.9);

  const auto find = [&](const std::string& name)
  {
    FieldData found;
    for (const Field& field : header.fields)
    {
      std::string lower = field.name;
      std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
      if (lower == name && field.count == 1)
      {
        found.field = &field;
        found.text = header.encoding == Encoding::Ascii;
        // Compressed data are stored field by field.
        const bool columns = header.encoding == Encoding::Compressed;
        found.first = data + (columns ? header.points * field.offset : field.offset);
        found.step = columns ? field.size : header.record;
        break;
      }
    }
    return found;
  };
  const auto take = [&](const char* x, const char* y, const char* z)
  {
    const FieldData fields[3] = { find(x), find(y), find(z) };
    Points points;
    if (fields[0].field && fields[1].field && fields[2].field)
    {
      points.resize(header.points);
      for (int k = 0; k < 3; ++k)
      {
        for (std::uint64_t i = 0; i < header.points; ++i)
        {
          points[i][k] = static_cast<float>(fields[k].number(i));
        }
      }
    }
    return points;
  };

  MeasuredCloud result;
  result.cloud.width = static_cast<int>(header.width);
  result.cloud.height = static_cast<int>(header.height);
  result.T_cloud_sensor = header.T_cloud_sensor;
  result.cloud.points = take("x", "y", "z");
  if (result.cloud.points.empty())
  {
    failPCD(path, header.height > 1 && (find("rgb").field || find("rgba").field || find("intensity").field)
                    ? "has no fields x, y and z: it is an image; save it as PNG and give it beside the scan (image)"
                    : "has no fields x, y and z");
  }
  result.normals = take("normal_x", "normal_y", "normal_z");
  FieldData intensity;
  for (const char* name : { "intensity", "gray", "grey", "i", "scalar_intensity" })
  {
    intensity = intensity.field ? intensity : find(name);
  }
  if (intensity.field)
  {
    result.intensities.resize(header.points);
    for (std::uint64_t i = 0; i < header.points; ++i)
    {
      result.intensities[i] = static_cast<float>(intensity.number(i));
    }
  }
  if (const FieldData color = find("rgb").field ? find("rgb") : find("rgba"); color.field)
  {
    result.colors.reserve(3 * header.points);
    for (std::uint64_t i = 0; i < header.points; ++i)
    {
      const std::uint32_t packed = color.color(i);
      for (const int shift : { 16, 8, 0 })
      {
        result.colors.push_back(static_cast<std::uint8_t>(packed >> shift));
      }
    }
  }
  else
  {
    for (const auto& names : { std::array{ "red", "green", "blue" }, std::array{ "r", "g", "b" } })
    {
      const FieldData channels[3] = { find(names[0]), find(names[1]), find(names[2]) };
      if (result.colors.empty() && channels[0].field && channels[1].field && channels[2].field)
      {
        std::vector<float> values;
        values.reserve(3 * header.points);
        for (std::uint64_t i = 0; i < header.points; ++i)
        {
          for (const FieldData& channel : channels)
          {
            values.push_back(static_cast<float>(channel.number(i)));
          }
        }
        result.colors = colorValues(values, channels[0].field->type == 'F');
      }
    }
  }
  report(progress, 1.0);
  return result;
}

std::array<int, 2> readPCDSize(const std::string& path)
{
  const Header header = parseHeader(path, readFile(path));
  return { static_cast<int>(header.width), static_cast<int>(header.height) };
}
}
