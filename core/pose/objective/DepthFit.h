// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "scene/Scene.h"

namespace meam
{
/// How well the depth that the sensor measured point by point fits a part at one pose against another that covers
/// nearly the same: low steps and small holes, which may be all that tells two rotations of a nearly symmetric part
/// apart, are lost in the cells of the scene's depth map. Calls may run in parallel.
class DepthFit
{
public:
  /// Where tells() says so. Keeps references to both.
  DepthFit(const Scene& scene, const TrainedModel& model);

  /// Whether depth tells anything: the scan's noise is known, and the surface of both.
  static bool tells(const Scene& scene, const TrainedModel& model);

  /// The part as the sensor should see it, were nothing before it: in cells of the fine depth map.
  struct Rendered
  {
    struct Cell
    {
      float depth = 0.0f;  ///< mm, along the line of sight, mean
      float cosine = 0.0f; ///< of the surface towards the sensor, mean
      int count = 0;       ///< of the points that they are the means of; 0: the part is not there
    };
    int left = 0, top = 0, width = 0, height = 0; ///< of the cells below, in the map
    std::vector<Cell> cells;

    const Cell& at(int column, int row) const;
  };
  Rendered render(const Eigen::Isometry3d& T_scene_model) const;

  /// What the scan says for `a` against `b`, nats: of each cell that either of them covers the log likelihood of the
  /// depth there, at most 3, for as many cells as are independent, in [-6, 6] altogether.
  double logOdds(const Rendered& a, const Rendered& b) const;

private:
  double lossOf(const Rendered::Cell& cell, float behind, float behindOther) const;

  const Scene& InScene;
  const TrainedModel& Model;
  float Deviation; ///< mm, of a measured point off the surface that it is of
  float Near;      ///< mm, so near to the part a surface is the part's
};
}
