// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/LineOfSight.h"

#include "base/Bounds.h"
#include "mesh/TriangleMesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

namespace meam
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

constexpr double HairShare = 1e-4;    // of the part's extent
constexpr double EdgeOnCosine = 1e-3; // 0.06 degrees

Kernel::Point_3 toCGAL(const Eigen::Vector3d& point) { return { point.x(), point.y(), point.z() }; }
}

class LineOfSight::Tree
{
public:
  explicit Tree(const TriangleMesh& mesh)
    : Hair(HairShare * bounds(mesh.vertices).diagonal().norm())
  {
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

  Triangles Faces;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> Boxes;
  double Hair;
};

LineOfSight::LineOfSight(const TriangleMesh& mesh)
{
  requireMesh(mesh);
  this->Faces = std::make_unique<const Tree>(mesh);
}

LineOfSight::~LineOfSight() = default;

bool LineOfSight::isFree(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const
{
  return !this->Faces->Boxes.do_intersect(Kernel::Segment_3(toCGAL(from), toCGAL(to)));
}

bool LineOfSight::isSeen(
  const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Eigen::Vector3d& viewpoint) const
{
  const double cosine = normal.dot((viewpoint - point).normalized());
  return std::abs(cosine) > EdgeOnCosine &&
         this->isFree(point + std::copysign(this->Faces->Hair, cosine) * normal, viewpoint);
}

double LineOfSight::hair() const { return this->Faces->Hair; }
}
