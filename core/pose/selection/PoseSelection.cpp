// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/PoseSelection.h"

#include "base/sequences/Sequences.h"
#include "pose/PoseTolerances.h"
#include "pose/search/PoseClusters.h"
#include "pose/selection/InstanceSelection.h"

#include <algorithm>
#include <iterator>

namespace meam
{
namespace
{
constexpr double LeastScore = 0.05;    // times that of the best: an alternative with less is not worth refining,
constexpr int LeastRefined = 60;       // so many are, and all that are likelier than this where these are more
constexpr double WorthRefining = 3e-7; // (probability, of poses that are not refined yet)
}

double clusterDistance(const PoseSelectionSettings& settings, const TrainedModel& model)
{
  return settings.clusterDistance > 0.0 ? settings.clusterDistance : SamePoseDistance * model.diameter;
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
    InstanceSelection instances(scored, scene, model, settings, progress);
    selected = withinLimits(instances.poses(), settings);
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
