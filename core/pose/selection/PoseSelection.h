// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Deadline.h"
#include "pose/Pose.h"
#include "pose/search/LocalSearch.h"
#include "pose/selection/PoseComparison.h"
#include "pose/verification/PoseEvidence.h"

#include <functional>

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
  double clusterDistance = 0.0;    ///< mm: poses whose middles are nearer are of one instance; 0: 10 % of the diameter
  int alternatives = 4;            ///< of an instance (Alternatives)
  int maximumPoses = 0;            ///< of all the best; 0: no limit, or of Alternatives those that are worth refining
  double minimumProbability = 0.0; ///< of what comes out, poses are dropped where a copy is less likely,
  bool rotationCounts = false;     ///< or, counting its rotation, the pose is
  std::function<bool(const Pose&)> isWanted; ///< others compete with those that are, and count for none; empty: all are
  // Instances
  bool dropsShared = true;       ///< poses whose surface better ones have
  bool excludesOverlaps = true;  ///< of poses that cut into each other one is right at most
  bool weighsLookalikes = true;  ///< what contradicts a pose speaks for another part
  bool weighsDifferences = true; ///< what differs from the part at the same place on most copies is another one
  bool weighsSize = true;        ///< what is longer or shorter than the CAD file's part is another one
  bool weighsMirrorImage = true; ///< what fits the part as a mirror shows it better is that
  bool comparesInstances = true; ///< poses of nearly the same evidence, point by point
  EvidenceSettings evidence;     ///< that poses are scored by once more
  PoseComparisonSettings comparison;
  LocalSearchSettings search;
  int sureCopies = 0; ///< no more are finished when so many are sure; 0: two more than maximumPoses
  int threads = 0;    ///< 0: one for each processor
  Deadline deadline;  ///< then those come out that are finished, and the others as they came in
};

/// mm: poses whose middles are nearer are of one instance.
double clusterDistance(const PoseSelectionSettings& settings, const TrainedModel& model);

/// The recommended settings before refinement.
PoseSelectionSettings candidateSelectionSettings();

/// Of scored poses, best first, those that Alternatives and Clusters choose from: some of each instance, and one.
Poses selectClusters(
  const Poses& scored, const TrainedModel& model, const PoseSelectionSettings& settings, const Progress& progress = {});

/// Of selected poses, best first, those that are likely enough, up to the last of the maximum number of those wanted.
Poses withinLimits(Poses poses, const PoseSelectionSettings& settings);

/// Of scored poses, best first (verifyPoses), those that stay, best first, in the local frame.
///
/// Instances: poses that share most of what they match, or whose middles are near, are of one instance; which stays is
/// decided on the points that tell them apart. Its best rotation and place are looked for (LocalSearch), and what
/// contradicts it, other poses, and that the part may be missing, lower its odds (InstanceOdds).
Poses selectPoses(const Poses& scored, const Scene& scene, const TrainedModel& model,
  const PoseSelectionSettings& settings = {}, const Progress& progress = {});
}
