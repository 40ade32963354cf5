// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/LocalCloud.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

#include <memory>

namespace meam
{
struct PoseDetectionSettings
{
  Features features = Features::Both; ///< of those that the model holds
  /// P_ref: share of the scene's edge points, and of its surface points, used as reference points; 0: as many as the
  /// scene needs, of the edges by how many copies they would make, and by where they come from.
  double referenceShare = 0.0;
  bool moreInScans = true; ///< more references where edges were found in a scan than of an exact boundary
  /// P_referred: share of the scene's edge points used as referred points, of those in a cube of the model's leaf size
  /// (MEAMHashingSettings) one.
  double referredShare = 1.0;
  /// Buckets of the table of surface points with more entries for each of the model's points tell nothing: pairs on a
  /// plane.
  double longestBucket = 2.0;
  int peaksPerReference = 1; ///< candidates of one reference point; more find more hidden parts, at a cost
  /// The sense of d along a tangent tells which way round it lies; else stored signs are taken for right, which is
  /// wrong for half of the references.
  bool signedTangents = true;
  bool smoothPeaks = true; ///< peaks are of sums of three neighbouring turns
  unsigned seed = 1;       ///< of the choice of both
  int threads = 0;         ///< 0: one for each processor
};

/// Raw pose candidates by voting (paper, Section 5.1): one or more for each reference point that found pairs, in the
/// order of the reference points, in the local frame of `edges`, the scene's edge points with tangents. The same for
/// any number of threads. Throws Error when the scene is empty, has no tangents, or is in another unit than the model.
Poses detectPoses(const LocalCloud& edges, const TrainedModel& model, const PoseDetectionSettings& settings = {},
  const Progress& progress = {});

/// The same by a scene's edge points, and then by the points of its surface, as far as the model holds pairs of both. A
/// model of surface points alone needs a scene with a surface.
Poses detectPoses(const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings = {},
  const Progress& progress = {});

/// What the same is found by, some reference points after others. Keeps references to the scene and the model.
class CandidateSearch
{
public:
  CandidateSearch(const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings = {});
  ~CandidateSearch();

  /// Candidates of the first reference points of each kind, up to a share of them, [0, 1], that is spread over the
  /// scene; those that have voted before do not vote again.
  Poses upTo(double share, const Progress& progress = {});
  /// How many reference points have voted.
  int references() const;
  /// By all points within `radius` (mm) of a place in the local frame, whatever the shares of reference points are:
  /// what is found where one looks for it.
  Poses near(const Eigen::Vector3f& place, double radius, const Progress& progress = {}) const;

private:
  struct Rounds;
  const Scene& InScene;
  const TrainedModel& Model;
  PoseDetectionSettings Settings;
  std::unique_ptr<Rounds> Prepared;
};
}
