// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/BodyOverlap.h"

#include "model/BodyInterior.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr double LeastShare = 0.05; // of the surface that lies inside; less may be where the part is bent

/// Whether so much of the surface of a part lies deep in this part, whose frame `T` takes it to.
bool reachesInto(const TrainedModel& model, const Eigen::Isometry3f& T)
{
  const std::vector<int>& points = model.verificationPoints;
  const auto count = std::count_if(
    points.begin(), points.end(), [&](int i) { return model.interior->isDeep(T * model.surface.points[i]); });
  return count > 0 && static_cast<double>(count) >= LeastShare * static_cast<double>(points.size());
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
  return reachesInto(model, T) || reachesInto(model, T.inverse());
}
}
