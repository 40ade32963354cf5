// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/VoteScore.h"

#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "base/sequences/Sequences.h"
#include "pose/PoseTolerances.h"
#include "pose/verification/PoseVerification.h"

#include <algorithm>

namespace meam
{
void scoreByVotes(Poses& poses, const Scene& scene, const TrainedModel& model, int threads)
{
  const double distance = SamePoseDistance * model.diameter;
  const auto middles = mapped<Eigen::Vector3f>(poses,
    [&](const Pose& pose) -> Eigen::Vector3f
    { return Eigen::Vector3f((pose.T_scene_model * model.visibility->middle().cast<double>()).cast<float>()); });
  const PointGrid grid(middles, distance);
  std::vector<int> sums(poses.size(), 0);
  parallelForEach(static_cast<int>(poses.size()), threads, {},
    [&](int i)
    {
      grid.forEachWithin(middles[i], distance,
        [&](int other, float)
        {
          const bool agrees = rotationError(poses[i].T_scene_model, poses[other].T_scene_model) < SamePoseAngle;
          sums[i] += agrees ? poses[other].votes : 0;
        });
    });
  const int most = sums.empty() ? 0 : *std::max_element(sums.begin(), sums.end());
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    poses[i].viewId = viewOf(poses[i], scene, model);
    poses[i].votes = sums[i];
    poses[i].score = most > 0 ? static_cast<double>(sums[i]) / most : 0.0;
    poses[i].evidence = sums[i]; // orders the poses of one scene; no odds
  }
}
}
