// SPDX-License-Identifier: BSD-3-Clause
#include "pose/SceneIndex.h"

#include "Error.h"

namespace meam
{
namespace
{
// Shares of the diameter.
constexpr double EdgeCellShare = 0.08;
constexpr double DepthCellShare = 0.02;
constexpr double SurfaceCellShare = 0.05;

const Scene& withTangents(const Scene& scene)
{
  requirePoints(scene.edges.points, "The scene's edge cloud");
  if (scene.edges.tangents.size() != scene.edges.size())
  {
    throw Error("The scene's edge points have no tangents: estimate them before poses are judged.");
  }
  return scene;
}

/// A direction that moves with the points.
Eigen::Vector3f firstAxis(const Points& points)
{
  return principalFrame(points).linear().row(0).transpose().cast<float>();
}
}

SceneIndex::SceneIndex(const TrainedModel& trained, const Scene& seen, int threads)
  : model(trained)
  , scene(withTangents(seen))
  , view(trained)
  , edges(seen.edges.points, EdgeCellShare * trained.diameter)
  , lines(seen.edges, this->edges)
  , depth(seen.surface, seen.sensor, DepthCellShare * trained.diameter, firstAxis(seen.surface), threads)
  , surface(this->depth.means(), SurfaceCellShare * trained.diameter)
{
}
}
