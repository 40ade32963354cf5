// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/LineOfSight.h"

#include "mesh/FaceTree.h"

#include <cmath>

namespace meam
{
namespace
{
constexpr double HairShare = 1e-4; // of the part's extent
}

class LineOfSight::Tree : public FaceTree
{
public:
  using FaceTree::FaceTree;
};

LineOfSight::LineOfSight(const TriangleMesh& mesh)
  : Faces(std::make_unique<const Tree>(mesh))
{
}

LineOfSight::~LineOfSight() = default;

bool LineOfSight::isFree(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const
{
  return !this->Faces->boxes().do_intersect(FaceTree::segment(from, to));
}

bool LineOfSight::isSeen(
  const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Eigen::Vector3d& viewpoint) const
{
  const double cosine = normal.dot((viewpoint - point).normalized());
  return std::abs(cosine) > EdgeOnCosine &&
         this->isFree(point + std::copysign(this->hair(), cosine) * normal, viewpoint);
}

double LineOfSight::hair() const { return HairShare * this->Faces->extent(); }
}
