// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/MeshRays.h"

#include "mesh/FaceTree.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double SamePlaceShare = 1e-6; // of the part's extent

Eigen::Vector3d toEigen(const FaceTree::Kernel::Point_3& point) { return { point.x(), point.y(), point.z() }; }
}

class MeshRays::Tree : public FaceTree
{
public:
  using FaceTree::FaceTree;
};

MeshRays::MeshRays(const TriangleMesh& mesh)
  : Faces(std::make_unique<const Tree>(mesh))
{
}

MeshRays::~MeshRays() = default;

std::vector<RayHit> MeshRays::hits(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double reach) const
{
  std::vector<FaceTree::Primitive::Id> faces;
  const auto ray = FaceTree::segment(from, from + reach * direction);
  this->Faces->boxes().all_intersected_primitives(ray, std::back_inserter(faces));
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
  const auto same = [samePlace = SamePlaceShare * this->Faces->extent()](const RayHit& a, const RayHit& b)
  { return a.entering == b.entering && b.distance - a.distance <= samePlace; };
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
