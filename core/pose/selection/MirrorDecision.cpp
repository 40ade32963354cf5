// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/MirrorDecision.h"

#include "model/MirrorImage.h"
#include "pose/refinement/FinalAlignment.h"
#include "pose/refinement/PoseRefinement.h"
#include "pose/verification/ProbabilityCalibration.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meam
{
namespace
{
constexpr std::size_t MostAsked = 8; // poses
constexpr double MostOfOne = 5.0;    // log odds that one pose tells at most
constexpr double Prior = 3.0;    // log odds that it is no mirror image: that lies there by mistake, one time in twenty
constexpr double OfChance = 1.0; // log odds off the mirrored part's: the best of several ways has as much by chance
constexpr double Clear = 8.0;    // log odds either way from which on no further pose is asked
constexpr int MirrorSteps = 6;   // of refinement, before the alignment

/// The most that the scan says for the mirrored part where a pose is, as log odds: of the ways in which it may lie
/// there that which fits best before it is aligned.
double logOddsMirrored(const Pose& pose, const MirroredPart& mirrored, const Scene& scene,
  const EvidenceCollector& ofMirrored, const EvidenceRates& rates, int threads)
{
  PoseRefinementSettings refinement;
  refinement.iterations = MirrorSteps;
  refinement.fullLastStep = false; // the alignment takes all points
  refinement.threads = threads;
  Poses turned(mirrored.turns.size(), pose);
  for (std::size_t k = 0; k < turned.size(); ++k)
  {
    turned[k].T_scene_model = pose.T_scene_model * mirrored.turns[k];
  }
  turned = refinePoses(turned, scene, mirrored.model, refinement);
  std::vector<double> logOdds;
  std::transform(turned.begin(), turned.end(), std::back_inserter(logOdds),
    [&](const Pose& other) { return ofMirrored.logOdds(other.T_scene_model, rates); });
  const auto best = std::max_element(logOdds.begin(), logOdds.end()) - logOdds.begin();
  const Pose aligned = alignRobustly(turned[best], scene, mirrored.model);
  return std::max(logOdds[best], ofMirrored.logOdds(aligned.T_scene_model, rates)) - OfChance;
}
}

void allowForMirrorImage(FinishedInstances& found, const Scene& scene, const TrainedModel& model,
  const EvidenceCollector& collector, const EvidenceSettings& settings, const EvidenceRates& rates, int threads)
{
  const Poses likely = likelyOf(found, MostAsked);
  const MirroredPart* mirrored = likely.empty() ? nullptr : model.mirrorImage->of(model);
  if (!mirrored)
  {
    return;
  }
  const EvidenceCollector ofMirrored(scene, mirrored->model, settings);
  double logOdds = Prior;
  for (const Pose& pose : likely)
  {
    if (std::abs(logOdds) < Clear)
    {
      logOdds += std::clamp(collector.logOdds(pose.T_scene_model, rates) -
                              logOddsMirrored(pose, *mirrored, scene, ofMirrored, rates, threads),
        -MostOfOne, MostOfOne);
    }
  }
  const double share = probabilityOf(logOdds);
  for (FinishedInstance& finished : found)
  {
    finished.pose.contradictions.mirrored = 1.0 - share;
    allowFor(finished, share);
  }
}
}
