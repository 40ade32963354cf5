// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointGrid.h"
#include "scene/DepthMap.h"
#include "scene/EdgeIndex.h"
#include "pose/verification/PredictedVisibility.h"
#include "scene/Scene.h"

namespace meam
{
/// A scene and a part with what judging and refining poses looks up in them: built once for all steps. Keeps references
/// to both; calls may run in parallel.
struct SceneIndex
{
  /// Throws Error when the scene has no edges, edges without tangents, or weights beyond [0, 1], and when no point of the
  /// surface lies before the sensor. `threads` 0: one for each processor.
  SceneIndex(const TrainedModel& model, const Scene& scene, int threads = 0);

  /// Whether the scene and the model have surfaces, so that poses are judged by them; otherwise by edges alone.
  bool hasSurfaces() const { return !this->scene.surface.empty() && !this->model.surface.empty(); }
  /// The appearance model of a pose in the frame of the scene's points: its own, when it names one, otherwise the nearest
  /// to the sensor.
  int viewOf(const Pose& pose) const;

  const TrainedModel& model;
  const Scene& scene;
  PredictedVisibility view;
  EdgeIndex lines;        ///< of the scene's edge points
  const PointGrid& edges; ///< of these
  DepthMap depth;         ///< of its surface
  PointGrid surface;      ///< of depth.means()

  SceneIndex(const SceneIndex&) = delete; // edges are those of lines
  void operator=(const SceneIndex&) = delete;
};
}
