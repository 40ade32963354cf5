// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/PoseClusters.h"

#include "pose/PoseTolerances.h"

#include <algorithm>

namespace meam
{
std::vector<int> firstOfClusters(const Poses& poses, const Symmetries& same, const TrainedModel& model, double distance,
  int posesPerInstance, const Progress& progress)
{
  std::vector<int> selected;
  std::vector<Eigen::Vector3d> middles; // of the part, of those selected
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    report(progress, static_cast<double>(k) / static_cast<double>(poses.size()));
    const Eigen::Isometry3d& T = poses[k].T_scene_model;
    const Eigen::Vector3d middle = T * model.visibility->middle().cast<double>();
    int ofInstance = 0;
    bool isKnown = false;
    for (std::size_t i = 0; i < selected.size() && !isKnown; ++i)
    {
      if ((middle - middles[i]).norm() < distance)
      {
        ++ofInstance;
        isKnown = turnBetween(T, poses[selected[i]].T_scene_model, same) < SamePoseAngle;
      }
    }
    if (!isKnown && ofInstance < posesPerInstance)
    {
      selected.push_back(static_cast<int>(k));
      middles.push_back(middle);
    }
  }
  return selected;
}
}
