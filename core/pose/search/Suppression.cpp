// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/Suppression.h"

#include "pose/verification/PoseEvidence.h"

namespace meam
{
ExplainedPoints explainedPoints(
  const Scene& scene, const TrainedModel& ofPart, const Eigen::Isometry3d& T_scene_model, double tolerance)
{
  const DistanceField& part = haveSurfaces(scene, ofPart) ? ofPart.surfaceDistance : ofPart.edgeDistance;
  const PointGrid& measured = scene.hasSurface() ? scene.surface : scene.edgeGrid();
  const Eigen::Isometry3f toModel = T_scene_model.inverse().cast<float>();
  ExplainedPoints explained;
  measured.forEachBlock(T_scene_model.cast<float>() * part.middle(), part.radius() + tolerance,
    [&](int begin, int count)
    {
      float distances[SoABlock];
      part.at(toModel, measured.sorted(), begin, count, distances);
      for (int k = 0; k < count; ++k)
      {
        if (distances[k] < tolerance)
        {
          explained.push_back(begin + k);
        }
      }
    });
  return explained;
}

std::size_t sharedPoints(const ExplainedPoints& a, const ExplainedPoints& b)
{
  std::size_t shared = 0;
  auto other = b.begin();
  for (const int point : a)
  {
    while (other != b.end() && *other < point)
    {
      ++other;
    }
    shared += other != b.end() && *other == point ? 1 : 0;
  }
  return shared;
}
}
