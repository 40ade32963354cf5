// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/EdgeCoverage.h"

#include "base/Parallel.h"
#include "base/sequences/Sequences.h"
#include "pose/verification/PoseVerification.h"

#include <algorithm>
#include <cmath>

namespace meam
{
void scoreByEdgeCoverage(
  Poses& poses, const Scene& scene, const TrainedModel& model, float tolerance, int threads, const Progress& progress)
{
  const auto viewEdges =
    ofIndices<Points>(model.viewDirections.size(), [&](int v) { return model.edgesOfView(v).points; });
  parallelForEach(static_cast<int>(poses.size()), threads, progress,
    [&](int i)
    {
      Pose& pose = poses[i];
      pose.viewId = viewOf(pose, scene, model);
      const Points& edges = viewEdges[pose.viewId];
      const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
      const auto fitted = std::count_if(edges.begin(), edges.end(),
        [&](const Eigen::Vector3f& point) { return scene.edgeGrid().nearest(T * point, tolerance) >= 0; });
      pose.score = edges.empty() ? 0.0 : static_cast<double>(fitted) / edges.size();
      pose.placeProbability = pose.probability = pose.score;
      pose.evidence = std::log(pose.score / (1.0 - pose.score)); // infinite when all or nothing fits
      pose.visibleFraction = pose.score;
    });
}
}
