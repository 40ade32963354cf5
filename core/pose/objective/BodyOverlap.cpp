// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/BodyOverlap.h"

#include "pose/PoseTolerances.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr double Deepest = 0.1;       // of the diameter, of what is looked at: its neighbours are less deep
constexpr double LeastShare = 0.05;   // of the surface that lies inside; less may be where the part is bent
constexpr float StraightBelow = 0.7f; // cosine, way to the nearest sample against its normal: else beside an edge
}

BodyOverlap::BodyOverlap(const TrainedModel& model)
  : Model(model)
  , Surface(model.surface.points, Deepest * model.diameter)
{
}

double BodyOverlap::shareInside(const Eigen::Isometry3f& T) const
{
  const PointCloud& surface = this->Model.surface;
  const float least = static_cast<float>(FitDistance * this->Model.diameter);
  std::size_t inside = 0;
  for (const int i : this->Model.verificationPoints)
  {
    const Eigen::Vector3f point = T * surface.points[i];
    const int nearest = this->Surface.nearest(point, Deepest * this->Model.diameter);
    if (nearest >= 0)
    {
      const Eigen::Vector3f way = surface.points[nearest] - point;
      const float depth = way.norm();
      inside += depth > least && way.dot(surface.normals[nearest]) > StraightBelow * depth ? 1 : 0;
    }
  }
  return static_cast<double>(inside) / std::max<std::size_t>(this->Model.verificationPoints.size(), 1);
}

bool BodyOverlap::cut(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
{
  const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
  if ((a * middle - b * middle).norm() > this->Model.diameter)
  {
    return false;
  }
  const Eigen::Isometry3f T = (b.inverse() * a).cast<float>();
  return this->shareInside(T) >= LeastShare || this->shareInside(T.inverse()) >= LeastShare;
}
}
