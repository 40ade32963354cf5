// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/LocalFrame.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"

namespace meam
{
/// P_ref for edges found in a scan, by its image or its depth: many are not the part's, and some are displaced, so fewer
/// references lead to a candidate than with an exact boundary.
constexpr double ImageReferenceShare = 0.1;

struct PoseDetectionSettings
{
  double referenceShare = 0.03; ///< P_ref: share of the scene's edge points used as reference points, at least 100
  /// P_referred: share of the scene's edge points used as referred points, of those in a cube of the model's leaf size
  /// (MEAMHashingSettings) one.
  double referredShare = 1.0;
  int peaksPerReference = 1;    ///< candidates of one reference point; more find more hidden parts, at a cost
  /// The sense of d along a tangent tells which way round it lies; else stored signs are taken for right, which is wrong
  /// for half of the references.
  bool signedTangents = true;
  bool smoothPeaks = true;      ///< peaks are of sums of three neighbouring turns
  unsigned seed = 1;            ///< of the choice of both
  int threads = 0;              ///< 0: one for each processor
};

/// The paper's settings (Section 6) in place of the recommended ones.
PoseDetectionSettings paperDetectionSettings();

/// Raw pose candidates by voting (paper, Section 5.1): one or more for each reference point that found pairs,
/// in the order of the reference points. `edges` are the scene's edge points with tangents, mm; a motion of them in double
/// precision moves the candidates and changes nothing else.
/// The same for any number of threads. Throws Error when the scene is empty, has no tangents, or is
/// in another unit than the model.
Poses detectPoses(const PreciseCloud& edges, const TrainedModel& model, const PoseDetectionSettings& settings = {},
  const Progress& progress = {});
}
