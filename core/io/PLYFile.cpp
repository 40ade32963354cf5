// SPDX-License-Identifier: BSD-3-Clause
#include "io/PLYFile.h"

#include "io/parsing/FileBytes.h"
#include "io/parsing/TextLines.h"
#include "mesh/PolygonTriangulation.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <sstream>
#include <string_view>

namespace meam
{
namespace
{
enum class Type
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Float,
  Double
};

struct Property
{
  std::string name;
  Type type = Type::Float;
  bool list = false;
  Type countType = Type::UInt8; ///< of a list
};

struct Element
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class PLYEncoding
{
  Ascii,
  LittleEndian,
  BigEndian
};

struct PLYHeader
{
  PLYEncoding encoding = PLYEncoding::Ascii;
  std::vector<Element> elements;
  std::size_t dataAt = 0; ///< position in the file
};

[[noreturn]] void failPLY(const std::string& path, const std::string& what)
{
  throw Error("The PLY file '" + path + "' " + what + ".");
}

std::size_t sizeOf(Type type)
{
  constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 4, 8 };
  return sizes[static_cast<int>(type)];
}

Type typeOf(const std::string& path, const std::string& name)
{
  constexpr const char* names[][2] = { { "char", "int8" }, { "uchar", "uint8" }, { "short", "int16" },
    { "ushort", "uint16" }, { "int", "int32" }, { "uint", "uint32" }, { "float", "float32" }, { "double", "float64" } };
  for (int i = 0; i < 8; ++i)
  {
    if (name == names[i][0] || name == names[i][1])
    {
      return static_cast<Type>(i);
    }
  }
  failPLY(path, "has a property of the unknown type '" + name.substr(0, 40) + "'");
}

Property propertyOf(const std::string& path, std::istringstream& words)
{
  Property property;
  std::string type;
  words >> type;
  property.list = type == "list";
  if (property.list)
  {
    std::string countType;
    words >> countType >> type;
    property.countType = typeOf(path, countType);
  }
  property.type = typeOf(path, type);
  words >> property.name;
  std::transform(property.name.begin(), property.name.end(), property.name.begin(),
    [](unsigned char letter) { return std::tolower(letter); }); // Red and X are about, too
  return property;
}

PLYHeader parsePLYHeader(const std::string& path, const std::string& bytes)
{
  PLYHeader header;
  header.dataAt = bytes.size() - withoutMark(bytes).size();
  // Lines end as the first one does: data may begin with the byte of another end.
  const std::size_t firstEnd = bytes.find_first_of("\r\n");
  const bool endsWithReturn =
    firstEnd != std::string::npos && bytes[firstEnd] == '\r' && bytes.compare(firstEnd, 2, "\r\n") != 0;
  const char lineEnd = endsWithReturn ? '\r' : '\n';
  bool first = true;
  bool hasFormat = false;
  std::string unknown; // a line before the elements: a comment of Blender 2.4, which leaves out the word
  for (std::string key; key != "end_header"; first = false)
  {
    const std::size_t end = bytes.find(lineEnd, header.dataAt);
    std::istringstream words(bytes.substr(header.dataAt, end == std::string::npos ? end : end - header.dataAt));
    key.clear();
    words >> key;
    if (first && key != "ply")
    {
      failPLY(path, "does not start with ply: it is not a PLY file");
    }
    if (end == std::string::npos)
    {
      failPLY(path, "has no line end_header: it is cut off");
    }
    header.dataAt = end + 1;
    std::string value;
    if (key == "format")
    {
      words >> value;
      hasFormat = true;
      header.encoding = value == "ascii"               ? PLYEncoding::Ascii
                        : value == "binary_big_endian" ? PLYEncoding::BigEndian
                                                       : PLYEncoding::LittleEndian;
      if (header.encoding == PLYEncoding::LittleEndian && value != "binary_little_endian")
      {
        failPLY(path, "has the unknown format '" + value.substr(0, 40) + "'");
      }
    }
    else if (key == "element")
    {
      header.elements.emplace_back();
      words >> header.elements.back().name >> value;
      const auto [stop, failure] =
        std::from_chars(value.data(), value.data() + value.size(), header.elements.back().count);
      if (failure != std::errc() || stop != value.data() + value.size())
      {
        failPLY(path, "has an element whose number is '" + value.substr(0, 40) + "'");
      }
    }
    else if (key == "property")
    {
      if (header.elements.empty())
      {
        failPLY(path, unknown.empty() ? "has a property before the first element" : unknown);
      }
      header.elements.back().properties.push_back(propertyOf(path, words));
    }
    else if (!first && !key.empty() && key != "comment" && key != "obj_info" && key != "end_header")
    {
      unknown = "has an unknown header line '" + key.substr(0, 40) + "'";
      if (!header.elements.empty() || !hasFormat || header.encoding != PLYEncoding::Ascii)
      {
        failPLY(path, unknown);
      }
    }
  }
  if (!hasFormat)
  {
    failPLY(path, "has no line format in its header");
  }
  return header;
}

