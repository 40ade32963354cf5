// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/selection/PoseComparison.h"
#include "pose/verification/PoseEvidence.h"
#include "pose/verification/PoseVerification.h"

#include <optional>

namespace meam
{
/// Decides which poses of one instance stay. Keeps references to what it is made of.
class PoseClusters
{
public:
  /// Poses up to the symmetries `same`, near ones among them, are the same. `comparison` may be null: then the better
  /// score decides. Middles nearer than `distance` (mm) are of one instance, those farther apart than `reach` of two.
  PoseClusters(const Poses& poses, const std::vector<PoseEvidence>& evidence, const Symmetries& same,
    const SceneIndex& index, const EvidenceCollector& collector, const PoseComparison* comparison,
    const PoseVerificationSettings& settings, double distance, double reach);

  /// Of the poses `ranked`, indices with the best first, those that stay.
  std::vector<int> select(const std::vector<int>& ranked, const Progress& progress);

  /// Different ones may be asked for in parallel.
  const PoseComparison::Contender& contender(int index);

private:
  /// For each place in `ranked` those of the same instance that come before it.
  std::vector<std::vector<int>> instancesBefore(const std::vector<int>& ranked) const;
  /// Whether the one at place `k` stays, and whether those of its instance, `before` it, still do.
  void choose(int k, const std::vector<int>& before, const std::vector<int>& ranked, std::vector<char>& stays);
  bool sameInstance(int a, int b) const;
  /// Degrees, up to what is the same.
  double turnBetween(int a, int b) const;

  const Poses& InPoses;
  const std::vector<PoseEvidence>& Evidence;
  const Symmetries& Same;
  const EvidenceCollector& Collector;
  const PoseComparison* Comparison;
  const PoseVerificationSettings& Settings;
  double Distance;
  double Reach;
  std::vector<Eigen::Vector3d> Middles; ///< of the part, scene frame
  std::vector<std::optional<PoseComparison::Contender>> Contenders; ///< of the poses, as far as they were asked for
};
}
