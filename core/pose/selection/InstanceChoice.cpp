// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/InstanceChoice.h"

#include "base/Parallel.h"

#include <algorithm>
#include <iterator>

namespace meam
{
namespace
{
constexpr double SharedWithin = 0.5; // of the diameter: middles farther apart are of two instances all the same
constexpr double NearlyEqual = 3.0;  // poses whose evidence (log odds) differs by less are compared point by point
constexpr int AllCompared = 300;     // of more poses than this each is compared only with those that stay

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

InstanceChoice::InstanceChoice(const Poses& poses, double distance, const TrainedModel& model,
  const EvidenceCollector& collector, const PoseComparison& comparison, bool compares, int threads)
  : InPoses(poses)
  , Collector(collector)
  , Comparison(comparison)
  , EqualEvidence(compares ? NearlyEqual : 0.0)
  , Threads(threads)
  , Distance(distance)
  , Within(SharedWithin * model.diameter)
  , Near(SharedDistance * model.diameter)
  , MatchedPoints(poses.size())
  , Contenders(poses.size())
{
  for (const Pose& pose : poses)
  {
    this->Middles.push_back(pose.T_scene_model * model.visibility->middle().cast<double>());
  }
}

std::vector<int> InstanceChoice::select(const Progress& progress)
{
  const int count = static_cast<int>(this->InPoses.size());
  std::vector<char> stays(count, 0);
  this->collectMatched();
  if (count <= AllCompared)
  {
    const std::vector<std::vector<int>> before = this->instancesBefore();
    const std::vector<std::vector<int>> groups = joined(before);
    parallelFor(count, this->Threads, progress,
      [&](int begin, int end, int)
      {
        for (int g = begin; g < end; ++g)
        {
          for (const int k : groups[g])
          {
            this->choose(k, before[k], stays);
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
        if (stays[other] && this->sameInstance(k, other))
        {
          before.push_back(other);
        }
      }
      this->choose(k, before, stays);
    }
  }
  std::vector<int> selected;
  for (int k = 0; k < count; ++k)
  {
    if (stays[k])
    {
      selected.push_back(k);
    }
  }
  return selected;
}

const PoseComparison::Contender& InstanceChoice::contender(int index)
{
  std::optional<PoseComparison::Contender>& known = this->Contenders[index];
  if (!known)
  {
    known = this->Comparison.contender(this->InPoses[index].T_scene_model);
  }
  return *known;
}

void InstanceChoice::collectMatched()
{
  const int count = static_cast<int>(this->InPoses.size());
  parallelFor(count, this->Threads, {},
    [&](int begin, int end, int)
    {
      for (int k = begin; k < end; ++k)
      {
        const bool isAskedFor = std::any_of(this->Middles.begin(), this->Middles.end(),
          [&](const Eigen::Vector3d& other)
          {
            const double apart = (other - this->Middles[k]).norm();
            return apart >= this->Distance && apart < this->Within;
          });
        if (isAskedFor)
        {
          Matched& matched = this->MatchedPoints[k];
          matched.points = this->Collector.matchedPoints(this->InPoses[k].T_scene_model);
          matched.grid = PointGrid(matched.points, this->Near);
        }
      }
    });
}

std::vector<std::vector<int>> InstanceChoice::instancesBefore() const
{
  const int count = static_cast<int>(this->InPoses.size());
  std::vector<std::vector<int>> before(count);
  parallelFor(count, this->Threads, {},
    [&](int begin, int end, int)
    {
      for (int k = begin; k < end; ++k)
      {
        for (int other = 0; other < k; ++other)
        {
          if (this->sameInstance(k, other))
          {
            before[k].push_back(other);
          }
        }
      }
    });
  return before;
}

void InstanceChoice::choose(int k, const std::vector<int>& before, std::vector<char>& stays)
{
  std::vector<int> alternatives;
  std::copy_if(before.begin(), before.end(), std::back_inserter(alternatives), [&](int other) { return stays[other]; });
  const bool isBest = std::all_of(alternatives.begin(), alternatives.end(),
    [&](int other)
    {
      return this->InPoses[k].evidence > this->InPoses[other].evidence - this->EqualEvidence &&
             this->Comparison.advantage(this->contender(k), this->contender(other)) > 0.0;
    });
  if (!isBest)
  {
    return;
  }
  for (const int other : alternatives)
  {
    stays[other] = 0;
  }
  stays[k] = 1;
}

bool InstanceChoice::sameInstance(int a, int b) const
{
  const double apart = (this->Middles[a] - this->Middles[b]).norm();
  return apart < this->Distance || (apart < this->Within && this->shareMatches(a, b));
}

bool InstanceChoice::shareMatches(int a, int b) const
{
  const Points& points = this->MatchedPoints[a].points;
  const PointGrid& others = this->MatchedPoints[b].grid;
  const double wanted = SharedByOne * static_cast<double>(points.size());
  std::size_t shared = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    shared += others.nearest(points[k], this->Near) >= 0 ? 1 : 0;
    if (static_cast<double>(shared) > wanted)
    {
      return true;
    }
    if (static_cast<double>(shared + points.size() - k - 1) <= wanted) // the rest cannot make up for it
    {
      return false;
    }
  }
  return false;
}
}