const Element* verticesOf(const PLYHeader& header)
{
  const auto found = std::find_if(
    header.elements.begin(), header.elements.end(), [](const Element& element) { return element.name == "vertex"; });
  return found == header.elements.end() ? nullptr : &*found;
}

/// Takes one value after the other from the file's data, whatever the encoding.
class Values
{
public:
  Values(const std::string& path, const std::string& bytes, const PLYHeader& header)
    : Path(path)
    , Rest(std::string_view(bytes).substr(header.dataAt))
    , Form(header.encoding)
  {
  }

  double next(Type type) { return this->Form == PLYEncoding::Ascii ? this->text() : this->binary(type); }

  /// Fails unless the rest of the file has room for so many values of one of these types each.
  void requireRoom(std::uint64_t times, const std::vector<Property>& properties)
  {
    std::size_t bytes = 0;
    for (const Property& property : properties)
    {
      // A value of a text takes a character and one between two of them.
      bytes += this->Form == PLYEncoding::Ascii ? 2 : sizeOf(property.list ? property.countType : property.type);
    }
    const std::size_t rest = this->Rest.size() + (this->Form == PLYEncoding::Ascii ? 1 : 0);
    if (bytes > 0 && times > rest / bytes)
    {
      this->cutOff();
    }
  }

  /// Whether the file is a text that goes on with so many lines.
  bool hasLines(std::uint64_t count) const
  {
    TextLines lines(this->Rest);
    std::uint64_t found = 0;
    while (this->Form == PLYEncoding::Ascii && found <= count && lines.next())
    {
      ++found;
    }
    return this->Form == PLYEncoding::Ascii && found == count;
  }

  void skipLine() { this->Rest.remove_prefix(std::min(this->Rest.find_first_of("\r\n"), this->Rest.size())); }

  /// Fails for a file that goes on.
  void requireEnd() const
  {
    constexpr std::string_view fill(" \t\r\n\x1a\0", 6);
    if (this->Rest.find_first_not_of(fill) != std::string_view::npos)
    {
      failPLY(this->Path, "goes on after what its header promises: it is damaged");
    }
  }

private:
  [[noreturn]] void cutOff() const { failPLY(this->Path, "is cut off: it promises more than it has room for"); }

  double text()
  {
    constexpr const char* blanks = " \t\r\n";
    this->Rest.remove_prefix(std::min(this->Rest.find_first_not_of(blanks), this->Rest.size()));
    std::string_view word = this->Rest.substr(0, this->Rest.find_first_of(blanks));
    if (word.empty())
    {
      this->cutOff();
    }
    this->Rest.remove_prefix(word.size());
    const std::string shown(word.substr(0, 40));
    if (word[0] == '+')
    {
      word.remove_prefix(1);
    }
    if (isNaNOfWindows(word))
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
    double value = 0.0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure != std::errc() || end != word.data() + word.size())
    {
      failPLY(this->Path, "has a value that is not a number: '" + shown + "'");
    }
    return value;
  }

  double binary(Type type)
  {
    const std::size_t size = sizeOf(type);
    if (this->Rest.size() < size)
    {
      this->cutOff();
    }
    char bytes[8] = {};
    std::copy_n(this->Rest.data(), size, bytes);
    this->Rest.remove_prefix(size);
    if (this->Form == PLYEncoding::BigEndian)
    {
      std::reverse(bytes, bytes + size);
    }
    switch (type)
    {
      case Type::Int8:
        return load<std::int8_t>(bytes);
      case Type::UInt8:
        return load<std::uint8_t>(bytes);
      case Type::Int16:
        return load<std::int16_t>(bytes);
      case Type::UInt16:
        return load<std::uint16_t>(bytes);
      case Type::Int32:
        return load<std::int32_t>(bytes);
      case Type::UInt32:
        return load<std::uint32_t>(bytes);
      case Type::Float:
        return static_cast<double>(load<float>(bytes));
      default:
        return load<double>(bytes);
    }
  }

  template <typename T>
  static T load(const char* bytes)
  {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  const std::string& Path;
  std::string_view Rest;
  PLYEncoding Form;
};

