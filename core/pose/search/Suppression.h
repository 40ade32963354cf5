// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "scene/Scene.h"

#include <algorithm>
#include <vector>

namespace meam
{
/// Share of the points that one of two poses explains from which on, when the other explains them, too, both are of one
/// instance: two parts do not have their surface in the same place.
inline constexpr double SharedByOne = 0.5;

/// The measured points that a pose explains: those of the scene's surface, without one of its edges, that lie on the
/// part. Ascending places in the order of the scene's grid.
using ExplainedPoints = std::vector<int>;

/// The points within `tolerance` (mm) of the part. `ofPart` has the scene's surface when `scene` has.
ExplainedPoints explainedPoints(
  const Scene& scene, const TrainedModel& ofPart, const Eigen::Isometry3d& T_scene_model, double tolerance);

/// How many both explain.
std::size_t sharedPoints(const ExplainedPoints& a, const ExplainedPoints& b);

/// Non-maximum suppression. Of `count` items, best first, the places of those that stay, ascending: one that is no
/// rival of those before it that stay, and one that `beats` all of them, whose place it takes.
template <typename AreRivals, typename Beats>
std::vector<int> suppress(int count, const AreRivals& areRivals, const Beats& beats)
{
  std::vector<int> staying;
  for (int k = 0; k < count; ++k)
  {
    const auto rivals =
      std::stable_partition(staying.begin(), staying.end(), [&](int other) { return !areRivals(k, other); });
    if (std::all_of(rivals, staying.end(), [&](int other) { return beats(k, other); }))
    {
      staying.erase(rivals, staying.end());
      staying.push_back(k);
    }
    else
    {
      std::sort(staying.begin(), staying.end());
    }
  }
  return staying;
}
}
