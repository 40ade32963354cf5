// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/EdgeExplanation.h"

#include "base/Parallel.h"
#include "pose/PoseTolerances.h"

#include <algorithm>

namespace meam
{
std::vector<int> explainEdges(
  const LocalCloud& edges, const Poses& poses, const TrainedModel& model, double least, int threads)
{
  const float near = static_cast<float>(std::max(ExplainedDistance * model.diameter, least));
  const float reach = model.edgeDistance.outerRadius();
  struct Placed
  {
    Eigen::Isometry3f toPart;
    Eigen::Vector3f middle; ///< of the part, where the edge points are
  };
  std::vector<Placed> placed;
  for (const Pose& pose : poses)
  {
    const Eigen::Isometry3d T = edges.T_local_scene * pose.T_scene_model;
    placed.push_back({ T.inverse().cast<float>(), (T * model.edgeDistance.middle().cast<double>()).cast<float>() });
  }
  const Points& points = edges.cloud.points;
  std::vector<int> explained(points.size(), -1);
  parallelForEach(static_cast<int>(points.size()), threads, {},
    [&](int i)
    {
      const auto first = std::find_if(placed.begin(), placed.end(),
        [&](const Placed& part)
        {
          return (points[i] - part.middle).squaredNorm() <= reach * reach &&
                 model.edgeDistance.at(part.toPart * points[i]) <= near;
        });
      explained[i] = first == placed.end() ? -1 : static_cast<int>(first - placed.begin());
    });
  return explained;
}
}
