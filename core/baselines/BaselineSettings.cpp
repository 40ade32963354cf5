// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/BaselineSettings.h"

#include <limits>

namespace meam
{
PoseDetectionSettings paperDetectionSettings()
{
  PoseDetectionSettings settings;
  settings.referenceShare = 0.2; // tuned for each part there, from 5 to 20 %: the most
  settings.referredShare = 0.2;
  settings.features = Features::Edges;
  return settings;
}

PoseVerificationSettings paperVerificationSettings()
{
  PoseVerificationSettings settings;
  settings.method = VerificationMethod::EdgeCoverage;
  // The text leaves these open: what comes closest to its figures (docs/evaluation.md, readings).
  settings.evidence.tolerance = 1.5;
  settings.posesPerView = 20;
  return settings;
}

PoseSelectionSettings paperSelectionSettings()
{
  PoseSelectionSettings settings;
  settings.method = SelectionMethod::Clusters;
  return settings;
}

PoseRefinementSettings paperRefinementSettings()
{
  PoseRefinementSettings settings;
  settings.method = RefinementMethod::PointToPoint;
  settings.iterations = 50;
  return settings;
}

PoseDetectionSettings originalDetectionSettings()
{
  PoseDetectionSettings settings;
  settings.features = Features::Surface;
  settings.referenceShare = 0.2;
  settings.longestBucket = std::numeric_limits<double>::infinity();
  settings.smoothPeaks = false;
  return settings;
}

PoseVerificationSettings votesVerificationSettings()
{
  PoseVerificationSettings settings;
  settings.method = VerificationMethod::Votes;
  return settings;
}

PoseSelectionSettings votesSelectionSettings()
{
  PoseSelectionSettings settings = paperSelectionSettings();
  settings.maximumPoses = 30; // as many as the paper's from six views
  return settings;
}

DetectionSettings baselineSettings(Preset preset)
{
  DetectionSettings settings;
  settings.tangents = paperTangentSettings();
  settings.detection = paperDetectionSettings();
  settings.candidateVerification = settings.verification = paperVerificationSettings();
  settings.candidateSelection = settings.selection = paperSelectionSettings();
  settings.refinement = paperRefinementSettings();
  if (preset == Preset::B2B)
  {
    settings.tangents.method = TangentMethod::LineSegments;
  }
  if (preset == Preset::OriginalPPF)
  {
    settings.detection = originalDetectionSettings();
    settings.refinement = {}; // by the surface: its points are what poses are found by
  }
  if (preset == Preset::OriginalPPF || preset == Preset::B2B)
  {
    settings.candidateVerification = settings.verification = votesVerificationSettings();
    settings.candidateSelection = votesSelectionSettings();
  }
  return settings;
}
}
