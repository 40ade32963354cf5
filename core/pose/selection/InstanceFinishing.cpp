// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/InstanceFinishing.h"

#include "base/Parallel.h"
#include "pose/PoseTolerances.h"
#include "pose/objective/BodyOverlap.h"
#include "pose/verification/PoseVerification.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr int Lot = 8;                 // instances that are finished before it is asked whether they do,
constexpr int LeastLot = 4;            // or those that are still wanted, and no fewer
constexpr double WorthFinishing = 0.5; // place: what is likelier is finished where not enough are sure
constexpr double WorthJudging = 1e-3;  // place: what is not finished is judged where it lies
constexpr double Hopeless = -6.0;      // log odds where it lies: with less a pose that is finished comes to nothing
constexpr int MostFruitless = 32;      // finished in a row of which none became sure: further ones hardly will,
constexpr int FruitlessOfAsked = 3;    // or so many for each pose that is asked for, but no fewer than
constexpr int LeastFruitless = 16;     // these: the order by scores is not that of finished poses
constexpr double SureRotation = 0.5;   // share of its rotation: with less a pose is none of those that are wanted
constexpr double ClearlyMore = 3.0;    // log odds of a sure pose over those of one that it excludes

/// A scored pose that is not finished.
FinishedInstance asItIs(const Pose& scored) { return { scored, {}, scored.evidence }; }
}

InstanceFinishing::InstanceFinishing(const Scene& scene, const TrainedModel& model, const LocalSearch& search,
  const InstanceClaims& claims, const PoseSelectionSettings& settings)
  : InScene(scene)
  , Model(model)
  , Search(search)
  , Claims(claims)
  , Settings(settings)
  , Continuation(scene, model)
  , Misfit(scene, model)
{
}

FinishedInstance InstanceFinishing::finish(const Pose& scored) const
{
  FinishedInstance hopeless = asItIs(scored);
  this->judgeWhereItLies(hopeless);
  if (hopeless.logOdds < Hopeless)
  {
    return hopeless;
  }
  const LocalSearch::Result best = this->Search.best(scored);
  Pose pose = best.pose;
  setSeen(pose, best.evidence, this->InScene, this->Model);
  setEvidence(pose, best.logOdds);
  pose.contradictions.past = best.evidence.counts.past + best.evidence.counts.farPast;
  if (pose.placeProbability <= WorthExplaining || !haveSurfaces(this->InScene, this->Model))
  {
    return { pose, {}, best.logOdds };
  }
  double least = this->Misfit.at(pose.T_scene_model); // a part that is turned wrongly is no other part
  for (const RotationAlternative& other : pose.alternatives)
  {
    least = std::min(least, this->Misfit.at(other.T_scene_model));
  }
  pose.contradictions.misfit = least / this->Misfit.expected();
  return { pose, this->Continuation.beyond(pose.T_scene_model), best.logOdds };
}

bool InstanceFinishing::isExcluded(const Pose& scored, const std::vector<Sure>& sure) const
{
  if (sure.empty() || !this->Settings.excludesOverlaps || scored.placeProbability <= WorthExplaining)
  {
    return false;
  }
  const InstanceClaims::Claim claim = this->Claims.of(scored.T_scene_model);
  return std::any_of(sure.begin(), sure.end(),
    [&](const Sure& one)
    {
      return one.logOdds > scored.evidence + ClearlyMore &&
             (this->Claims.areOne(one.claim, claim) ||
               bodiesOverlap(this->Model, one.T_scene_model, scored.T_scene_model));
    });
}

void InstanceFinishing::judgeWhereItLies(FinishedInstance& instance) const
{
  instance.logOdds = this->Search.placeLogOdds(instance.pose.T_scene_model);
  setEvidence(instance.pose, instance.logOdds);
}

FinishedInstances InstanceFinishing::finished(
  const Poses& scored, const std::vector<int>& selected, const Progress& progress) const
{
  FinishedInstances finished;
  for (const int k : selected)
  {
    finished.push_back(asItIs(scored[k]));
  }
  std::vector<Sure> sure;
  int enough = 0; // of these, those whose rotation is sure
  const int asked = this->Settings.maximumPoses;
  const int wanted = this->Settings.sureCopies > 0 ? this->Settings.sureCopies : asked > 0 ? asked + SpareCopies : 0;
  const int most = asked > 0 ? std::clamp(FruitlessOfAsked * asked, LeastFruitless, MostFruitless) : MostFruitless;
  int fruitless = 0;
  std::vector<int> asScored;
  const int count = static_cast<int>(selected.size());
  for (int next = 0; next < count;)
  {
    const int missing = wanted - enough;
    if (wanted > 0 && missing <= 0)
    {
      for (; next < count; ++next)
      {
        finished[next].isLeft = true;
        if (this->Settings.sureCopies > 0) // of several types, of which more come out than are wanted of one
        {
          asScored.push_back(next);
        }
      }
      break;
    }
    if (fruitless >= most && finished[next].pose.placeProbability < WorthFinishing)
    {
      for (; next < count; ++next)
      {
        asScored.push_back(next);
      }
      break;
    }
    const double from = static_cast<double>(next) / count;
    const int mostInLot = wanted > 0 ? std::clamp(missing, LeastLot, Lot) : Lot;
    std::vector<int> lot;
    for (; next < count && static_cast<int>(lot.size()) < mostInLot; ++next)
    {
      (this->isExcluded(finished[next].pose, sure) ? asScored : lot).push_back(next);
    }
    const Deadline& deadline = this->Settings.deadline;
    const Progress ofLot = deadline.within(subProgress(progress, from, static_cast<double>(next) / count));
    const bool isDone = isDoneBy(deadline,
      [&]
      {
        parallelForEach(static_cast<int>(lot.size()), this->Settings.threads, ofLot,
          [&](int k) { finished[lot[k]] = this->finish(finished[lot[k]].pose); });
      });
    if (!isDone)
    {
      break;
    }
    for (const int k : lot)
    {
      const FinishedInstance& instance = finished[k];
      const bool isSure = instance.logOdds >= SureLogOdds;
      if (isSure)
      {
        const Eigen::Isometry3d& T = instance.pose.T_scene_model;
        sure.push_back({ T, instance.logOdds, this->Claims.of(T) });
        const bool isWanted = !this->Settings.isWanted || this->Settings.isWanted(instance.pose);
        enough += isWanted && instance.pose.certainty >= SureRotation ? 1 : 0;
      }
      fruitless = isSure ? 0 : fruitless + 1;
    }
  }
  if (!this->Settings.deadline.hasStruck())
  {
    parallelForEach(static_cast<int>(asScored.size()), this->Settings.threads, {},
      [&](int k)
      {
        FinishedInstance& instance = finished[asScored[k]];
        if (instance.pose.placeProbability > WorthJudging)
        {
          this->judgeWhereItLies(instance);
        }
      });
  }
  return finished;
}
}
