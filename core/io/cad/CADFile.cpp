// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad/CADFile.h"

#include "io/MeshFile.h"
#include "io/cad/BRepMesh.h"
#include "io/cad/ChildProcess.h"
#include "io/parsing/FileBytes.h"
#include "mesh/preparation/StrayComponents.h"

#include <cstring>

namespace meam
{
namespace
{
[[noreturn]] void failCAD(const std::string& path, const std::string& what)
{
  throw Error("The CAD file '" + path + "' " + what + ".");
}

struct BRepCounts
{
  int solids;
  std::size_t vertices, triangles;
};

std::string bytesOf(const BRepMesh& part)
{
  const BRepCounts counts{ part.solids, part.mesh.vertices.size(), part.mesh.triangles.size() };
  std::string bytes(reinterpret_cast<const char*>(&counts), sizeof(counts));
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
  const std::size_t triangles = sizeof(counts) + counts.vertices * sizeof(Eigen::Vector3f);
  if (counts.vertices == 0 || counts.triangles == 0 ||
      bytes.size() != triangles + counts.triangles * sizeof(Eigen::Vector3i))
  {
    return part;
  }
  part.solids = counts.solids;
  part.mesh.vertices.resize(counts.vertices);
  part.mesh.triangles.resize(counts.triangles);
  std::memcpy(part.mesh.vertices.front().data(), bytes.data() + sizeof(counts), triangles - sizeof(counts));
  std::memcpy(part.mesh.triangles.front().data(), bytes.data() + triangles, bytes.size() - triangles);
  return part;
}
}

CADPart readCAD(const std::string& path, const Progress& progress)
{
  if (!isBRepFile(path))
  {
    CADPart part{ readMesh(path, progress), {} };
    part.report = strayReport(path, part.mesh, MeshFileUnit);
    return part;
  }
  readFile(path, 1); // that it is there
  const auto bytes = runInChildProcess([&] { return bytesOf(meshOfBRep(path)); }, progress);
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
  CADPart result{ std::move(part.mesh), {} };
  if (part.solids > 1)
  {
    result.report = "The CAD file '" + path + "' holds " + std::to_string(part.solids) +
                    " solids, which are taken as one part: of an assembly export the part alone.";
  }
  const std::string stray = strayReport(path, result.mesh, "mm");
  result.report += (result.report.empty() || stray.empty() ? "" : " ") + stray;
  return result;
}
}
