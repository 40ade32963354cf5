// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/InstanceSelection.h"

#include "base/sequences/Sequences.h"
#include "pose/selection/MirrorDecision.h"
#include "pose/selection/SizeDecision.h"

#include <algorithm>
#include <iterator>

namespace meam
{
namespace
{
constexpr std::size_t RateStride = 2; // of the points that tell the scan's rates of edges one of so many

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

}

InstanceSelection::InstanceSelection(const Poses& scored, const Scene& scene, const TrainedModel& model,
  const PoseSelectionSettings& settings, const Progress& progress)
  : InScene(scene)
  , Model(model)
  , Settings(settings)
  , Collector(scene, model, settings.evidence)
  , Comparison(scene, model, settings.comparison)
  , Claims(scene, model, clusterDistance(settings, model))
{
  std::vector<int> selected;
  if (!isDoneBy(settings.deadline,
        [&]
        {
          selected = bestOfInstances(scored, this->Claims, this->Comparison, settings.comparesInstances,
            settings.threads, settings.deadline.within(subProgress(progress, 0.0, 0.3)));
        }))
  {
    this->Clusters = selectClusters(scored, model, settings, {});
    return;
  }
  this->Rates = evidenceRatesOf(scored, this->Collector, settings.evidence, RateStride, settings.threads);
  this->Search.emplace(scene, model, this->Comparison, this->Collector, this->Rates, settings.search);
  this->Finishing.emplace(scene, model, *this->Search, this->Claims, this->Settings);
  this->Finished = this->Finishing->finished(scored, selected, subProgress(progress, 0.3, 1.0));
  sortBest(this->Finished);
  if (settings.dropsShared)
  {
    this->Finished = withoutShared(this->Finished, this->Claims);
  }
  if (haveSurfaces(scene, model) && settings.excludesOverlaps)
  {
    excludeOverlaps(this->Finished, model);
  }
}

Poses InstanceSelection::telling() const { return likelyOf(this->Finished, this->Finished.size()); }

Poses InstanceSelection::poses(const std::vector<bool>& onOthers)
{
  if (!this->Finishing)
  {
    return this->Clusters;
  }
  if (!onOthers.empty())
  {
    auto isOnOther = onOthers.begin();
    for (FinishedInstance& one : this->Finished)
    {
      one.isOnOther = tells(one) && *isOnOther++;
    }
  }
  if (haveSurfaces(this->InScene, this->Model))
  {
    this->weighTogether();
  }
  if (this->Model.calibration.poses > 0)
  {
    calibrate(this->Finished, this->Model.calibration);
    sortBest(this->Finished);
  }
  return mapped<Pose>(this->Finished, [](const FinishedInstance& instance) { return instance.pose; });
}

void InstanceSelection::weighTogether()
{
  const PoseSelectionSettings& settings = this->Settings;
  // Of what is likely by itself: what else the likely poses say together may make all of them unlikely.
  const CommonDifferences differences =
    settings.weighsDifferences ? differencesOfLikely(this->Finished, this->InScene, this->Model, settings.threads)
                               : CommonDifferences();
  const double excused = this->Finishing->misfit().excused();
  if (settings.weighsLookalikes)
  {
    allowForLookalikes(this->Finished, this->Model, this->Finishing->continuation(), excused);
  }
  if (settings.weighsSize)
  {
    allowForOtherSize(this->Finished, this->InScene, this->Model, settings.threads);
  }
  if (settings.weighsMirrorImage && !settings.deadline.hasStruck())
  {
    allowForMirrorImage(
      this->Finished, this->InScene, this->Model, this->Collector, settings.evidence, this->Rates, settings.threads);
  }
  allowForDifferences(this->Finished, differences, excused);
  sortBest(this->Finished);
}
}
