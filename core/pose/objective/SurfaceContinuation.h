// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "scene/Scene.h"

namespace meam
{
/// What the scan still holds beside a pose: measured surface that goes on smoothly, as one face, from the surface that
/// the pose explains, and is not the part. Another body that touches the part goes on with a crease or a jump, and says
/// nothing; what a sheet lies on is so near that an edge of the scan tells it, too (clutter on a smooth segment: Aldoma
/// et al., A global hypotheses verification method for 3D object recognition, ECCV 2012). Calls may run in parallel.
class SurfaceContinuation
{
public:
  /// Keeps references to both.
  SurfaceContinuation(const Scene& scene, const TrainedModel& model);

  /// Such surface no farther than 12 % of the diameter from where it begins, without the bin's floor and walls: the
  /// means of the depth map's cells.
  Points beyond(const Eigen::Isometry3d& T_scene_model) const;
  /// How much of it lies on none of the parts at other poses, T_model_scene, in patches.
  double unexplained(const Points& beyond, const std::vector<Eigen::Isometry3f>& others) const;

private:
  bool isOn(const Eigen::Vector3f& point, const Eigen::Isometry3f& T_model_scene) const
  {
    return this->Model.surfaceDistance.at(T_model_scene * point) < this->Tolerance;
  }
  bool isOfBin(const Eigen::Vector3f& point) const;
  bool isAtEdge(const Eigen::Vector3f& point) const;
  bool isSmooth(int from, int to) const;

  const Scene& InScene;
  const TrainedModel& Model;
  float Tolerance; ///< mm
  float Noise;     ///< mm, of a cell's mean
  bool IsSheet;
  int Reach;             ///< cells
  double PatchesOfPoint; ///< what one of these points counts
};
}
