// SPDX-License-Identifier: BSD-3-Clause
#include "pose/SceneIndex.h"

#include "base/Error.h"
#include "base/Parallel.h"

#include <algorithm>

namespace meam
{
namespace
{
// Shares of the diameter.
constexpr double EdgeCellShare = 0.08;
constexpr double DepthCellShare = 0.02;
constexpr double SurfaceCellShare = 0.05;

/// The scene, when its edges can be looked up.
const Scene& checked(const Scene& scene)
{
  requirePoints(scene.edges.points, "The scene's edge cloud");
  if (scene.edges.tangents.size() != scene.edges.size())
  {
    throw Error("The scene's edge points have no tangents: estimate them before poses are judged.");
  }
  const std::vector<float>& weights = scene.edges.weights;
  if (!weights.empty() && weights.size() != scene.edges.size())
  {
    throw Error("The scene has " + std::to_string(scene.edges.size()) + " edge points, but " +
      std::to_string(weights.size()) + " weights of edge points.");
  }
  const auto isWeight = [](float weight) { return weight >= 0.0f && weight <= 1.0f; };
  const auto wrong = std::find_if_not(weights.begin(), weights.end(), isWeight);
  if (wrong != weights.end())
  {
    throw Error("An edge point of the scene has the Weight " + std::to_string(*wrong) +
      ": weights go from 0 to 1. Rename the array, when it is something else.");
  }
  return scene;
}
}

SceneIndex::SceneIndex(const TrainedModel& trained, const Scene& seen, int threads)
  : model(trained)
  , scene(checked(seen))
  , view(trained)
  , edges(this->lines.grid())
  , depth(seen.surface, seen.sensor, DepthCellShare * trained.diameter, threads)
{
  inParallel(threads,
    { [&] { this->surface = PointGrid(this->depth.means(), SurfaceCellShare * trained.diameter); },
      [&] { this->lines = EdgeIndex(seen.edges, EdgeCellShare * trained.diameter); } });
  if (!seen.surface.empty() && this->depth.means().empty())
  {
    throw Error("The scene has " + std::to_string(seen.surface.size()) +
      " surface points, but the sensor looks away from all of them: turn the view direction round, or move the sensor "
      "position (a perspective sensor sees what lies before it).");
  }
}

int SceneIndex::viewOf(const Pose& pose) const
{
  const bool isNamed = pose.viewId >= 0 && pose.viewId < static_cast<int>(this->model.viewDirections.size());
  return isNamed ? pose.viewId : this->view.view(pose.T_scene_model, this->scene.sensor);
}
}