/// Goes through an element; `entry` gets the place of a list among the properties and one of its values after the
/// other, then `take` the record's number and its values, the lengths of lists among them.
template <typename Take, typename Entry>
void forEachRecord(
  const std::string& path, Values& values, const Element& element, const Take& take, const Entry& entry)
{
  values.requireRoom(element.count, element.properties);
  // A record without properties takes no room: there is nothing in it.
  const std::uint64_t count = element.properties.empty() ? 0 : element.count;
  std::vector<double> record(element.properties.size());
  for (std::uint64_t i = 0; i < count; ++i)
  {
    for (std::size_t k = 0; k < element.properties.size(); ++k)
    {
      const Property& property = element.properties[k];
      record[k] = values.next(property.list ? property.countType : property.type);
      if (!property.list)
      {
        continue;
      }
      if (!(record[k] >= 0.0 && record[k] <= std::numeric_limits<std::uint32_t>::max()) ||
          record[k] != std::floor(record[k]))
      {
        failPLY(path, "has a list of an impossible length in its element '" + element.name.substr(0, 40) +
                        "': its header does not fit");
      }
      for (auto left = static_cast<std::uint64_t>(record[k]); left > 0; --left)
      {
        entry(k, values.next(property.type));
      }
    }
    take(i, record);
  }
}

/// The same without the values of lists.
template <typename Take>
void forEachRecord(const std::string& path, Values& values, const Element& element, const Take& take)
{
  forEachRecord(path, values, element, take, [](std::size_t, double) {});
}

void skip(const std::string& path, Values& values, const Element& element)
{
  forEachRecord(path, values, element, [](std::uint64_t, const std::vector<double>&) {});
}

/// The place of a property among the element's, or -1.
int find(const Element& element, std::initializer_list<const char*> names)
{
  for (const char* name : names)
  {
    for (std::size_t k = 0; k < element.properties.size(); ++k)
    {
      if (element.properties[k].name == name && !element.properties[k].list)
      {
        return static_cast<int>(k);
      }
    }
  }
  return -1;
}

/// Places of the properties that belong to a point; -1 where there is none.
struct Layout
{
  int point[3];
  int normal[3];
  int color[3];
  int intensity;
  bool isColorReal;

  explicit Layout(const Element& vertex)
    : point{ find(vertex, { "x" }), find(vertex, { "y" }), find(vertex, { "z" }) }
    , normal{ find(vertex, { "nx" }), find(vertex, { "ny" }), find(vertex, { "nz" }) }
    , color{ find(vertex, { "red", "r", "diffuse_red" }), find(vertex, { "green", "g", "diffuse_green" }),
      find(vertex, { "blue", "b", "diffuse_blue" }) }
    , intensity(find(vertex, { "intensity", "gray", "grey", "i", "scalar_intensity" }))
  {
    const Type type = this->color[0] < 0 ? Type::UInt8 : vertex.properties[this->color[0]].type;
    this->isColorReal = type == Type::Float || type == Type::Double;
  }

  static bool whole(const int places[3]) { return places[0] >= 0 && places[1] >= 0 && places[2] >= 0; }
};

Eigen::Vector3f vectorOf(const std::vector<double>& record, const int places[3])
{
  return Eigen::Vector3d(record[places[0]], record[places[1]], record[places[2]]).cast<float>();
}

void reportRecord(const Progress& progress, std::uint64_t record, const Element& element)
{
  reportStep(progress, record, static_cast<double>(record) / static_cast<double>(element.count));
}

/// The element of the points; fails without any, and without coordinates.
const Element* requiredVertices(const std::string& path, const PLYHeader& header)
{
  const Element* vertex = verticesOf(header);
  if (!vertex || vertex->count == 0)
  {
    failPLY(path, "has no points");
  }
  if (!Layout::whole(Layout(*vertex).point))
  {
    failPLY(path, "has no properties x, y and z of its points");
  }
  if (vertex->count > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
  {
    failPLY(path, "promises an impossible number of points");
  }
  return vertex;
}

/// The place of a face's list of corners, or -1.
int cornersOf(const Element& face)
{
  for (std::size_t k = 0; k < face.properties.size(); ++k)
  {
    const Property& property = face.properties[k];
    if (property.list && (property.name == "vertex_indices" || property.name == "vertex_index"))
    {
      return static_cast<int>(k);
    }
  }
  return -1;
}

bool isStrips(const Element& element) { return element.name == "tristrips"; }
bool isFaces(const Element& element) { return element.name == "face" || isStrips(element); }

/// Triangles of each three points that follow each other, every second one turned round; -1 ends a strip.
void addStrips(const std::vector<int>& points, TriangleMesh& mesh)
{
  std::size_t first = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (points[k] < 0)
    {
      first = k + 1;
    }
    else if (k >= first + 2)
    {
      const std::size_t turned = (k - first) % 2;
      const Eigen::Vector3i corners(points[k - 2], points[k - 1 + turned], points[k - turned]);
      if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) // else it goes on elsewhere
      {
        mesh.triangles.push_back(corners);
      }
    }
  }
}

