// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PointColumns.h"
#include "model/TrainedModel.h"
#include "scene/Sensor.h"

#include <limits>

namespace meam
{
/// Which points of a part the sensor should see at a pose, if nothing else were in the way. Calls may run in parallel.
class PartView
{
public:
  /// Keeps a reference to the model.
  explicit PartView(const TrainedModel& model);

  /// Middle of the part's surface, model frame: the notch or lug that fixes a round part's turn hardly moves it.
  const Eigen::Vector3f& middle() const { return this->Middle; }

  /// The appearance model whose viewpoint is nearest to the sensor at a pose.
  int view(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const;

  /// Indices of edge points and of thinned surface points that face the sensor and are not behind
  /// other points of the part. The direction to the sensor is taken to within 0.8 degrees.
  struct Visible
  {
    /// That direction, in the model's frame; not a number before any was asked about.
    Eigen::Vector3f from = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
    std::vector<int> edges;
    std::vector<int> surface;
  };
  Visible visible(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const;
  /// Makes `visible`, of this very part, what it is at that pose; at once when it is seen from the same direction.
  void update(Visible& visible, const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const;

  /// Calls visit(index) for every `stride`-th of the surface points that are judged and face the sensor, also for those
  /// behind other points of the part.
  template <typename Visitor>
  void forEachFacing(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor, int stride, Visitor&& visit) const
  {
    const Eigen::Isometry3f T = T_scene_model.cast<float>();
    const Eigen::Vector3f towards = T.linear().transpose() * sensor.towards(T * this->Middle);
    for (std::size_t k = 0; k < this->Judged.size(); k += stride)
    {
      if (this->Model.surface.normals[this->Judged[k]].dot(towards) > 0.0f)
      {
        visit(this->Judged[k]);
      }
    }
  }

  /// The edge appearance model of a view.
  PointCloud viewEdges(int view) const;

private:
  const TrainedModel& Model;
  Eigen::Vector3f Middle;
  std::vector<int> Judged; ///< surface points that evidence is taken from
  // Relative to the middle:
  PointColumns Surface;
  PointColumns Edges;
  PointColumns JudgedPoints;
  PointColumns JudgedNormals;
};
}
