// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointGrid.h"
#include "mesh/OccludingContours.h"

#include <memory>
#include <mutex>
#include <unordered_map>

namespace meam
{
struct Sensor;
struct TrainedModel;

/// Which points of a part the sensor should see from a direction, if nothing else were in the way: a depth buffer of
/// its samples, cached by direction. Calls may run in parallel.
class PredictedVisibility
{
public:
  /// Needs no more of the model than its edges, surface, verification points, view directions, diameter and
  /// settings.
  /// Of the directions asked for, the last `cachedDirections` are kept, up to 120 MB of a part: a full bin asks for a
  /// thousand.
  explicit PredictedVisibility(const TrainedModel& model, int cachedDirections = 2000);

  /// Middle of the part's surface, model frame: the notch or lug that fixes a round part's turn hardly moves it.
  const Eigen::Vector3f& middle() const { return this->Middle; }
  /// mm about it: all of the surface lies in this ball.
  float radius() const { return this->Radius; }

  /// The appearance model whose viewpoint is nearest to the sensor at a pose.
  int view(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const;

  /// Unit vector towards the sensor from the middle of a part at a pose, in the model's frame.
  Eigen::Vector3f towards(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const;

  /// What faces the sensor and is not behind other points of the part, in the model's frame.
  struct Visible
  {
    Eigen::Vector3f from;      ///< the direction to the sensor, rounded to a step
    SoAOrientedPoints edges;   ///< with tangents: those of sharp edges, then of the contours that this direction makes
    std::vector<int> surface;  ///< indices of verification points
    std::vector<char> isInner; ///< of these, whether they lie further than the border inside the part's outline,
    std::vector<float> falls;  ///< and by how much the part itself falls off in the next cell, mm; 0: less than `drop`
    /// Beside the part's outline, outside, at the depth of its border: points a cell further off than the border, a
    /// cell apart, mm.
    Points outside;

    /// Of the edges; made when it is first asked for, as of few directions it is. Calls may run in parallel.
    const PointGrid& edgeGrid() const;
    // What edgeGrid() makes it of, and keeps; ask it, not these.
    float cellOfGrid; ///< mm
    mutable std::shared_ptr<const PointGrid> grid;
  };
  /// mm, of the depth buffer.
  double cellSize() const;
  /// `pitch`: mm between neighbouring points of the scan (DepthMap::pitch); 0: not known, and very fine.
  std::shared_ptr<const Visible> visible(
    const Eigen::Isometry3d& T_scene_model, const Sensor& sensor, double pitch = 0.0) const;

  /// Indices of all surface samples in sight, not of the verification points alone, that face the sensor with this
  /// cosine at least. Not cached.
  std::vector<int> samplesInSight(
    const Eigen::Isometry3d& T_scene_model, const Sensor& sensor, double leastCosine) const;

private:
  using Cache = std::unordered_map<int, std::shared_ptr<const Visible>>; ///< by direction and point distance

  Visible visibleFrom(const Eigen::Vector3f& towards, double pitch) const;
  /// Puts it among the recent ones, unless it is there. The mutex is locked.
  std::shared_ptr<const Visible> keep(int key, std::shared_ptr<const Visible> visible) const;

  int CachedDirections;
  double Diameter;
  Points ViewDirections;
  Eigen::Vector3f Middle;
  float Radius = 0.0f;
  float HalfCells; ///< of the depth buffer, from its middle to its border
  // Relative to the middle:
  SoAOrientedPoints Surface;
  SoAOrientedPoints SharpEdges; ///< with tangents
  OccludingContours Contours;   ///< in the model's frame
  SoAOrientedPoints VerificationPoints;
  std::vector<int> VerificationIndices; ///< of these in the model's surface

  mutable std::mutex Mutex;
  // Two generations instead of a list of the least recently used: when Recent is full it takes the place of Older.
  mutable Cache Recent, Older;
};
}
