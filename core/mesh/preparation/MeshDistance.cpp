// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/MeshDistance.h"

#include "base/Parallel.h"
#include "base/sequences/Sequences.h"
#include "mesh/MeshEdges.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr int LeastPoints = 20000; // that are measured at least, and as many as the finer mesh has vertices

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 toPoint(const Eigen::Vector3f& point) { return { point.x(), point.y(), point.z() }; }

double areaOf(const TriangleMesh& mesh, const Eigen::Vector3i& triangle)
{
  const Eigen::Vector3f a = mesh.vertices[triangle[0]];
  return 0.5 * (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a).norm();
}

/// The corners of faces, and points on edges and faces at about `spacing`.
Points spread(const TriangleMesh& mesh, double spacing)
{
  Points points;
  std::vector<bool> taken(mesh.vertices.size(), false);
  for (const auto& edge : edgesOf(mesh))
  {
    for (const int vertex : edge.vertices)
    {
      if (!taken[vertex])
      {
        taken[vertex] = true;
        points.push_back(mesh.vertices[vertex]);
      }
    }
    const Eigen::Vector3f from = mesh.vertices[edge.vertices[0]];
    const Eigen::Vector3f way = mesh.vertices[edge.vertices[1]] - from;
    const int steps = std::max(2, static_cast<int>(std::ceil(way.norm() / spacing)));
    for (int i = 1; i < steps; ++i)
    {
      points.push_back(from + static_cast<float>(i) / static_cast<float>(steps) * way);
    }
  }
  for (const auto& triangle : mesh.triangles)
  {
    // The middles of the steps^2 small triangles that the triangle is cut into.
    const Eigen::Vector3f a = mesh.vertices[triangle[0]];
    const int steps = static_cast<int>(std::ceil(std::sqrt(areaOf(mesh, triangle)) / spacing));
    const Eigen::Vector3f u = (mesh.vertices[triangle[1]] - a) / static_cast<float>(3 * std::max(1, steps));
    const Eigen::Vector3f v = (mesh.vertices[triangle[2]] - a) / static_cast<float>(3 * std::max(1, steps));
    for (int i = 0; i < steps; ++i)
    {
      for (int k = 0; i + k < steps; ++k)
      {
        points.push_back(a + static_cast<float>(3 * i + 1) * u + static_cast<float>(3 * k + 1) * v);
        if (i + k + 1 < steps)
        {
          points.push_back(a + static_cast<float>(3 * i + 2) * u + static_cast<float>(3 * k + 2) * v);
        }
      }
    }
  }
  return points;
}

double largestDistance(const Points& points, const TriangleMesh& mesh, const Progress& progress)
{
  Triangles triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
  {
    if (areaOf(mesh, triangle) > 0.0)
    {
      triangles.emplace_back(
        toPoint(mesh.vertices[triangle[0]]), toPoint(mesh.vertices[triangle[1]]), toPoint(mesh.vertices[triangle[2]]));
    }
  }
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  const int threads = numberOfThreads(0);
  std::vector<double> largest(threads, 0.0);
  parallelFor(static_cast<int>(points.size()), threads, progress,
    [&](int begin, int end, int thread)
    {
      for (int i = begin; i < end; ++i)
      {
        largest[thread] = std::max(largest[thread], tree.squared_distance(toPoint(points[i])));
      }
    });
  return std::sqrt(*std::max_element(largest.begin(), largest.end()));
}
}

double meshDistance(const TriangleMesh& a, const TriangleMesh& b, const Progress& progress)
{
  const double area = sumOf(a.triangles, [&](const auto& triangle) { return areaOf(a, triangle); });
  const double wanted = std::max({ static_cast<double>(LeastPoints), static_cast<double>(a.vertices.size()),
    static_cast<double>(b.vertices.size()) });
  const double spacing = std::sqrt(area / wanted);
  const double ofA = largestDistance(spread(a, spacing), b, subProgress(progress, 0.0, 0.5));
  const double ofB = largestDistance(spread(b, spacing), a, subProgress(progress, 0.5, 1.0));
  return std::max(ofA, ofB);
}
}
