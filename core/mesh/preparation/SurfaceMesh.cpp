// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/SurfaceMesh.h"

#include "mesh/TriangleMesh.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <array>

namespace meam
{
namespace PMP = CGAL::Polygon_mesh_processing;

SurfaceMesh toSurfaceMesh(const TriangleMesh& mesh)
{
  std::vector<MeshKernel::Point_3> points;
  points.reserve(mesh.vertices.size());
  for (const auto& vertex : mesh.vertices)
  {
    points.emplace_back(vertex.x(), vertex.y(), vertex.z());
  }
  std::vector<std::array<std::size_t, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
  {
    triangles.push_back({ static_cast<std::size_t>(triangle[0]), static_cast<std::size_t>(triangle[1]),
      static_cast<std::size_t>(triangle[2]) });
  }
  if (!PMP::is_polygon_soup_a_polygon_mesh(triangles))
  {
    PMP::orient_polygon_soup(points, triangles);
  }
  SurfaceMesh result;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, result);
  return result;
}

TriangleMesh toTriangleMesh(const SurfaceMesh& mesh)
{
  TriangleMesh result;
  std::vector<int> numberOf(mesh.num_vertices(), -1);
  result.vertices.reserve(mesh.number_of_vertices());
  for (const auto vertex : mesh.vertices())
  {
    const auto& point = mesh.point(vertex);
    numberOf[vertex] = static_cast<int>(result.vertices.size());
    result.vertices.emplace_back(
      static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z()));
  }
  result.triangles.reserve(mesh.number_of_faces());
  for (const auto face : mesh.faces())
  {
    Eigen::Vector3i triangle;
    int k = 0;
    for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
    {
      triangle[k++] = numberOf[vertex];
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

Eigen::Matrix3d cornersOf(const SurfaceMesh& mesh, SurfaceMesh::Face_index face)
{
  Eigen::Matrix3d corners;
  int k = 0;
  for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
  {
    const auto& point = mesh.point(vertex);
    corners.col(k++) << point.x(), point.y(), point.z();
  }
  return corners;
}

std::vector<double> componentAreas(SurfaceMesh& mesh, FaceNumbers& componentOf)
{
  componentOf = mesh.add_property_map<SurfaceMesh::Face_index, std::size_t>("f:component", 0).first;
  std::vector<double> areas(PMP::connected_components(mesh, componentOf), 0.0);
  for (const auto face : mesh.faces())
  {
    const Eigen::Matrix3d corners = cornersOf(mesh, face);
    areas[componentOf[face]] += 0.5 * (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm();
  }
  return areas;
}
}