/// The faces of an element, or its strips of triangles, cut into triangles; `isLast`: no other element follows.
void takeFaces(const std::string& path, Values& values, const Element& face, bool isLast, const Progress& progress,
  TriangleMesh& mesh)
{
  const int list = cornersOf(face);
  if (list < 0)
  {
    failPLY(path, "has faces without the list vertex_indices");
  }
  if (mesh.vertices.empty())
  {
    failPLY(path, "has its faces before its points, which is not read: save it with the points first");
  }
  // MeshLab's colors of corners are longer than its header says, which has one color for a face.
  const bool isLineEach = isLast && face.properties.size() > 1 && values.hasLines(face.count);
  std::vector<int> corners;
  const auto entry = [&](std::size_t k, double value)
  {
    if (static_cast<int>(k) == list)
    {
      const bool isEnd = isStrips(face) && value == -1.0;
      const bool isPoint =
        value >= 0.0 && value < static_cast<double>(mesh.vertices.size()) && value == std::floor(value);
      if (!isEnd && !isPoint)
      {
        failPLY(path, "has a face with a point that does not exist");
      }
      corners.push_back(static_cast<int>(value));
    }
  };
  const auto take = [&](std::uint64_t i, const std::vector<double>&)
  {
    reportRecord(progress, i, face);
    isStrips(face) ? addStrips(corners, mesh) : addPolygon(corners, mesh);
    corners.clear();
    if (isLineEach)
    {
      values.skipLine();
    }
  };
  forEachRecord(path, values, face, take, entry);
}
}

TriangleMesh readPLYMesh(const std::string& path, const Progress& progress)
{
  const std::string bytes = readFile(path);
  const PLYHeader header = parsePLYHeader(path, bytes);
  const Layout layout(*requiredVertices(path, header));
  Values values(path, bytes, header);
  const Progress ofVertices = subProgress(progress, 0.0, 0.5);
  TriangleMesh mesh;
  for (const Element& element : header.elements)
  {
    if (element.name == "vertex" && mesh.vertices.empty())
    {
      forEachRecord(path, values, element,
        [&](std::uint64_t i, const std::vector<double>& record)
        {
          reportRecord(ofVertices, i, element);
          mesh.vertices.push_back(vectorOf(record, layout.point));
        });
    }
    else if (isFaces(element) && mesh.triangles.empty())
    {
      takeFaces(path, values, element, &element == &header.elements.back(), subProgress(progress, 0.5, 1.0), mesh);
    }
    else
    {
      skip(path, values, element);
    }
  }
  values.requireEnd();
  return mesh;
}

MeasuredCloud readPLYCloud(const std::string& path, const Progress& progress)
{
  const std::string bytes = readFile(path);
  report(progress, 0.0);
  const PLYHeader header = parsePLYHeader(path, bytes);
  const Element* vertex = requiredVertices(path, header);
  const Layout layout(*vertex);
  Values values(path, bytes, header);
  for (const Element* before = header.elements.data(); before != vertex; ++before)
  {
    skip(path, values, *before);
  }
  MeasuredCloud result;
  std::vector<float> colors;
  const auto take = [&](std::uint64_t i, const std::vector<double>& record)
  {
    result.cloud.points.push_back(vectorOf(record, layout.point));
    if (Layout::whole(layout.normal))
    {
      result.normals.push_back(vectorOf(record, layout.normal));
    }
    if (layout.intensity >= 0)
    {
      result.intensities.push_back(static_cast<float>(record[layout.intensity]));
    }
    for (int k = 0; k < 3 && Layout::whole(layout.color); ++k)
    {
      colors.push_back(static_cast<float>(record[layout.color[k]]));
    }
    reportRecord(progress, i, *vertex);
  };
  forEachRecord(path, values, *vertex, take);
  result.colors = colorValues(colors, layout.isColorReal);
  result.cloud.width = static_cast<int>(result.cloud.size());
  result.cloud.height = 1;
  report(progress, 1.0);
  return result;
}

bool isPLYCloud(const std::string& path)
{
  try
  {
    const PLYHeader header = parsePLYHeader(path, readFile(path));
    const Element* vertex = verticesOf(header);
    return vertex && vertex->count > 0 &&
           std::none_of(header.elements.begin(), header.elements.end(),
             [](const Element& element) { return isFaces(element) && element.count > 0; });
  }
  catch (const Error&)
  {
    return false;
  }
}
}
