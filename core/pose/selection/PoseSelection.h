// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Pose.h"
#include "pose/refinement/FinalAlignment.h"
#include "pose/refinement/PoseRefinement.h"
#include "pose/selection/EvidenceAscent.h"
#include "pose/selection/InstanceChoice.h"
#include "pose/selection/PoseClusters.h"
#include "pose/selection/PoseComparison.h"
#include "pose/selection/RefinementRestarts.h"
#include "pose/selection/RotationDecision.h"
#include "pose/verification/PoseEvidence.h"
#include "pose/verification/RotationSearch.h"

namespace meam
{
enum class SelectionMethod
{
  Clusters,     ///< the best of each cluster, as in the paper
  Alternatives, ///< some of each instance, to be refined: what an approximate symmetry makes equal is one
  Instances     ///< one of each instance: compared, turned where another rotation is right, aligned, moved where the
                ///< scan contradicts it, and scored once more
};

struct PoseSelectionSettings
{
  SelectionMethod method = SelectionMethod::Instances;
  PoseClustersSettings clusters;   ///< posesPerInstance is that of Alternatives; of Clusters it is 1
  int alternatives = 4;            ///< of an instance (Alternatives)
  double leastScore = 0.05;        ///< Alternatives: times the score of the best; less is not worth refining
  int maximumPoses = 0;            ///< of all the best; 0: no limit, or of Alternatives
  int leastRefined = 60;           ///< so many are worth refining, and all that are likelier than this where these
  double worthRefining = 3e-7;     ///< are more: probability, of poses that are not refined yet
  double minimumProbability = 0.0; ///< of what comes out, poses less likely are dropped
  // Instances
  bool restartsRefinement = true; ///< from rotations about the pose
  bool searchesRotation = true;   ///< about the axis of a nearly round part
  bool decidesRotation = true;    ///< between near-symmetries
  bool ascends = true;            ///< where the scan contradicts an aligned pose
  bool dropsShared = true;        ///< poses whose surface better ones have
  InstanceChoiceSettings instances;
  EvidenceSettings evidence; ///< that poses are scored by once more
  PoseComparisonSettings comparison;
  RefinementRestartsSettings restarts;
  RotationSearchSettings rotation;
  PoseRefinementSettings rotated = afterRotation(); ///< of another rotation, which is nearly right
  double rotatedDistance = 0.04;                    ///< of the diameter, its correspondences at the start
  RotationDecisionSettings decision;
  int rateStride = 2; ///< of the points that tell the scan's rates of edges one of so many
  FinalAlignmentSettings alignment;
  EvidenceAscentSettings ascent; ///< of an aligned pose that the scan contradicts
  int threads = 0;               ///< 0: one for each processor

  static PoseRefinementSettings afterRotation()
  {
    PoseRefinementSettings settings;
    settings.iterations = 6;
    settings.threads = 1; // poses are worked on in parallel
    return settings;
  }
};

/// The paper's settings (Section 6) in place of the recommended ones.
PoseSelectionSettings paperSelectionSettings();
/// Those before refinement of the methods that rank poses by their votes.
PoseSelectionSettings votesSelectionSettings();
/// The recommended ones before refinement.
PoseSelectionSettings candidateSelectionSettings();

/// Of scored poses, best first (verifyPoses), those that stay, best first, in the local frame.
///
/// Instances: poses that share most of what they match, or whose middles are near, are of one instance; which stays is
/// decided on the points that tell them apart. Then the pose is refined from others about it (RefinementRestarts) and
/// turned about the axis of a nearly round part, or by an approximate symmetry, where the scene speaks for it, which
/// sets its certainty; it is aligned (alignRobustly), moved where the scan contradicts it (EvidenceAscent), and scored.
Poses selectPoses(const Poses& scored, const Scene& scene, const TrainedModel& model,
  const PoseSelectionSettings& settings = {}, const Progress& progress = {});
}
