// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad/CADFile.h"

#include "base/Error.h"
#include "io/MeshFile.h"
#include "io/cad/BRepMesh.h"
#include "io/cad/ChildProcess.h"
#include "io/parsing/FileBytes.h"
#include "mesh/preparation/StrayComponents.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace meam
{
namespace
{
[[noreturn]] void failCAD(const std::string& path, const std::string& what)
{
  throw Error("The CAD file '" + path + "' " + what + ".");
}

constexpr std::size_t MostSolidsTold = 6; // a warning is read as a whole

struct BRepCounts
{
  std::size_t solids, vertices, triangles;
};

std::string bytesOf(const BRepMesh& part)
{
  const BRepCounts counts{ part.solidSizes.size(), part.mesh.vertices.size(), part.mesh.triangles.size() };
  std::string bytes(reinterpret_cast<const char*>(&counts), sizeof(counts));
  bytes.append(reinterpret_cast<const char*>(part.solidSizes.data()), counts.solids * sizeof(Eigen::Vector3f));
  bytes.append(reinterpret_cast<const char*>(part.mesh.vertices.data()), counts.vertices * sizeof(Eigen::Vector3f));
  return bytes.append(
    reinterpret_cast<const char*>(part.mesh.triangles.data()), counts.triangles * sizeof(Eigen::Vector3i));
}

/// What bytesOf() made bytes of; without triangles when it did not.
BRepMesh brepOf(const std::string& bytes)
{
  BRepMesh part;
  BRepCounts counts;
  if (bytes.size() < sizeof(counts))
  {
    return part;
  }
  std::memcpy(&counts, bytes.data(), sizeof(counts));
  const std::size_t vertices = sizeof(counts) + counts.solids * sizeof(Eigen::Vector3f);
  const std::size_t triangles = vertices + counts.vertices * sizeof(Eigen::Vector3f);
  if (counts.vertices == 0 || counts.triangles == 0 ||
      bytes.size() != triangles + counts.triangles * sizeof(Eigen::Vector3i))
  {
    return part;
  }
  part.solidSizes.assign(counts.solids, Eigen::Vector3f::Zero());
  part.mesh.vertices.resize(counts.vertices);
  part.mesh.triangles.resize(counts.triangles);
  std::copy_n(
    bytes.data() + sizeof(counts), vertices - sizeof(counts), reinterpret_cast<char*>(part.solidSizes.data()));
  std::memcpy(part.mesh.vertices.front().data(), bytes.data() + vertices, triangles - vertices);
  std::memcpy(part.mesh.triangles.front().data(), bytes.data() + triangles, bytes.size() - triangles);
  return part;
}

/// What to tell of the solids that are taken as one part.
std::string solidsReport(const std::string& path, const Points& sizes)
{
  if (sizes.size() < 2)
  {
    return {};
  }
  std::string text = "The CAD file '" + path + "' holds " + std::to_string(sizes.size()) +
                     " solids, which are taken as one part. Of an assembly choose the part by its number (solid)";
  for (std::size_t i = 0; i < std::min(sizes.size(), MostSolidsTold); ++i)
  {
    char told[96];
    std::snprintf(told, sizeof told, "%s%zu is %.4g x %.4g x %.4g mm", i == 0 ? ": " : ", ", i + 1, sizes[i].x(),
      sizes[i].y(), sizes[i].z());
    text += told;
  }
  return text + (sizes.size() > MostSolidsTold ? ", and so on." : ".");
}
}

CADPart readCAD(const std::string& path, const CADSettings& settings, const Progress& progress)
{
  if (settings.solid < 0)
  {
    throw Error("The number of the solid has to be 0 (all) or more, not " + std::to_string(settings.solid) + ".");
  }
  if (!isBRepFile(path))
  {
    if (settings.solid > 0)
    {
      failCAD(path, "is a mesh, which has no solids to choose from: choose solid 0, or give a STEP or IGES file");
    }
    CADPart part{ readMesh(path, progress), {} };
    part.report = strayReport(path, part.mesh, MeshFileUnit);
    return part;
  }
  readFile(path, 1); // that it is there
  const auto bytes = runInChildProcess([&] { return bytesOf(meshOfBRep(path, settings.solid)); }, progress);
  if (!bytes)
  {
    failCAD(path, "is damaged, or takes too much memory or time: Open CASCADE, which reads it, ended without a result");
  }
  BRepMesh part = brepOf(*bytes);
  if (part.mesh.triangles.empty())
  {
    failCAD(path, "holds no surface; triangles in it are not read, export these as STL");
  }
  requireMesh(part.mesh);
  report(progress, 1.0);
  CADPart result{ std::move(part.mesh), solidsReport(path, part.solidSizes) };
  appendSentence(result.report, strayReport(path, result.mesh, "mm"));
  return result;
}
}
