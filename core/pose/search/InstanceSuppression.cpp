// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/InstanceSuppression.h"

#include "base/Parallel.h"
#include "pose/PoseTolerances.h"

#include <optional>

namespace meam
{
namespace
{
constexpr double SharedWithin = 0.5; // of the diameter: middles farther apart are of two instances all the same
constexpr double NearlyEqual = 3.0;  // poses whose evidence (log odds) differs by less are compared point by point
}

InstanceClaims::InstanceClaims(const Scene& scene, const TrainedModel& model, double distance)
  : InScene(scene)
  , Model(model)
  , Distance(distance)
{
}

InstanceClaims::Claim InstanceClaims::of(const Eigen::Isometry3d& T_scene_model) const
{
  const TrainedModel& model = this->Model;
  return { T_scene_model * model.visibility->middle().cast<double>(),
    explainedPoints(this->InScene, model, T_scene_model, UnexplainedDistance * model.diameter) };
}

bool InstanceClaims::areOne(const Claim& a, const Claim& b) const
{
  const double apart = (a.middle - b.middle).norm();
  return apart < this->Distance ||
         (apart < SharedWithin * this->Model.diameter &&
           sharedPoints(a.points, b.points) > SharedByOne * std::min(a.points.size(), b.points.size()));
}

std::vector<int> bestOfInstances(const Poses& poses, const InstanceClaims& claims, const PoseComparison& comparison,
  bool compares, int threads, const Progress& progress)
{
  const int count = static_cast<int>(poses.size());
  std::vector<InstanceClaims::Claim> ofPoses(count);
  parallelForEach(
    count, threads, subProgress(progress, 0.0, 0.5), [&](int k) { ofPoses[k] = claims.of(poses[k].T_scene_model); });
  std::vector<std::optional<PoseComparison::Contender>> contenders(count); // as far as they are asked for
  const auto contender = [&](int k) -> const PoseComparison::Contender&
  {
    if (!contenders[k])
    {
      contenders[k] = comparison.contender(poses[k].T_scene_model);
    }
    return *contenders[k];
  };
  const double equal = compares ? NearlyEqual : 0.0;
  const auto beats = [&](int k, int other)
  {
    report(progress, 0.5 + 0.5 * k / count);
    return poses[k].evidence > poses[other].evidence - equal &&
           comparison.advantage(contender(k), contender(other)) > 0.0;
  };
  return suppress(
    count, [&](int k, int other) { return claims.areOne(ofPoses[k], ofPoses[other]); }, beats);
}
}
