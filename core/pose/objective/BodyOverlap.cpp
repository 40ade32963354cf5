// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/BodyOverlap.h"

#include "model/body/BodyInterior.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr double LeastShare = 0.05; // of the surface that lies inside; less may be where the part is bent
constexpr float BoxMargin = 1e-3f;  // of a box's sides: more than rounding

/// Whether an axis of one or the other box, or one across both, has the box and the one that `T` takes it to on either
/// side of a plane (Gottschalk et al. 1996, "OBBTree", Section 5).
bool areBoxesApart(const Eigen::AlignedBox3f& box, const Eigen::Isometry3f& T)
{
  const Eigen::Vector3f half = (1.0f + BoxMargin) * 0.5f * box.sizes();
  const Eigen::Matrix3f R = T.linear();
  const Eigen::Vector3f between = T * box.center() - box.center();
  const auto isApartAlong = [&](const Eigen::Vector3f& axis)
  {
    const float reach = half.dot(axis.cwiseAbs()) + half.dot((R.transpose() * axis).cwiseAbs());
    return std::abs(between.dot(axis)) > reach;
  };
  for (int i = 0; i < 3; ++i)
  {
    if (isApartAlong(Eigen::Vector3f::Unit(i)) || isApartAlong(R.col(i)))
    {
      return true;
    }
    for (int j = 0; j < 3; ++j)
    {
      if (isApartAlong(Eigen::Vector3f::Unit(i).cross(R.col(j))))
      {
        return true;
      }
    }
  }
  return false;
}

/// Whether so much of the surface of a part lies deep in this part, whose frame `T` takes it to.
bool reachesInto(const TrainedModel& model, const Eigen::Isometry3f& T)
{
  const std::vector<int>& points = model.verificationPoints;
  const double enough = std::max(1.0, LeastShare * static_cast<double>(points.size()));
  int count = 0;
  return std::any_of(points.begin(), points.end(),
    [&](int i)
    {
      count += model.interior->isDeep(T * model.surface.points[i]) ? 1 : 0;
      return count >= enough;
    });
}
}

bool bodiesOverlap(const TrainedModel& model, const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  if ((a * middle - b * middle).norm() > model.diameter)
  {
    return false;
  }
  const Eigen::Isometry3f T = (b.inverse() * a).cast<float>();
  return !areBoxesApart(model.interior->box(), T) && (reachesInto(model, T) || reachesInto(model, T.inverse()));
}
}
