// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/PoseSelection.h"

#include "base/sequences/Sequences.h"
#include "pose/PoseTolerances.h"
#include "pose/search/InstanceSuppression.h"
#include "pose/search/PoseClusters.h"
#include "pose/selection/InstanceFinishing.h"
#include "pose/selection/MirrorDecision.h"
#include "pose/selection/SizeDecision.h"
#include "pose/verification/PoseVerification.h"
#include "pose/verification/ProbabilityCalibration.h"

#include <algorithm>
#include <iterator>

namespace meam
{
namespace
{
constexpr double LeastScore = 0.05;    // times that of the best: an alternative with less is not worth refining,
constexpr int LeastRefined = 60;       // so many are, and all that are likelier than this where these are more
constexpr double WorthRefining = 3e-7; // (probability, of poses that are not refined yet)
constexpr std::size_t RateStride = 2;  // of the points that tell the scan's rates of edges one of so many

double clusterDistance(const PoseSelectionSettings& settings, const TrainedModel& model)
{
  return settings.clusterDistance > 0.0 ? settings.clusterDistance : SamePoseDistance * model.diameter;
}

/// Of poses, best first, those that better ones leave: aligned they may have come to the same place.
FinishedInstances withoutShared(const FinishedInstances& found, const InstanceClaims& claims)
{
  std::vector<InstanceClaims::Claim> ofFound;
  std::transform(found.begin(), found.end(), std::back_inserter(ofFound),
    [&](const FinishedInstance& finished) { return claims.of(finished.pose.T_scene_model); });
  FinishedInstances distinct;
  for (const int k :
    suppress(
      static_cast<int>(found.size()), [&](int one, int other) { return claims.areOne(ofFound[one], ofFound[other]); },
      [](int, int) { return false; }))
  {
    distinct.push_back(found[k]);
  }
  return distinct;
}

/// One for each instance, with its final pose; best first.
Poses selectInstances(const Poses& scored, const Scene& scene, const TrainedModel& model,
  const PoseSelectionSettings& settings, const Progress& progress)
{
  const EvidenceCollector collector(scene, model, settings.evidence);
  const PoseComparison comparison(scene, model, settings.comparison);
  const InstanceClaims claims(scene, model, clusterDistance(settings, model));
  std::vector<int> selected;
  if (!isDoneBy(settings.deadline,
        [&]
        {
          selected = bestOfInstances(scored, claims, comparison, settings.comparesInstances, settings.threads,
            settings.deadline.within(subProgress(progress, 0.0, 0.3)));
        }))
  {
    return selectClusters(scored, model, settings, {});
  }
  const EvidenceRates rates = evidenceRatesOf(scored, collector, settings.evidence, RateStride, settings.threads);
  const LocalSearch search(scene, model, comparison, collector, rates, settings.search);
  const InstanceFinishing finishing(scene, model, search, claims, settings);
  FinishedInstances finished = finishing.finished(scored, selected, subProgress(progress, 0.3, 1.0));
  sortBest(finished);
  if (settings.dropsShared)
  {
    finished = withoutShared(finished, claims);
  }
  if (haveSurfaces(scene, model))
  {
    if (settings.excludesOverlaps)
    {
      excludeOverlaps(finished, model);
    }
    // Of what is likely by itself: what else the likely poses say together may make all of them unlikely.
    const CommonDifferences differences =
      settings.weighsDifferences ? differencesOfLikely(finished, scene, model, settings.threads) : CommonDifferences();
    if (settings.weighsLookalikes)
    {
      allowForLookalikes(finished, model, finishing.continuation(), finishing.misfit().excused());
    }
    if (settings.weighsSize)
    {
      allowForOtherSize(finished, scene, model, settings.threads);
    }
    if (settings.weighsMirrorImage && !settings.deadline.hasStruck())
    {
      allowForMirrorImage(finished, scene, model, collector, settings.evidence, rates, settings.threads);
    }
    allowForDifferences(finished, differences, finishing.misfit().excused());
    sortBest(finished);
  }
  if (model.calibration.poses > 0)
  {
    calibrate(finished, model.calibration);
    sortBest(finished);
  }
  Poses instances;
  std::transform(finished.begin(), finished.end(), std::back_inserter(instances),
    [](const FinishedInstance& instance) { return instance.pose; });
  return instances;
}
}

Poses selectClusters(
  const Poses& scored, const TrainedModel& model, const PoseSelectionSettings& settings, const Progress& progress)
{
  const bool isForRefinement = settings.method == SelectionMethod::Alternatives;
  Symmetries same = isForRefinement ? asIfRound(model.symmetries) : model.symmetries;
  if (!isForRefinement)
  {
    same.near.clear();
  }
  const std::vector<int> kept = firstOfClusters(
    scored, same, model, clusterDistance(settings, model), isForRefinement ? settings.alternatives : 1, progress);
  return mapped<Pose>(kept, [&](int i) { return scored[i]; });
}

PoseSelectionSettings candidateSelectionSettings()
{
  PoseSelectionSettings settings;
  settings.method = SelectionMethod::Alternatives;
  return settings;
}

Poses withinLimits(Poses poses, const PoseSelectionSettings& settings)
{
  eraseIf(
    poses, [&](const Pose& pose) { return claimOf(pose, settings.rotationCounts) < settings.minimumProbability; });
  int wanted = 0;
  const auto isEnough = [&](const Pose& pose)
  {
    wanted += !settings.isWanted || settings.isWanted(pose) ? 1 : 0;
    return wanted == settings.maximumPoses;
  };
  const auto last = settings.maximumPoses > 0 ? std::find_if(poses.begin(), poses.end(), isEnough) : poses.end();
  poses.erase(last == poses.end() ? last : std::next(last), poses.end());
  return poses;
}

Poses selectPoses(const Poses& scored, const Scene& scene, const TrainedModel& model,
  const PoseSelectionSettings& settings, const Progress& progress)
{
  Poses selected;
  if (settings.method == SelectionMethod::Instances)
  {
    selected = withinLimits(selectInstances(scored, scene, model, settings, progress), settings);
  }
  else
  {
    selected = selectClusters(scored, model, settings, progress);
    PoseSelectionSettings limits = settings;
    if (settings.method == SelectionMethod::Alternatives)
    {
      const double leastScore = scored.empty() ? 0.0 : LeastScore * scored.front().score;
      eraseIf(selected, [&](const Pose& pose) { return pose.score < leastScore; });
      const auto worth = static_cast<int>(std::count_if(
        selected.begin(), selected.end(), [](const Pose& pose) { return pose.probability > WorthRefining; }));
      limits.maximumPoses = settings.maximumPoses > 0 ? settings.maximumPoses : std::max(LeastRefined, worth);
    }
    selected = withinLimits(std::move(selected), limits);
  }
  report(progress, 1.0);
  return selected;
}
}
