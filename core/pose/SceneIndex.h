// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PointGrid.h"
#include "pose/DepthMap.h"
#include "pose/EdgeLines.h"
#include "pose/PartView.h"
#include "pose/Scene.h"

namespace meam
{
/// A scene and a part with what judging and refining poses looks up in them: built once for all steps. Keeps references
/// to both; calls may run in parallel.
struct SceneIndex
{
  /// Throws Error when the scene has no edges, edges without tangents, or weights beyond [0, 1].
  /// `threads` 0: one for each processor.
  SceneIndex(const TrainedModel& model, const Scene& scene, int threads = 0);

  const TrainedModel& model;
  const Scene& scene;
  PartView view;
  EdgeLines lines;        ///< of the scene's edge points
  const PointGrid& edges; ///< of these
  DepthMap depth;         ///< of its surface
  PointGrid surface;      ///< of depth.means()

  SceneIndex(const SceneIndex&) = delete; // edges are those of lines
  void operator=(const SceneIndex&) = delete;
};
}
