// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"
#include "model/TrainedModel.h"
#include "scene/Sensor.h"

#include <memory>
#include <mutex>
#include <unordered_map>

namespace meam
{
/// Which points of a part the sensor should see at a pose, if nothing else were in the way. Calls may run in parallel.
class PredictedVisibility
{
public:
  /// Keeps a reference to the model.
  explicit PredictedVisibility(const TrainedModel& model);

  /// Middle of the part's surface, model frame: the notch or lug that fixes a round part's turn hardly moves it.
  const Eigen::Vector3f& middle() const { return this->Middle; }

  /// The appearance model whose viewpoint is nearest to the sensor at a pose.
  int view(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const;

  /// Unit vector towards the sensor from the middle of a part at a pose, in the model's frame.
  Eigen::Vector3f towards(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const;

  /// Indices of edge points and of judged surface points that face the sensor and are not behind other points of the
  /// part. The direction to the sensor is taken to within 0.8 degrees.
  struct Visible
  {
    Eigen::Vector3f from; ///< that direction, in the model's frame
    std::vector<int> edges;
    std::vector<int> surface;
  };
  /// Found once for a direction, as long as it is remembered.
  std::shared_ptr<const Visible> visible(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const;

  /// The edge appearance model of a view.
  PointCloud viewEdges(int view) const;

private:
  Visible visibleFrom(const Eigen::Vector3f& towards) const;

  const TrainedModel& Model;
  Eigen::Vector3f Middle;
  // Relative to the middle:
  SoAPoints Surface;
  SoAPoints Edges;
  SoAOrientedPoints Judged;

  mutable std::mutex Mutex;
  mutable std::unordered_map<int, std::shared_ptr<const Visible>> Known; ///< by direction
};
}
