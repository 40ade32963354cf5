// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/PoseSelection.h"

#include "base/Parallel.h"
#include "pose/PoseTolerances.h"
#include "pose/objective/SurfaceContinuation.h"
#include "pose/objective/SurfaceMisfit.h"
#include "pose/search/InstanceSuppression.h"
#include "pose/selection/InstanceOdds.h"
#include "pose/search/PoseClusters.h"
#include "pose/verification/PoseVerification.h"
#include "pose/verification/ProbabilityCalibration.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meam
{
namespace
{
constexpr double LeastScore = 0.05;    // times that of the best: an alternative with less is not worth refining,
constexpr int LeastRefined = 60;       // so many are, and all that are likelier than this where these are more
constexpr double WorthRefining = 3e-7; // (probability, of poses that are not refined yet)
constexpr int Lot = 16;                // instances that are finished before it is asked whether they do
constexpr double WorthFinishing = 0.5; // place: what is likelier is finished in any case
constexpr std::size_t RateStride = 2;  // of the points that tell the scan's rates of edges one of so many

double clusterDistance(const PoseSelectionSettings& settings, const TrainedModel& model)
{
  return settings.clusterDistance > 0.0 ? settings.clusterDistance : SamePoseDistance * model.diameter;
}

/// Scores what the local search found, and what contradicts it.
FinishedInstance finish(const LocalSearch::Result& best, const Scene& scene, const TrainedModel& model,
  const SurfaceContinuation& continuation, const SurfaceMisfit& misfit)
{
  Pose pose = best.pose;
  setSeen(pose, best.evidence, scene, model);
  setEvidence(pose, best.logOdds);
  pose.contradictions.past = best.evidence.counts.past + best.evidence.counts.farPast;
  if (pose.placeProbability <= WorthExplaining || !haveSurfaces(scene, model))
  {
    return { pose, {}, best.logOdds, best.logOddsBefore };
  }
  double least = misfit.at(pose.T_scene_model); // a part that is turned wrongly is no other part
  for (const RotationAlternative& other : pose.alternatives)
  {
    least = std::min(least, misfit.at(other.T_scene_model));
  }
  pose.contradictions.misfit = least / misfit.expected();
  return { pose, continuation.beyond(pose.T_scene_model), best.logOdds, best.logOddsBefore };
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

/// A scored pose that is not finished.
FinishedInstance asItIs(const Pose& scored) { return { scored, {}, scored.evidence, scored.evidence }; }

/// Whether those that are wanted are finished and sure, with some to spare, and the next one, of those scored best
/// first, is unlikely: what follows will not come before them. Never where all are wanted.
bool areEnough(const FinishedInstances& finished, const Pose& next, const PoseSelectionSettings& settings)
{
  const auto sure = std::count_if(
    finished.begin(), finished.end(), [](const FinishedInstance& instance) { return instance.logOdds >= SureLogOdds; });
  return settings.maximumPoses > 0 && sure >= settings.maximumPoses + SpareCopies &&
         next.placeProbability < WorthFinishing;
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
  const SurfaceContinuation continuation(scene, model);
  const SurfaceMisfit misfit(scene, model);
  const LocalSearch search(scene, model, comparison, collector, rates, settings.search);
  const int count = static_cast<int>(selected.size());
  FinishedInstances finished;
  while (static_cast<int>(finished.size()) < count && !areEnough(finished, scored[selected[finished.size()]], settings))
  {
    const int done = static_cast<int>(finished.size());
    const int lot = settings.maximumPoses > 0 ? std::min(Lot, count - done) : count;
    for (int k = done; k < done + lot; ++k)
    {
      finished.push_back(asItIs(scored[selected[k]]));
    }
    const Progress ofLot = subProgress(progress, 0.3 + 0.7 * done / count, 0.3 + 0.7 * (done + lot) / count);
    const bool isDone = isDoneBy(settings.deadline,
      [&]
      {
        parallelFor(lot, settings.threads, settings.deadline.within(ofLot),
          [&](int begin, int end, int)
          {
            for (int k = done + begin; k < done + end; ++k)
            {
              finished[k] = finish(search.best(scored[selected[k]]), scene, model, continuation, misfit);
            }
          });
      });
    if (!isDone)
    {
      break;
    }
  }
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
    if (settings.weighsLookalikes)
    {
      allowForLookalikes(finished, model, continuation, misfit.excused());
    }
    if (!settings.partIsPresent)
    {
      allowForAbsence(finished);
    }
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
  Poses selected;
  for (const int i : firstOfClusters(
         scored, same, model, clusterDistance(settings, model), isForRefinement ? settings.alternatives : 1, progress))
  {
    selected.push_back(scored[i]);
  }
  return selected;
}

PoseSelectionSettings candidateSelectionSettings()
{
  PoseSelectionSettings settings;
  settings.method = SelectionMethod::Alternatives;
  return settings;
}

Poses withinLimits(Poses poses, const PoseSelectionSettings& settings)
{
  poses.erase(std::remove_if(poses.begin(), poses.end(),
                [&](const Pose& pose) { return claimOf(pose, settings.rotationCounts) < settings.minimumProbability; }),
    poses.end());
  poses.resize(settings.maximumPoses > 0 ? std::min<std::size_t>(poses.size(), settings.maximumPoses) : poses.size());
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
      selected.erase(
        std::remove_if(selected.begin(), selected.end(), [&](const Pose& pose) { return pose.score < leastScore; }),
        selected.end());
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
