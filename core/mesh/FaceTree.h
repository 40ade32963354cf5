// SPDX-License-Identifier: BSD-3-Clause
// The faces of a mesh in CGAL's AABB tree. Heavy: only for files that include CGAL anyway.
#pragma once

#include "base/Bounds.h"
#include "mesh/TriangleMesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace meam
{
/// Faces seen more slantwise than this, 0.06 degrees, are edge-on: as good as not there.
constexpr double EdgeOnCosine = 1e-3; // rounding

/// Asked exactly, so that nothing slips through between two faces; degenerate ones are left out. Any number of threads
/// may ask. Throws Error for a mesh without faces, an invalid vertex or index.
class FaceTree
{
public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

  explicit FaceTree(const TriangleMesh& mesh)
  {
    requireMesh(mesh);
    this->Extent = bounds(mesh.vertices).diagonal().norm();
    this->Faces.reserve(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles)
    {
      const auto corner = [&](int k) { return toCGAL(mesh.vertices[triangle[k]].cast<double>()); };
      const Kernel::Triangle_3 face(corner(0), corner(1), corner(2));
      if (!face.is_degenerate())
      {
        this->Faces.push_back(face);
      }
    }
    this->Boxes.rebuild(this->Faces.begin(), this->Faces.end());
    this->Boxes.build(); // now, not at the first question of some thread
  }
  FaceTree(const FaceTree&) = delete; // the boxes point to the faces
  void operator=(const FaceTree&) = delete;

  static Kernel::Point_3 toCGAL(const Eigen::Vector3d& point) { return { point.x(), point.y(), point.z() }; }
  static Kernel::Segment_3 segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
  {
    return { toCGAL(from), toCGAL(to) };
  }

  const CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>& boxes() const { return this->Boxes; }
  /// mm, the diagonal of the mesh's box.
  double extent() const { return this->Extent; }

private:
  Triangles Faces;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> Boxes;
  double Extent = 0.0;
};
}
