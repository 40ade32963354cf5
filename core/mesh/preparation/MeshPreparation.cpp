// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/MeshPreparation.h"

#include "base/Range.h"
#include "mesh/ConvexHull.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshOrientation.h"
#include "mesh/preparation/MeshRemeshing.h"
#include "mesh/preparation/MeshRepair.h"
#include "mesh/preparation/MeshSimplification.h"
#include "mesh/preparation/StrayComponents.h"

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <vector>

namespace meam
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;

void requireSettings(const MeshPreparationSettings& settings)
{
  requirePositive("scale of the mesh", settings.scale);
  if (!settings.offset.allFinite())
  {
    throw Error("The offset of the mesh has to be three finite numbers.");
  }
  requireWithin("size of holes to close", settings.holeSize, 0.0, Unbounded, " mm");
  requireWithin("largest error of the simplified mesh", settings.maximumError, 0.0, Unbounded, " mm");
  requireWithin("edge length of the new mesh", settings.edgeLength, 0.0, Unbounded, " mm");
}

/// Simplifies and remakes the mesh as the settings wish.
void refine(SurfaceMesh& mesh, const MeshPreparationSettings& settings, const Progress& progress)
{
  TriangleMesh triangles = toTriangleMesh(mesh);
  if (settings.maximumError > 0.0)
  {
    triangles = simplifyMesh(triangles, settings.maximumError, subProgress(progress, 0.0, 0.6));
  }
  if (settings.edgeLength > 0.0)
  {
    triangles = remesh(triangles, settings.edgeLength, subProgress(progress, 0.6, 1.0));
  }
  mesh = toSurfaceMesh(triangles);
}

std::string counted(int count, const std::string& one, const std::string& many)
{
  return std::to_string(count) + " " + (count == 1 ? one : many);
}
}

std::string describe(const MeshReport& report)
{
  std::vector<std::string> found;
  const auto add = [&](int count, const std::string& one, const std::string& many)
  {
    if (count > 0)
    {
      found.push_back(counted(count, one, many));
    }
  };
  add(report.isolatedVertices, "vertex of no face removed", "vertices of no face removed");
  add(report.mergedVertices, "vertex merged with one at its place", "vertices merged with others at their place");
  add(report.nearVertices, "vertex merged with one next to it", "vertices merged with others next to them");
  add(report.degenerateTriangles, "triangle without area removed", "triangles without area removed");
  add(report.duplicateTriangles, "duplicate triangle removed", "duplicate triangles removed");
  add(report.droppedComponents, "smaller component dropped", "smaller components dropped");
  add(report.closedHoles, "hole closed", "holes closed");
  add(report.flippedComponents, "component faced inwards and was turned", "components faced inwards and were turned");
  if (report.intersections == MostIntersections)
  {
    found.push_back("at least " + std::to_string(MostIntersections) + " pairs of triangles intersect");
  }
  else
  {
    add(report.intersections, "pair of triangles intersects", "pairs of triangles intersect");
  }
  found.push_back(report.closed ? "closed" : "open: " + counted(report.borderEdges, "border edge", "border edges"));
  found.push_back(counted(report.components, "component", "components") + " of " +
                  counted(report.triangles, "triangle", "triangles"));
  found.insert(found.end(), report.stray.begin(), report.stray.end());
  std::string text;
  for (const auto& part : found)
  {
    text += (text.empty() ? "" : "; ") + part;
  }
  return text;
}

PreparedMesh prepareMesh(const TriangleMesh& input, const MeshPreparationSettings& settings, const Progress& progress)
{
  requireMesh(input);
  requireSettings(settings);
  PreparedMesh result;
  MeshReport& counts = result.report;
  counts.inputVertices = static_cast<int>(input.vertices.size());
  counts.inputTriangles = static_cast<int>(input.triangles.size());
  report(progress, 0.0);
  SurfaceMesh mesh = meshOfSoup(input, settings, counts, subProgress(progress, 0.0, 0.3));
  if (mesh.number_of_faces() == 0)
  {
    throw Error("The mesh has no area: all of its faces are degenerate.");
  }
  report(progress, 0.3);

  if (settings.keptComponents == KeptComponents::Largest)
  {
    keepLargestComponent(mesh, counts);
  }
  if (settings.holeSize > 0.0)
  {
    closeHoles(mesh, settings.holeSize, counts, subProgress(progress, 0.3, 0.4));
  }
  counts.intersections = countIntersections(mesh, subProgress(progress, 0.4, 0.6));
  counts.flippedComponents = orientOutward(mesh, counts.intersections > 0);
  report(progress, 0.6);
  if (settings.maximumError > 0.0 || settings.edgeLength > 0.0)
  {
    refine(mesh, settings, subProgress(progress, 0.6, 0.95));
    counts.intersections = countIntersections(mesh, subProgress(progress, 0.95, 1.0));
  }
  mesh.collect_garbage();

  result.mesh = toTriangleMesh(mesh);
  counts.vertices = static_cast<int>(mesh.number_of_vertices());
  counts.triangles = static_cast<int>(mesh.number_of_faces());
  FaceNumbers componentOf;
  counts.components = static_cast<int>(componentAreas(mesh, componentOf).size());
  for (const auto halfedge : mesh.halfedges())
  {
    counts.borderEdges += mesh.is_border(halfedge);
  }
  counts.closed = counts.borderEdges == 0;
  counts.area = PMP::area(mesh);
  counts.volume = counts.closed ? PMP::volume(mesh) : 0.0;
  counts.diameter = diameter(result.mesh.vertices);
  counts.stray = strayComponents(result.mesh, "mm");
  report(progress, 1.0);
  return result;
}
}
