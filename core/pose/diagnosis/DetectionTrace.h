// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/MEAMPoseEstimation.h"

#include <optional>
#include <vector>

namespace meam
{
/// Poses that are of one place: up to the part's exact symmetries, as near and as little turned.
struct PlaceTolerance
{
  double distance; ///< mm, of the part's middle
  double angle;    ///< degrees
};

/// How far a pose is from another one of a part, up to its exact symmetries.
struct PoseOffset
{
  double distance; ///< mm, of the part's middle
  double angle;    ///< degrees

  bool within(const PlaceTolerance& tolerance) const
  {
    return this->distance < tolerance.distance && this->angle < tolerance.angle;
  }
};
PoseOffset offsetBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const TrainedModel& model);
/// The same as if a nearly round part were round, and an approximate symmetry an exact one.
PoseOffset offsetUpToNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const TrainedModel& model);

/// Indices of the poses at a place.
std::vector<int> posesAt(const Poses& poses, const Eigen::Isometry3d& T_scene_model, const PlaceTolerance& tolerance,
  const TrainedModel& model);

/// What every stage of detection returned, local frame.
class DetectionTrace
{
public:
  struct Stage
  {
    PoseStage stage;
    Poses poses;
  };

  /// Detects the parts of a scene, all of them: where a few poses are wanted, a search that ends with these would say
  /// nothing of the others. Keeps references.
  DetectionTrace(
    const Scene& scene, const TrainedModel& model, const DetectionSettings& settings, const Progress& progress = {});

  const std::vector<Stage>& stages() const { return this->Stages; }
  const Poses& posesOf(PoseStage stage) const;
  /// What is wanted of that.
  const Poses& ranked() const { return this->Stages.back().poses; }
  /// The scan's rates, by all candidates; none with the paper's verification.
  const std::optional<EvidenceRates>& rates() const { return this->Report.rates; }
  /// What comes out without a limit on the number of poses and their probability: ranked() are of them.
  const Poses& unlimited() const { return this->Unlimited; }
  /// All that may be refined, of different instances. Found when it is asked for.
  const Poses& allAlternatives();

private:
  const Scene& InScene;
  const TrainedModel& Model;
  const DetectionSettings& Settings;
  std::vector<Stage> Stages;
  DetectionReport Report;
  Poses Unlimited;
  std::optional<Poses> AllAlternatives;
};
}
