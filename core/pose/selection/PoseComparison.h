// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"
#include "model/TrainedModel.h"
#include "scene/Scene.h"

namespace meam
{
struct PoseComparisonSettings
{
  bool freeSpace = true; ///< surface that the sensor saw past speaks against a pose; else it says nothing
  /// Poses are compared on what one of them alone predicts; else each on all that it predicts.
  bool sameVisibility = true;
};

/// Decides between poses of one instance by what the sensor saw: every measured point and every scene edge near the
/// instance speaks for the pose that explains it. Points that both explain, or none, do not count, so poses that
/// differ by a near-symmetry are decided by the notch or hole that breaks it. Calls may run in parallel.
class PoseComparison
{
public:
  /// Keeps references to both.
  PoseComparison(const Scene& scene, const TrainedModel& model, const PoseComparisonSettings& settings = {});

  /// What of the part the sensor should see at a pose and may not be there, in the part's frame.
  struct Prediction
  {
    SoAPoints passed; ///< points of its surface that the sensor saw past
    SoAPoints edges;  ///< edge points on a surface that it saw
  };
  /// How many points of the measured surface a pose explains.
  struct Fit
  {
    double byDistance = 0.0; ///< 1 for each on the part, falling evenly to 0 where it is unexplained
    double lying = 0.0;      ///< 1 up to half a cell of the distance field, then falling evenly to 0 there, too
  };
  /// A pose, what it explains and what it predicts.
  struct Contender
  {
    Eigen::Isometry3d T_scene_model;
    Fit explained;
    std::shared_ptr<const PredictedVisibility::Visible> visible; ///< none: not asked yet
    Prediction predicted;
  };
  Contender contender(const Eigen::Isometry3d& T_scene_model) const;

  /// Greater than 0 when the scene speaks for `a`, less for `b`: points that one explains and the other does not,
  /// and surface and edges that one of them alone predicts and that are not there.
  double advantage(const Contender& a, const Contender& b) const;
  /// The same of a pose that is asked about once: exact from `enough` on. Below it is found at less cost, and what
  /// comes back is below `enough`, but may be more than it is.
  double advantage(const Eigen::Isometry3d& T_scene_model, const Contender& other, double enough) const;
  /// The same for a rotation that hardly moves the surface, by `lying`: the field is up to half a cell off, differently
  /// on each face, which would decide between rotations that fit equally well.
  double advantageOfTurn(const Eigen::Isometry3d& T_scene_model, const Contender& other, double enough) const;

private:
  Fit explained(const Eigen::Isometry3d& T_scene_model) const;
  double advantageOfOne(
    const Eigen::Isometry3d& T_scene_model, const Contender& other, double enough, double Fit::*kind) const;
  /// Sets `visible` and `predicted`.
  void predict(Contender& one) const;
  /// By the measured surface, and by what contradicts the other; `one` need not know what it predicts.
  double advantageElsewhere(const Contender& one, const Contender& other, double Fit::*kind) const;
  /// By scene edges that one of them alone explains. Where `one` does not know what it predicts all of its edges count
  /// as visible: it is no less.
  double advantageByEdges(const Contender& one, const Contender& other) const;
  /// What `one` predicts and the other does not, and is not there: surface, and edges on surface.
  double contradicted(const Contender& one, const Contender& other) const;

  const Scene& InScene;
  const TrainedModel& Model;
  PoseComparisonSettings Settings;
  float Explained;   ///< mm
  float Unexplained; ///< mm
};
}
