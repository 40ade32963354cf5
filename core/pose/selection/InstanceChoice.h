// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Pose.h"
#include "pose/selection/PoseComparison.h"
#include "pose/verification/PoseEvidence.h"

#include <optional>

namespace meam
{
/// Share of the matched points from which on two poses are of one instance: two parts do not have their surface in the
/// same place.
inline constexpr double SharedByOne = 0.5;
inline constexpr double SharedDistance = 0.04; ///< of the diameter, between matched points: a little over their spacing

/// Decides which pose of each instance stays, by the scene: between all of an instance, turned or not. Keeps references
/// to what it is made of.
class InstanceChoice
{
public:
  /// Poses whose middles are nearer than `distance` (mm) are of one instance. `compares`: of nearly equal evidence the
  /// one stays that the scene speaks for, point by point; else the first.
  InstanceChoice(const Poses& poses, double distance, const TrainedModel& model, const EvidenceCollector& collector,
    const PoseComparison& comparison, bool compares, int threads);

  /// Of the poses, best first, the indices of those that stay.
  std::vector<int> select(const Progress& progress = {});

  /// Different ones may be asked for in parallel.
  const PoseComparison::Contender& contender(int index);

private:
  /// For each pose those of the same instance that come before it.
  std::vector<std::vector<int>> instancesBefore() const;
  /// Finds the matched points of the poses near enough to others that these decide.
  void collectMatched();
  /// Whether pose `k` stays, and whether those of its instance, `before` it, still do.
  void choose(int k, const std::vector<int>& before, std::vector<char>& stays);
  bool sameInstance(int a, int b) const;
  /// Whether `b` matched so much of what `a` matched, too: poses of one instance share most of it.
  bool shareMatches(int a, int b) const;

  /// What a pose matched, and its grid for look-ups.
  struct Matched
  {
    Points points;
    PointGrid grid;
  };

  const Poses& InPoses;
  const EvidenceCollector& Collector;
  const PoseComparison& Comparison;
  double EqualEvidence; ///< log odds: poses that differ by less are compared
  int Threads;
  double Distance;                                                  ///< mm
  double Within;                                                    ///< mm
  double Near;                                                      ///< mm
  std::vector<Eigen::Vector3d> Middles;                             ///< of the part, local frame
  std::vector<Matched> MatchedPoints;                               ///< of the poses, as far as they may be asked for
  std::vector<std::optional<PoseComparison::Contender>> Contenders; ///< of the poses, as far as they were asked for
};
}
