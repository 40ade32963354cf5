// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Scene.h"

#include "base/Error.h"
#include "base/Frames.h"

namespace meam
{
Scene sceneInOwnFrame(const PreciseCloud& edges, FramedPoints surface, const Sensor& sensor, int threads)
{
  Scene scene;
  scene.frame = surface.points.empty() ? principalFrame(edges.points) : surface.frame;
  scene.edges = inFrame(edges, scene.frame, threads);
  scene.surface = std::move(surface.points);
  scene.sensor = { sensor.perspective, scene.frame * sensor.position, scene.frame.linear() * sensor.direction };
  return scene;
}

Poses inFrameOf(const Scene& scene, const Poses& poses, const Symmetries& symmetries)
{
  Poses result;
  for (const Pose& pose : poses)
  {
    if (!pose.T_scene_model.matrix().allFinite())
    {
      throw Error("Pose " + std::to_string(result.size()) + " has numbers that are not finite.");
    }
    result.push_back(moved(pose, scene.frame));
    Eigen::Isometry3d& T = result.back().T_scene_model;
    T = nearestEqual(T, Eigen::Isometry3d::Identity(), symmetries);
  }
  return result;
}
}
