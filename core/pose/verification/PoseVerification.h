// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Pose.h"
#include "pose/verification/PoseEvidence.h"

namespace meam
{
enum class VerificationMethod
{
  EdgeCoverage,   ///< Section 5.2 of the paper: share of the edge appearance model that fits the scene
  VisibleEvidence ///< edges and surface that should be visible, against what the sensor saw
};

/// Lengths in mm; a length of 0 follows the part's diameter.
struct PoseVerificationSettings
{
  VerificationMethod method = VerificationMethod::VisibleEvidence;
  EvidenceSettings evidence;    ///< of VisibleEvidence
  double tolerance = 0.0;       ///< a model point this near to the scene fits; 0: 3 % of the diameter
  double minimumScore = 0.0;    ///< poses below are dropped
  double minimumProbability = 0.0; ///< of what comes out, poses less likely are dropped
  int posesPerView = 0;         ///< N_pv: best poses kept for each appearance model; 0: no limit
  double clusterDistance = 0.0; ///< poses nearer than this are of one instance; 0: 10 % of the diameter
  double clusterAngle = 15.0;   ///< and those turned less than this (degrees) are the same
  /// Poses kept of one instance. With 1, as for the result, poses that share most of what they match are of one instance,
  /// too, alternatives are decided on the points that tell them apart, a nearly round part is turned to where it fits
  /// best, and each pose settles (settlePose).
  /// With more, as for what will be refined, of those that a near-symmetry, or any turn of a nearly round part, turns into
  /// each other one is kept. When more poses come than may stay, as from detection, each is turned by the near-symmetry
  /// that the scene's edges speak for, every other point judges, and those whose preference is a thousandth of the best's
  /// go, too.
  int posesPerInstance = 2;
  int maximumPoses = 100;       ///< 0: no limit
  int threads = 0;              ///< 0: one for each processor
};

/// The paper's settings (Section 6) in place of the recommended ones.
PoseVerificationSettings paperVerificationSettings();

/// Scores every pose against the scene, keeps the best of each cluster and returns them best first, each turned least of
/// those that the part's symmetries make equal. Without a surface only edges count.
Poses verifyPoses(const Poses& poses, const SceneIndex& index, const PoseVerificationSettings& settings = {},
  const Progress& progress = {});

/// The same in a scene that nothing else is asked about. Throws Error when the scene has no edges.
inline Poses verifyPoses(const Poses& poses, const TrainedModel& model, const Scene& scene, const PoseVerificationSettings& settings = {},
  const Progress& progress = {})
{
  return verifyPoses(poses, SceneIndex(model, scene, settings.threads), settings, progress);
}
}
