// SPDX-License-Identifier: BSD-3-Clause
#include "io/MeshFile.h"

#include "io/OFFFile.h"
#include "io/PLYFile.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/TextLines.h"
#include "mesh/PolygonTriangulation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <unordered_map>

namespace meam
{
namespace
{
[[noreturn]] void failMesh(const std::string& path, const std::string& what)
{
  throw Error("The mesh file '" + path + "' " + what + ".");
}

/// Reports what share of a text is read, now and then.
void reportLine(const Progress& progress, std::size_t line, const TextLines& lines, std::size_t bytes)
{
  reportStep(progress, line, 1.0 - static_cast<double>(lines.left()) / static_cast<double>(bytes + 1));
}

/// The next three words of a line as a point.
Eigen::Vector3f pointOf(const std::string& path, TextLines& lines)
{
  Eigen::Vector3d point; // what is next to 0 has no place in single precision
  for (int i = 0; i < 3; ++i)
  {
    const std::string_view word = lines.word();
    if (word.empty())
    {
      failMesh(path, "has a vertex that is not three numbers: it is cut off or damaged");
    }
    if (!parseNumber(word, point[i]))
    {
      failMesh(
        path, "has the coordinate '" + std::string(word.substr(0, 40)) +
                (word.find(',') != std::string_view::npos ? "' with a decimal comma: export it with decimal points"
                                                          : "', which is not a number: it is damaged"));
    }
  }
  return point.cast<float>();
}

struct HashOfBits
{
  std::size_t operator()(const std::array<std::uint32_t, 3>& bits) const
  {
    return (bits[0] * 0x9e3779b97f4a7c15u ^ bits[1]) * 0x9e3779b97f4a7c15u ^ bits[2] * 0xc2b2ae3d27d4eb4fu;
  }
};

/// Every three corners are a triangle; corners at the same place share a vertex.
TriangleMesh joined(const Points& corners, const Progress& progress)
{
  TriangleMesh mesh;
  std::unordered_map<std::array<std::uint32_t, 3>, int, HashOfBits> places;
  std::vector<int> vertices;
  vertices.reserve(corners.size());
  for (const Eigen::Vector3f& corner : corners)
  {
    const Eigen::Vector3f place = corner.array() + 0.0f; // -0 is 0
    std::array<std::uint32_t, 3> bits;
    std::memcpy(bits.data(), place.data(), sizeof(bits));
    const auto [known, isNew] = places.emplace(bits, static_cast<int>(mesh.vertices.size()));
    if (isNew)
    {
      mesh.vertices.push_back(corner);
    }
    vertices.push_back(known->second);
    reportStep(progress, vertices.size(), static_cast<double>(vertices.size()) / static_cast<double>(corners.size()));
  }
  for (std::size_t i = 0; i + 2 < vertices.size(); i += 3)
  {
    mesh.triangles.emplace_back(vertices[i], vertices[i + 1], vertices[i + 2]);
  }
  return mesh;
}

/// Whether no edge is a border.
bool isClosed(const TriangleMesh& mesh)
{
  std::vector<std::pair<int, int>> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const Eigen::Vector3i& triangle : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      if (low != high)
      {
        sides.emplace_back(low, high);
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  bool isPaired = !sides.empty();
  for (std::size_t i = 0; i < sides.size() && isPaired; i += 2)
  {
    isPaired = i + 1 < sides.size() && sides[i] == sides[i + 1];
  }
  return isPaired;
}

std::string lowered(std::string_view word)
{
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char letter) { return std::tolower(letter); });
  return lower;
}

/// Goes over the name of a solid: to the end of its line, or to the first facet of a file in one line.
bool isFacetBehindName(TextLines& lines)
{
  bool isFacet = false;
  for (std::string word = lowered(lines.word()); !word.empty(); word = lowered(lines.word()))
  {
    if (isFacet && word == "normal")
    {
      return true;
    }
    isFacet = word == "facet";
  }
  return false;
}

TriangleMesh readTextSTL(const std::string& path, std::string_view text, const Progress& progress)
{
  Points vertices;
  std::size_t start = 0; // of the facet
  bool isWhole = false, hasEnds = false, endsWithFacet = false;
  int solids = 0;
  const Progress parsing = subProgress(progress, 0.0, 0.5);
  TextLines lines(text);
  for (std::size_t line = 0; lines.next(); ++line)
  {
    reportLine(parsing, line, lines, text.size());
    for (std::string word = lowered(lines.word()); !word.empty(); word = lowered(lines.word()))
    {
      word += word == "end" ? lowered(lines.word()) : "";
      endsWithFacet = word == "endfacet";
      if (word == "vertex")
      {
        vertices.push_back(pointOf(path, lines));
      }
      else if (word == "endloop")
      {
        if (const std::size_t corners = vertices.size() - start; corners != 3)
        {
          failMesh(path, "has a facet of " + std::to_string(corners) + " corners: export it as triangles, or as OBJ");
        }
        start = vertices.size();
      }
      else if (word == "solid" || word == "endsolid")
      {
        solids += word == "solid";
        hasEnds = hasEnds || word == "endsolid";
        isWhole = !isFacetBehindName(lines) && word == "endsolid";
      }
    }
  }
  TriangleMesh mesh = joined(vertices, subProgress(progress, 0.5, 1.0));
  // Some programs leave the end out; what is cut off is open, or ends within a facet.
  isWhole = isWhole || (!hasEnds && solids == 1 && endsWithFacet && isClosed(mesh));
  if (!isWhole || vertices.size() % 3 != 0)
  {
    failMesh(path, "is cut off or damaged: it does not end with endsolid after whole triangles");
  }
  return mesh;
}

constexpr std::size_t STLHeader = 80;   // bytes, then the number of triangles
constexpr std::size_t STLTriangle = 50; // bytes: normal, three corners, and two more
constexpr std::size_t STLNormal = 12;

TriangleMesh readBinarySTL(const std::string& path, const std::string& bytes, const Progress& progress)
{
  std::uint32_t count = 0;
  const std::size_t start = STLHeader + sizeof(count);
  if (bytes.size() >= start)
  {
    std::memcpy(&count, bytes.data() + STLHeader, sizeof(count));
  }
  if (bytes.size() < start || (bytes.size() - start) / STLTriangle < count)
  {
    failMesh(path, "is cut off, or is no STL file");
  }
  if (const std::size_t room = (bytes.size() - start) / STLTriangle; room > count)
  {
    failMesh(path,
      "promises " + std::to_string(count) + " triangles and has room for " + std::to_string(room) + ": it is damaged");
  }
  Points vertices(std::size_t(3) * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    std::memcpy(
      vertices[3 * i].data(), bytes.data() + start + STLTriangle * i + STLNormal, 3 * sizeof(Eigen::Vector3f));
  }
  return joined(vertices, progress);
}

TriangleMesh readSTL(const std::string& path, const Progress& progress)
{
  const std::string bytes = readFile(path);
  const std::string mark = bytes.substr(0, 2);
  const std::string letters = mark == "\xff\xfe" || mark == "\xfe\xff" ? readText(path) : ""; // of UTF-16
  // Some programs begin binary files with the word, too.
  std::string_view text = bareText(letters.empty() ? bytes : letters);
  text.remove_suffix(text.size() - (text.find_last_not_of('\0') + 1)); // what fills a block of a disk
  TextLines lines(text);
  const bool isText =
    text.find('\0') == std::string_view::npos && lines.next() && lowered(lines.word().substr(0, 5)) == "solid";
  return isText ? readTextSTL(path, text, progress) : readBinarySTL(path, bytes, progress);
}

/// The vertex that a corner names: "7", "7/1/2", or "-1" for the last one so far, of `vertices`. Others may follow.
int cornerOf(const std::string& path, std::string_view word, int vertices)
{
  int number = 0;
  const bool isNumber = parseNumber(word.substr(0, word.find('/')), number);
  const int corner = number > 0 ? number - 1 : vertices + number;
  if (!isNumber || number == 0 || corner < 0)
  {
    failMesh(path, "has a face with the corner '" + std::string(word.substr(0, 40)) + "', which does not exist");
  }
  return corner;
}

/// A backslash at the end of a line, but for a comment, continues it on the next one.
void joinContinuedLines(std::string& text)
{
  bool isComment = false;
  for (std::size_t at = 0; (at = text.find_first_of("\\#\r\n", at)) != std::string::npos; ++at)
  {
    isComment = text[at] == '#' || (isComment && text[at] == '\\');
    if (isComment || text[at] != '\\')
    {
      continue;
    }
    std::size_t end = at + 1;
    end += end < text.size() && text[end] == '\r' ? 1 : 0;
    end += end < text.size() && text[end] == '\n' ? 1 : 0;
    std::fill(text.begin() + static_cast<std::ptrdiff_t>(end > at + 1 ? at : end),
      text.begin() + static_cast<std::ptrdiff_t>(end), ' ');
  }
}

/// With its faces, or, of a scan, its vertices with those faces that there are.
TriangleMesh readOBJ(const std::string& path, bool isScan, const Progress& progress)
{
  std::string bytes = readText(path);
  joinContinuedLines(bytes);
  TriangleMesh mesh;
  std::vector<int> corners; // of all faces, each behind their number
  bool hasPatches = false;
  TextLines lines(bytes);
  for (std::size_t line = 0; lines.next(); ++line)
  {
    reportLine(progress, line, lines, bytes.size());
    const std::string_view word = lines.word();
    if (word == "v" || word == "V")
    {
      mesh.vertices.push_back(pointOf(path, lines));
    }
    else if (word == "f" || word == "F" || word == "fo") // as old files call them
    {
      const std::size_t start = corners.size();
      corners.push_back(0);
      for (std::string_view corner = lines.word(); !corner.empty(); corner = lines.word())
      {
        corners.push_back(cornerOf(path, corner, static_cast<int>(mesh.vertices.size())));
        ++corners[start];
      }
    }
    hasPatches = hasPatches || word == "surf";
  }
  for (auto from = corners.begin(); from != corners.end();)
  {
    const auto to = from + 1 + *from;
    const auto missing =
      std::find_if(from + 1, to, [&](int corner) { return corner >= static_cast<int>(mesh.vertices.size()); });
    if (missing != to)
    {
      failMesh(path, "has a face with the corner '" + std::to_string(*missing + 1) + "', which does not exist");
    }
    addPolygon({ from + 1, to }, mesh);
    from = to;
  }
  if ((isScan ? mesh.vertices.empty() : mesh.triangles.empty()) || hasPatches)
  {
    failMesh(path, hasPatches              ? "holds free-form surfaces, which are not read: export it as a mesh"
                   : mesh.vertices.empty() ? "has no lines of vertices (v x y z) and faces: it is empty, or no OBJ file"
                                           : "has no faces: it holds no surface, but points or lines");
  }
  return mesh;
}

TriangleMesh readKind(const std::string& path, const Progress& progress)
{
  const std::string extension = extensionOf(path);
  if (extension == ".stl")
  {
    return readSTL(path, progress);
  }
  if (extension == ".obj")
  {
    return readOBJ(path, false, progress);
  }
  if (extension == ".ply")
  {
    return readPLYMesh(path, progress);
  }
  if (extension == ".off")
  {
    return readOFF(path, progress);
  }
  failMesh(path, isBRepFile(path)
                   ? "is a STEP or IGES file, which training reads (meam::loadCAD): give a mesh of it here"
                   : "has an extension that is not known: give a .step, .iges, .stl, .obj, .ply or .off");
}
}

bool isBRepFile(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".step" || extension == ".stp" || extension == ".iges" || extension == ".igs";
}

Points readOBJPoints(const std::string& path) { return readOBJ(path, true, {}).vertices; }

TriangleMesh readMesh(const std::string& path, const Progress& progress)
{
  report(progress, 0.0);
  TriangleMesh mesh = readKind(path, progress);
  if (mesh.triangles.empty())
  {
    failMesh(path, "has no faces: it holds no surface");
  }
  report(progress, 1.0);
  return mesh;
}
}
