// SPDX-License-Identifier: BSD-3-Clause
#include "io/OFFFile.h"

#include "io/parsing/FileBytes.h"
#include "io/parsing/TextLines.h"
#include "mesh/PolygonTriangulation.h"

#include <cstdint>
#include <limits>
#include <string_view>

namespace meam
{
namespace
{
[[noreturn]] void failOFF(const std::string& path, const std::string& what)
{
  throw Error("The OFF file '" + path + "' " + what + ".");
}

/// How many letters OFF takes at the start of a word, with those before it, ST texture, C colour, N normal, which stand
/// in any order; or all of it in lower case. A number may follow without a blank. 4OFF and nOFF have points of other
/// dimensions.
std::size_t lengthOfOFF(std::string_view word)
{
  const std::size_t length = word.size();
  for (const std::string_view part : { "ST", "C", "N", "C" })
  {
    word.remove_prefix(word.substr(0, part.size()) == part ? part.size() : 0);
  }
  const std::string_view kind = word.substr(0, 3);
  const bool isOFF =
    (kind == "OFF" || kind == "off") && word.find_first_not_of("0123456789", 3) == std::string_view::npos;
  return isOFF ? length - word.size() + 3 : 0;
}

/// A word that is not what it should be, for a message.
std::string quoted(std::string_view word)
{
  return word.empty() ? "the line ends, the file is cut off or damaged" : "'" + std::string(word.substr(0, 40)) + "'";
}
}

TriangleMesh readOFF(const std::string& path, const Progress& progress)
{
  const std::string text = readText(path);
  report(progress, 0.0);
  TextLines lines(text);
  std::string_view word = lines.next() ? lines.word() : std::string_view();
  const std::size_t letters = lengthOfOFF(word);
  word.remove_prefix(letters);
  if (letters > 0 && word.empty())
  {
    word = lines.word();
    if (word == "BINARY")
    {
      failOFF(path, "is binary: save it as ascii");
    }
    if (word.empty())
    {
      word = lines.next() ? lines.word() : std::string_view();
    }
  }
  // Geomview's files may begin with the numbers.
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  if (!parseNumber(word, vertices) || !parseNumber(lines.word(), faces))
  {
    failOFF(path, letters > 0
                    ? "has no numbers of vertices and faces after its first word"
                    : "does not start with OFF, COFF, NOFF or STOFF: it is not an OFF file, or one of points of "
                      "other dimensions (4OFF, nOFF)");
  }
  // A line takes at least a character for each number and one between two of them.
  constexpr std::uint64_t most = std::numeric_limits<int>::max() / 3;
  const std::uint64_t room = lines.left();
  if (vertices > most || faces > most || vertices > room / 5 || faces > room / 3)
  {
    failOFF(path, "is cut off: it promises " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                    " faces, more than the file has room for");
  }

  TriangleMesh mesh;
  mesh.vertices.resize(vertices);
  const std::uint64_t all = vertices + faces;
  for (std::uint64_t v = 0; v < vertices; ++v)
  {
    if (!lines.next())
    {
      failOFF(path, "is cut off: it ends after " + std::to_string(v) + " of " + std::to_string(vertices) + " vertices");
    }
    for (int k = 0; k < 3; ++k)
    {
      word = lines.word();
      double value = 0.0;
      if (!parseNumber(word, value))
      {
        failOFF(path, "has a coordinate that is not a number in vertex " + std::to_string(v) + ": " + quoted(word));
      }
      mesh.vertices[v][k] = static_cast<float>(value);
    }
    reportStep(progress, v, static_cast<double>(v) / static_cast<double>(all));
  }
  mesh.triangles.reserve(faces);
  std::vector<int> polygon;
  for (std::uint64_t f = 0; f < faces; ++f)
  {
    const std::string place = "face " + std::to_string(f);
    if (!lines.next())
    {
      failOFF(path, "is cut off: it ends after " + std::to_string(f) + " of " + std::to_string(faces) + " faces");
    }
    word = lines.word();
    std::uint64_t corners = 0;
    if (!parseNumber(word, corners))
    {
      failOFF(path, "has no number of corners in " + place + ": " + quoted(word));
    }
    polygon.clear();
    for (std::uint64_t k = 0; k < corners; ++k)
    {
      word = lines.word();
      std::uint64_t vertex = 0;
      if (!parseNumber(word, vertex) || vertex >= vertices)
      {
        failOFF(path, "has a corner in " + place + " that is not the number of a vertex: " + quoted(word));
      }
      polygon.push_back(static_cast<int>(vertex));
    }
    addPolygon(polygon, mesh);
    reportStep(progress, f, static_cast<double>(vertices + f) / static_cast<double>(all));
  }
  if (lines.next())
  {
    failOFF(path, "goes on after the " + std::to_string(faces) + " faces that it promises: it is damaged");
  }
  report(progress, 1.0);
  return mesh;
}
}
