// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/MeshRays.h"

#include "base/Bounds.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel; // no ray slips through between two faces
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

constexpr double SamePlaceShare = 1e-6; // of the part's extent
constexpr double EdgeOnCosine = 1e-3;   // 0.06 degrees

Kernel::Point_3 toCGAL(const Eigen::Vector3d& point) { return { point.x(), point.y(), point.z() }; }
Eigen::Vector3d toEigen(const Kernel::Point_3& point) { return { point.x(), point.y(), point.z() }; }
}

class MeshRays::Tree
{
public:
  explicit Tree(const TriangleMesh& mesh)
    : SamePlace(SamePlaceShare * bounds(mesh.vertices).diagonal().norm())
  {
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

  Triangles Faces;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> Boxes;
  double SamePlace;
};

MeshRays::MeshRays(const TriangleMesh& mesh)
{
  requireMesh(mesh);
  this->Faces = std::make_unique<const Tree>(mesh);
}

MeshRays::~MeshRays() = default;

std::vector<RayHit> MeshRays::hits(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double reach) const
{
  std::vector<Primitive::Id> faces;
  const Kernel::Segment_3 ray(toCGAL(from), toCGAL(from + reach * direction));
  this->Faces->Boxes.all_intersected_primitives(ray, std::back_inserter(faces));
  std::sort(faces.begin(), faces.end());
  std::vector<RayHit> found;
  for (const auto& face : faces)
  {
    const Eigen::Vector3d a = toEigen(face->vertex(0));
    const Eigen::Vector3d normal = (toEigen(face->vertex(1)) - a).cross(toEigen(face->vertex(2)) - a).normalized();
    const double cosine = normal.dot(direction);
    if (std::abs(cosine) > EdgeOnCosine)
    {
      found.push_back({ normal.dot(a - from) / cosine, normal, cosine < 0.0 });
    }
  }
  std::stable_sort(
    found.begin(), found.end(), [](const RayHit& a, const RayHit& b) { return a.distance < b.distance; });
  const auto same = [this](const RayHit& a, const RayHit& b)
  { return a.entering == b.entering && b.distance - a.distance <= this->Faces->SamePlace; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

std::optional<RayHit> MeshRays::firstEntered(
  const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double reach) const
{
  for (const RayHit& hit : this->hits(from, direction, reach))
  {
    if (hit.entering)
    {
      return hit;
    }
  }
  return {};
}
}
