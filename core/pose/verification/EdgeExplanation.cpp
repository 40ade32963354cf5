// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/EdgeExplanation.h"

#include "base/Parallel.h"

#include <algorithm>

namespace meam
{
std::vector<int> explainEdges(const LocalCloud& edges, const Poses& poses, const TrainedModel& model, double least,
  const FitLengths& lengths, int threads)
{
  const float near = static_cast<float>(std::max(lengths.explained * model.diameter, least));
  std::vector<Eigen::Isometry3f> toPart;
  for (const Pose& pose : poses)
  {
    toPart.push_back((edges.T_local_scene * pose.T_scene_model).inverse().cast<float>());
  }
  const Points& points = edges.cloud.points;
  std::vector<int> explained(points.size(), -1);
  parallelFor(static_cast<int>(points.size()), threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        const auto first = std::find_if(toPart.begin(), toPart.end(),
          [&](const Eigen::Isometry3f& T) { return model.edgeDistance.at(T * points[i]) <= near; });
        explained[i] = first == toPart.end() ? -1 : static_cast<int>(first - toPart.begin());
      }
    });
  return explained;
}
}
