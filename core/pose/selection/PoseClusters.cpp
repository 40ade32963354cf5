// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/PoseClusters.h"

#include "base/Parallel.h"

#include <algorithm>
#include <iterator>

namespace meam
{
namespace
{
constexpr int MostCompared = 300;   // poses that are all compared with each other to find those of one instance
constexpr double SharedByOne = 0.5; // share of the matched surface from which on two poses are of one instance

/// Places that are of one instance, directly or by others between them, ascending: different groups have nothing to do
/// with each other.
std::vector<std::vector<int>> joined(const std::vector<std::vector<int>>& before)
{
  const int count = static_cast<int>(before.size());
  std::vector<int> groupOf(count);
  std::vector<std::vector<int>> groups(count);
  for (int k = 0; k < count; ++k)
  {
    groupOf[k] = k;
    for (const int other : before[k])
    {
      const int group = groupOf[other];
      std::replace(groupOf.begin(), groupOf.begin() + k, group, k);
    }
  }
  for (int k = 0; k < count; ++k)
  {
    groups[groupOf[k]].push_back(k);
  }
  return groups;
}
}

PoseClusters::PoseClusters(const Poses& poses, const std::vector<PoseEvidence>& evidence, const Symmetries& same,
  const SceneIndex& index, const EvidenceCollector& collector, const PoseComparison* comparison,
  const PoseVerificationSettings& settings, double distance, double reach)
  : InPoses(poses)
  , Evidence(evidence)
  , Same(same)
  , Collector(collector)
  , Comparison(comparison)
  , Settings(settings)
  , Distance(distance)
  , Reach(reach)
  , Contenders(poses.size())
{
  for (const Pose& pose : poses)
  {
    this->Middles.push_back(pose.T_scene_model * index.view.middle().cast<double>());
  }
}

std::vector<int> PoseClusters::select(const std::vector<int>& ranked, const Progress& progress)
{
  const int count = static_cast<int>(ranked.size());
  std::vector<char> stays(count, 0);
  if (count <= MostCompared)
  {
    const std::vector<std::vector<int>> before = this->instancesBefore(ranked);
    const std::vector<std::vector<int>> groups = joined(before);
    parallelFor(count, this->Settings.threads, progress,
      [&](int begin, int end, int)
      {
        for (int g = begin; g < end; ++g)
        {
          for (const int k : groups[g])
          {
            this->choose(k, before[k], ranked, stays);
          }
        }
      });
  }
  else // all against all would take too long
  {
    for (int k = 0; k < count; ++k)
    {
      report(progress, static_cast<double>(k) / count);
      std::vector<int> before;
      for (int other = 0; other < k; ++other)
      {
        if (stays[other] && this->sameInstance(ranked[k], ranked[other]))
        {
          before.push_back(other);
        }
      }
      this->choose(k, before, ranked, stays);
    }
  }
  std::vector<int> selected;
  for (int k = 0; k < count; ++k)
  {
    if (stays[k])
    {
      selected.push_back(ranked[k]);
    }
  }
  return selected;
}

const PoseComparison::Contender& PoseClusters::contender(int index)
{
  std::optional<PoseComparison::Contender>& known = this->Contenders[index];
  if (!known)
  {
    known = this->Comparison->contender(this->InPoses[index].T_scene_model);
  }
  return *known;
}

std::vector<std::vector<int>> PoseClusters::instancesBefore(const std::vector<int>& ranked) const
{
  const int count = static_cast<int>(ranked.size());
  std::vector<std::vector<int>> before(count);
  parallelFor(count, this->Settings.threads, {},
    [&](int begin, int end, int)
    {
      for (int k = begin; k < end; ++k)
      {
        for (int other = 0; other < k; ++other)
        {
          if (this->sameInstance(ranked[k], ranked[other]))
          {
            before[k].push_back(other);
          }
        }
      }
    });
  return before;
}

void PoseClusters::choose(
  int k, const std::vector<int>& before, const std::vector<int>& ranked, std::vector<char>& stays)
{
  std::vector<int> alternatives;
  std::copy_if(before.begin(), before.end(), std::back_inserter(alternatives), [&](int other) { return stays[other]; });
  const bool isKnown = std::any_of(alternatives.begin(), alternatives.end(),
    [&](int other) { return this->turnBetween(ranked[k], ranked[other]) < this->Settings.clusterAngle; });
  if (isKnown)
  {
    return;
  }
  if (static_cast<int>(alternatives.size()) >= this->Settings.posesPerInstance)
  {
    const bool isBest = this->Comparison &&
      std::all_of(alternatives.begin(), alternatives.end(),
        [&](int other)
        { return this->Comparison->advantage(this->contender(ranked[k]), this->contender(ranked[other])) > 0.0; });
    if (!isBest)
    {
      return;
    }
    for (const int other : alternatives)
    {
      stays[other] = 0;
    }
  }
  stays[k] = 1;
}

bool PoseClusters::sameInstance(int a, int b) const
{
  const double apart = (this->Middles[a] - this->Middles[b]).norm();
  if (apart < this->Distance || !this->Comparison)
  {
    return apart < this->Distance;
  }
  // Two parts do not have their surface in the same place.
  return apart < this->Reach && this->Collector.shared(this->Evidence[a], this->Evidence[b]) > SharedByOne;
}

double PoseClusters::turnBetween(int a, int b) const
{
  const Eigen::Isometry3d& of = this->InPoses[a].T_scene_model;
  const Eigen::Isometry3d& T = this->InPoses[b].T_scene_model;
  double least = rotationError(nearestEqual(of, T, this->Same), T);
  for (const NearSymmetry& symmetry : this->Same.near)
  {
    least = std::min(least, rotationError(nearestEqual(of * symmetry.T, T, this->Same), T));
  }
  return least;
}
}
