// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/PredictedVisibility.h"
#include "model/TrainedModel.h"
#include "scene/Scene.h"

namespace meam
{
/// What the sensor measured at a pose of a part that is so thin that what it lies on is as good as where the part
/// should be: a face of its own is higher than what lies beside it, and than the bin's floor.
class SheetSurface
{
public:
  /// `tolerance`: mm, behind and before the pose; what was measured beyond is another surface. Looks at every
  /// `stride`-th point.
  SheetSurface(const Scene& scene, const TrainedModel& model, const Eigen::Isometry3d& T_scene_model,
    const PredictedVisibility::Visible& visible, float tolerance, std::size_t stride);

  /// A point beside the pose, moved along the line of sight as far as the plane through what was measured at the pose
  /// lies behind it.
  Eigen::Vector3f onMeasured(const Eigen::Vector3f& point) const;

  /// Whether what was measured at a point is the bin's floor or a wall: less than half a thickness before it.
  static bool isOfBin(const Eigen::Vector3f& point, const Scene& scene, const TrainedModel& model);

private:
  /// One, and a place across the line of sight, mm.
  Eigen::Vector3d placeOf(const Eigen::Vector3f& point) const;

  Eigen::Vector3f Middle, Towards, Across;
  Eigen::Vector3d Behind = Eigen::Vector3d::Zero(); ///< mm, and how it grows with the place
};
}
