// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/MeshPreparation.h"

#include "mesh/ConvexHull.h"
#include "mesh/RequireMesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace meam
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Corners = std::array<std::size_t, 3>;

/// Drops triangles on a line that are at the border of the mesh: nothing holds on to them. The
/// faces of `mesh` are `triangles`, in that order. Returns the number dropped.
std::size_t dropDegenerateBorder(const Mesh& mesh, std::vector<Corners>& triangles)
{
  std::vector<Corners> kept;
  for (const auto face : mesh.faces())
  {
    bool border = false;
    for (const auto halfedge : CGAL::halfedges_around_face(mesh.halfedge(face), mesh))
    {
      border = border || mesh.is_border(mesh.opposite(halfedge));
    }
    if (!border || !PMP::is_degenerate_triangle_face(face, mesh))
    {
      kept.push_back(triangles[face]);
    }
  }
  const std::size_t dropped = triangles.size() - kept.size();
  triangles.swap(kept);
  return dropped;
}

/// The triangles with shared vertices, wound consistently; counts what it drops.
Mesh meshOfSoup(const TriangleMesh& input, const MeshPreparationSettings& settings, MeshReport& counts)
{
  std::vector<Kernel::Point_3> points;
  points.reserve(input.vertices.size());
  for (const auto& vertex : input.vertices)
  {
    const Eigen::Vector3d point = settings.scale * vertex.cast<double>() + settings.offset;
    points.emplace_back(point.x(), point.y(), point.z());
  }
  std::vector<Corners> triangles;
  triangles.reserve(input.triangles.size());
  for (const auto& triangle : input.triangles)
  {
    triangles.push_back({ static_cast<std::size_t>(triangle[0]), static_cast<std::size_t>(triangle[1]),
      static_cast<std::size_t>(triangle[2]) });
  }

  counts.isolatedVertices = static_cast<int>(PMP::remove_isolated_points_in_polygon_soup(points, triangles));
  counts.mergedVertices = static_cast<int>(PMP::merge_duplicate_points_in_polygon_soup(points, triangles));
  const auto repeats = [](const Corners& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
  const auto kept = std::remove_if(triangles.begin(), triangles.end(), repeats);
  counts.degenerateTriangles = static_cast<int>(triangles.end() - kept);
  triangles.erase(kept, triangles.end());
  counts.duplicateTriangles = static_cast<int>(PMP::merge_duplicate_polygons_in_polygon_soup(points, triangles));

  for (;;)
  {
    PMP::remove_isolated_points_in_polygon_soup(points, triangles);
    PMP::orient_polygon_soup(points, triangles);
    Mesh mesh;
    PMP::polygon_soup_to_polygon_mesh(points, triangles, mesh);
    PMP::stitch_borders(mesh);
    const std::size_t dropped = dropDegenerateBorder(mesh, triangles);
    counts.degenerateTriangles += static_cast<int>(dropped);
    if (dropped == 0)
    {
      return mesh;
    }
  }
}

/// Six times the volume between each component and its middle, with the sign of its winding.
std::vector<double> signedVolumes(const Mesh& mesh,
  const Mesh::Property_map<Mesh::Face_index, std::size_t>& componentOf, std::size_t components,
  std::vector<double>& areas)
{
  std::vector<Eigen::Vector3d> sums(components, Eigen::Vector3d::Zero());
  std::vector<double> counts(components, 0.0);
  std::vector<double> volumes(components, 0.0);
  areas.assign(components, 0.0);
  const auto cornersOf = [&](Mesh::Face_index face)
  {
    Eigen::Matrix3d corners;
    int k = 0;
    for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
    {
      const auto& point = mesh.point(vertex);
      corners.col(k++) << point.x(), point.y(), point.z();
    }
    return corners;
  };
  for (const auto face : mesh.faces())
  {
    sums[componentOf[face]] += cornersOf(face).rowwise().mean();
    counts[componentOf[face]] += 1.0;
  }
  for (const auto face : mesh.faces())
  {
    const std::size_t component = componentOf[face];
    const Eigen::Matrix3d corners = cornersOf(face).colwise() - sums[component] / counts[component];
    volumes[component] += corners.determinant();
    areas[component] += 0.5 * (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm();
  }
  return volumes;
}

/// Turns components outwards; returns how many were turned.
int orientOutward(Mesh& mesh, MeshReport& counts)
{
  auto componentOf = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:component", 0).first;
  std::size_t components = PMP::connected_components(mesh, componentOf);
  counts.components = static_cast<int>(components);
  counts.closed = CGAL::is_closed(mesh);
  if (!counts.closed)
  {
    components = 1;
    for (const auto face : mesh.faces())
    {
      componentOf[face] = 0;
    }
  }

  std::vector<double> areas;
  const std::vector<double> before = signedVolumes(mesh, componentOf, components, areas);
  if (components > 1 && counts.closed && !PMP::does_self_intersect(mesh))
  {
    // Cavities inside a body must stay turned inwards.
    PMP::orient_to_bound_a_volume(mesh);
    const std::vector<double> after = signedVolumes(mesh, componentOf, components, areas);
    int flipped = 0;
    for (std::size_t c = 0; c < components; ++c)
    {
      flipped += (before[c] < 0.0) != (after[c] < 0.0);
    }
    return flipped;
  }
  if (!counts.closed)
  {
    // Each component may be a patch of one body, the wall of a hole for one: only all of them
    // together can tell. A sheet that is nearly flat has no outside: its winding is the user's.
    if (before[0] >= -6e-3 * std::pow(areas[0], 1.5))
    {
      return 0;
    }
    PMP::reverse_face_orientations(mesh);
    return counts.components;
  }
  int flipped = 0;
  for (std::size_t c = 0; c < components; ++c)
  {
    if (before[c] < 0.0)
    {
      std::vector<Mesh::Face_index> faces;
      std::copy_if(mesh.faces_begin(), mesh.faces_end(), std::back_inserter(faces),
        [&](Mesh::Face_index face) { return componentOf[face] == c; });
      PMP::reverse_face_orientations(faces, mesh);
      ++flipped;
    }
  }
  return flipped;
}
}

PreparedMesh prepareMesh(const TriangleMesh& input, const MeshPreparationSettings& settings, const Progress& progress)
{
  requireMesh(input);
  if (!(settings.scale > 0.0) || !std::isfinite(settings.scale) || !settings.offset.allFinite())
  {
    throw Error("The scale of the mesh must be a positive number and its offset three numbers.");
  }
  PreparedMesh result;
  MeshReport& counts = result.report;
  counts.inputVertices = static_cast<int>(input.vertices.size());
  counts.inputTriangles = static_cast<int>(input.triangles.size());
  Mesh mesh = meshOfSoup(input, settings, counts);
  report(progress, 0.5);

  // Triangles on a line inside the mesh: flipped or collapsed, so that their neighbours stay
  // connected.
  for (const auto face : mesh.faces())
  {
    counts.degenerateTriangles += PMP::is_degenerate_triangle_face(face, mesh);
  }
  if (mesh.number_of_faces() > 0)
  {
    PMP::remove_degenerate_faces(mesh);
    PMP::remove_isolated_vertices(mesh);
  }
  if (mesh.number_of_faces() == 0)
  {
    throw Error("The mesh has no area: all of its faces are degenerate.");
  }
  report(progress, 0.7);
  counts.flippedComponents = orientOutward(mesh, counts);
  mesh.collect_garbage();

  result.mesh.vertices.reserve(mesh.number_of_vertices());
  for (const auto vertex : mesh.vertices())
  {
    const auto& point = mesh.point(vertex);
    result.mesh.vertices.emplace_back(
      static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z()));
  }
  result.mesh.triangles.reserve(mesh.number_of_faces());
  for (const auto face : mesh.faces())
  {
    Eigen::Vector3i triangle;
    int k = 0;
    for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
    {
      triangle[k++] = static_cast<int>(vertex);
    }
    result.mesh.triangles.push_back(triangle);
  }
  counts.vertices = static_cast<int>(mesh.number_of_vertices());
  counts.triangles = static_cast<int>(mesh.number_of_faces());
  for (const auto halfedge : mesh.halfedges())
  {
    counts.borderEdges += mesh.is_border(halfedge);
  }
  counts.area = PMP::area(mesh);
  counts.volume = counts.closed ? PMP::volume(mesh) : 0.0;
  counts.diameter = diameter(result.mesh.vertices);
  report(progress, 1.0);
  return result;
}
}
