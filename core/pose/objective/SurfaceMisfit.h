// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "scene/Scene.h"

namespace meam
{
/// How far the measured surface lies off the part where a pose explains it, beside how far off its true shape this scan
/// has any surface: of a part that looks alike more than the scan explains. Noise that patches of surface average out
/// does not count. Calls may run in parallel.
class SurfaceMisfit
{
public:
  /// Keeps references to both.
  SurfaceMisfit(const Scene& scene, const TrainedModel& model);

  /// Root mean square over patches of how far the surface lies off the part, its median in each, mm; 0 where too little
  /// of it is seen. What lies on another surface of the part does not count.
  double at(const Eigen::Isometry3d& T_scene_model) const;
  /// What to expect of a right pose, mm: the scan's own unevenness, and how well a pose is found.
  double expected() const { return this->Expected; }
  /// How much of what contradicts a pose the scan itself may make, [0, 1): next to nothing where it is even.
  double excused() const { return this->Excused; }

private:
  const Scene& InScene;
  const TrainedModel& Model;
  double Expected; ///< mm
  double Excused;
};

/// How uneven flat surface is in a scan, mm, root mean square over patches of this side (mm) in blocks of three times
/// three: the flattest tell. Where nothing is flat it is the more.
double scanUnevenness(const Points& surface, const Eigen::Vector3d& towards, double patch);
}
