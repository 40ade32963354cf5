// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/search/InstanceSuppression.h"
#include "pose/selection/InstanceFinishing.h"
#include "pose/selection/PoseSelection.h"

#include <optional>
#include <vector>

namespace meam
{
/// Selection of one pose for each instance in two steps: where each lies and what speaks for it by itself, and what all
/// of them together tell of what the scan holds. Between the two other types of part may say which are on their copies.
class InstanceSelection
{
public:
  /// Takes one of each instance of `scored`, best first, to its final pose. Keeps references to scene and model.
  InstanceSelection(const Poses& scored, const Scene& scene, const TrainedModel& model,
    const PoseSelectionSettings& settings, const Progress& progress = {});

  /// Those that tell what the scan holds: they are likely by themselves. Best first, in the local frame.
  Poses telling() const;

  /// All, best first. Once. `onOthers`: which of the telling ones are on copies of other types; empty: none.
  Poses poses(const std::vector<bool>& onOthers = {});

private:
  void weighTogether();

  const Scene& InScene;
  const TrainedModel& Model;
  const PoseSelectionSettings Settings;
  const EvidenceCollector Collector;
  const PoseComparison Comparison;
  const InstanceClaims Claims;
  EvidenceRates Rates;
  std::optional<LocalSearch> Search;
  std::optional<InstanceFinishing> Finishing; ///< none where the deadline struck before
  FinishedInstances Finished;                 ///< best first
  Poses Clusters;                             ///< in place of these
};
}
