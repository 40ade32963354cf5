// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/MeshRepair.h"

#include "base/sequences/Sequences.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace meam
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;
using Point = MeshKernel::Point_3;
using Corners = std::array<std::size_t, 3>;
using Halfedge = SurfaceMesh::Halfedge_index;

// Of the mesh's extent, vertices nearer to each other are one: ten times what is lost when coordinates are written as
// floats.
constexpr double SamePlace = 1e-6; // rounding

Eigen::Vector3d toVector(const Point& point) { return { point.x(), point.y(), point.z() }; }

/// Lets corners of triangles that are nearly at the same place be the same point; returns how many
/// points are no longer used.
std::size_t mergeNearPoints(const std::vector<Point>& points, std::vector<Corners>& triangles)
{
  Eigen::AlignedBox3d box;
  for (const auto& point : points)
  {
    box.extend(toVector(point));
  }
  const double reach = SamePlace * box.diagonal().norm();

  // Sorted along a direction that no face of a part is likely to be across.
  const Eigen::Vector3d direction = Eigen::Vector3d(0.6127, 0.5381, 0.4783).normalized();
  const auto along =
    ofIndices<double>(points.size(), [&](int i) { return direction.dot(toVector(points[i]) - box.min()); });
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return along[a] != along[b] ? along[a] < along[b] : a < b; });

  std::vector<std::size_t> standsFor(points.size());
  std::iota(standsFor.begin(), standsFor.end(), std::size_t{ 0 });
  std::size_t merged = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const std::size_t own = order[i];
    for (std::size_t k = i + 1; standsFor[own] == own && k < order.size() && along[order[k]] - along[own] <= reach; ++k)
    {
      const std::size_t other = order[k];
      if (standsFor[other] == other && (toVector(points[other]) - toVector(points[own])).norm() <= reach)
      {
        standsFor[other] = own;
        ++merged;
      }
    }
  }
  for (auto& triangle : triangles)
  {
    for (auto& corner : triangle)
    {
      corner = standsFor[corner];
    }
  }
  return merged;
}

/// Drops triangles on a line that are at the border of the mesh: nothing holds on to them. The
/// faces of `mesh` are `triangles`, in that order. Returns the number dropped.
std::size_t dropDegenerateBorder(const SurfaceMesh& mesh, std::vector<Corners>& triangles)
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

/// Sews open seams and drops degenerate triangles at the border until there are none.
SurfaceMesh sewnMesh(std::vector<Point>& points, std::vector<Corners>& triangles, MeshReport& counts)
{
  for (;;)
  {
    PMP::remove_isolated_points_in_polygon_soup(points, triangles);
    PMP::orient_polygon_soup(points, triangles);
    SurfaceMesh mesh;
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
}

SurfaceMesh meshOfSoup(
  const TriangleMesh& input, const MeshPreparationSettings& settings, MeshReport& counts, const Progress& progress)
{
  std::vector<Point> points;
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
  counts.nearVertices = static_cast<int>(mergeNearPoints(points, triangles));
  const auto repeats = [](const Corners& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
  const auto kept = std::remove_if(triangles.begin(), triangles.end(), repeats);
  counts.degenerateTriangles = static_cast<int>(triangles.end() - kept);
  triangles.erase(kept, triangles.end());
  counts.duplicateTriangles = static_cast<int>(PMP::merge_duplicate_polygons_in_polygon_soup(points, triangles));
  report(progress, 0.3);
  SurfaceMesh mesh = sewnMesh(points, triangles, counts);
  report(progress, 0.8);

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
    PMP::duplicate_non_manifold_vertices(mesh);
  }
  return mesh;
}

void keepLargestComponent(SurfaceMesh& mesh, MeshReport& counts)
{
  FaceNumbers componentOf;
  const std::vector<double> areas = componentAreas(mesh, componentOf);
  const auto largest = static_cast<std::size_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
  PMP::keep_connected_components(mesh, std::vector<std::size_t>{ largest }, componentOf);
  mesh.collect_garbage();
  counts.droppedComponents = static_cast<int>(areas.size()) - 1;
}

void closeHoles(SurfaceMesh& mesh, double holeSize, MeshReport& counts, const Progress& progress)
{
  FaceNumbers componentOf;
  const std::vector<double> areas = componentAreas(mesh, componentOf);
  std::vector<Halfedge> borders;
  PMP::extract_boundary_cycles(mesh, std::back_inserter(borders));
  for (std::size_t i = 0; i < borders.size(); ++i)
  {
    report(progress, static_cast<double>(i) / static_cast<double>(borders.size()));
    double length = 0.0;
    Eigen::Vector3d twiceArea = Eigen::Vector3d::Zero();
    const Eigen::Vector3d origin = toVector(mesh.point(mesh.target(borders[i])));
    for (const auto halfedge : CGAL::halfedges_around_face(borders[i], mesh))
    {
      const Eigen::Vector3d from = toVector(mesh.point(mesh.source(halfedge))) - origin;
      const Eigen::Vector3d to = toVector(mesh.point(mesh.target(halfedge))) - origin;
      length += (to - from).norm();
      twiceArea += from.cross(to);
    }
    // What encloses more than the other half of a component is not a hole but its outer border.
    const double area = areas[componentOf[mesh.face(mesh.opposite(borders[i]))]];
    if (length > holeSize || twiceArea.norm() > area)
    {
      continue;
    }
    std::vector<SurfaceMesh::Face_index> patch;
    PMP::triangulate_hole(mesh, borders[i], std::back_inserter(patch));
    for (const auto face : patch)
    {
      componentOf[face] = componentOf[mesh.face(mesh.opposite(borders[i]))];
    }
    counts.closedHoles += !patch.empty();
  }
}

namespace
{
/// The points of a mesh, for a function that reports no progress: by how often it has asked for one.
struct WatchedPoints
{
  using key_type = SurfaceMesh::Vertex_index;
  using value_type = Point;
  using reference = const Point&;
  using category = boost::readable_property_map_tag;

  const SurfaceMesh& mesh;
  const Progress& progress;
  std::size_t& asked;

  friend reference get(const WatchedPoints& points, key_type vertex)
  {
    constexpr std::size_t Stride = 1 << 18; // some hundredths of a second
    constexpr double AskedOfFace = 60.0;    // by self_intersections(), where nothing intersects
    if (++points.asked % Stride == 0)
    {
      report(points.progress, std::min(1.0, static_cast<double>(points.asked) /
                                              (AskedOfFace * static_cast<double>(points.mesh.number_of_faces()))));
    }
    return points.mesh.point(vertex);
  }
};
}

int countIntersections(const SurfaceMesh& mesh, const Progress& progress)
{
  struct Enough
  {
  };
  int count = 0;
  const auto add = [&](const std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>& pair)
  {
    // A triangle without area that could not be removed comes with itself.
    count += pair.first != pair.second;
    if (count == MostIntersections)
    {
      throw Enough();
    }
  };
  try
  {
    std::size_t asked = 0;
    PMP::self_intersections(mesh, boost::make_function_output_iterator(add),
      PMP::parameters::vertex_point_map(WatchedPoints{ mesh, progress, asked }));
  }
  catch (const Enough&)
  {
  }
  return count;
}
}
