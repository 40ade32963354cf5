// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/parts/ColumnMesh.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <map>

// All lines are drawn into one constrained triangulation of the plane, so that each of its triangles is the base of
// a column that is solid or empty between two levels. Columns tile space: the mesh is closed and does not cross
// itself.

namespace meam
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_predicates_tag>;

bool contains(const Polyline& outline, const Eigen::Vector2d& point)
{
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
    {
      inside = !inside;
    }
  }
  return inside;
}
}

TriangleMesh columnMesh(const std::vector<double>& levels, const std::vector<Polyline>& lines,
  const std::function<bool(const Eigen::Vector2d&, int)>& solidAt)
{
  Triangulation plane;
  for (const Polyline& line : lines)
  {
    for (std::size_t i = 1; i < line.size(); ++i)
    {
      plane.insert_constraint(
        Triangulation::Point(line[i - 1].x(), line[i - 1].y()), Triangulation::Point(line[i].x(), line[i].y()));
    }
  }
  const int layers = static_cast<int>(levels.size()) - 1;
  std::map<Triangulation::Face_handle, std::vector<bool>> columns;
  for (const auto face : plane.finite_face_handles())
  {
    const auto middle = CGAL::centroid(plane.triangle(face));
    for (int layer = 0; layer < layers; ++layer)
    {
      columns[face].push_back(solidAt({ middle.x(), middle.y() }, layer));
    }
  }
  const auto solid = [&](const Triangulation::Face_handle& face, int layer)
  { return !plane.is_infinite(face) && layer >= 0 && layer < layers && columns.at(face)[layer]; };

  TriangleMesh mesh;
  std::map<std::pair<Triangulation::Vertex_handle, int>, int> indices;
  const auto vertex = [&](const Triangulation::Vertex_handle& at, int level)
  {
    const auto [entry, isNew] = indices.try_emplace({ at, level }, static_cast<int>(mesh.vertices.size()));
    if (isNew)
    {
      mesh.vertices.push_back(Eigen::Vector3d(at->point().x(), at->point().y(), levels[level]).cast<float>());
    }
    return entry->second;
  };
  for (const auto face : plane.finite_face_handles())
  {
    for (int level = 0; level <= layers; ++level)
    {
      const bool below = solid(face, level - 1);
      if (below != solid(face, level))
      {
        // Corners are counter-clockwise seen from above.
        mesh.triangles.emplace_back(vertex(face->vertex(0), level), vertex(face->vertex(below ? 1 : 2), level),
          vertex(face->vertex(below ? 2 : 1), level));
      }
    }
    for (int i = 0; i < 3; ++i)
    {
      for (int layer = 0; layer < layers; ++layer)
      {
        if (solid(face, layer) && !solid(face->neighbor(i), layer))
        {
          const auto from = face->vertex(Triangulation::ccw(i));
          const auto to = face->vertex(Triangulation::cw(i));
          const int corners[4] = { vertex(from, layer), vertex(to, layer), vertex(to, layer + 1),
            vertex(from, layer + 1) };
          mesh.triangles.emplace_back(corners[0], corners[1], corners[2]);
          mesh.triangles.emplace_back(corners[0], corners[2], corners[3]);
        }
      }
    }
  }
  return mesh;
}
TriangleMesh featureMesh(const std::vector<Feature>& features)
{
  std::vector<double> levels;
  std::vector<Polyline> lines;
  for (const Feature& feature : features)
  {
    levels.insert(levels.end(), { feature.bottom, feature.top });
    lines.push_back(feature.outline);
    lines.back().push_back(feature.outline.front());
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return columnMesh(levels, lines,
    [&](const Eigen::Vector2d& point, int layer)
    {
      const double height = 0.5 * (levels[layer] + levels[layer + 1]);
      const auto last = std::find_if(features.rbegin(), features.rend(),
        [&](const Feature& feature)
        { return height > feature.bottom && height < feature.top && contains(feature.outline, point); });
      return last != features.rend() && last->kind == Feature::Solid;
    });
}
}
