// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace meam
{
struct TrainedModel;

/// Of the reach of a part's distance field: what is so far off the part is beside it.
inline constexpr float NearlyFarthest = 0.98f;

/// Patches of a part's surface and of the places beside it, by which its copies are compared, numbered together.
struct PartPatches
{
  int count = 0;
  std::vector<char> isRing;   ///< of each: it goes around a round part, and is as much as several
  std::vector<int> ofSamples; ///< of each sample of the surface
  Points beside;              ///< where the faces of the samples would go on if they did not end
  std::vector<int> ofBeside;  ///< of each of these
  std::vector<int> begins;    ///< of each sample the first of its places, and the end of the last one's
};

/// The patches of a model. Those for some resolutions are kept, as scans of one sensor have them. Calls may run in
/// parallel.
class SurroundingPatches
{
public:
  SurroundingPatches() = default;
  /// Of a model of which the steps are known: they are found anew where there are not as many as it has samples.
  explicit SurroundingPatches(std::vector<std::uint8_t> steps);

  /// `model` is the one that holds this. The places lie at least `distance` (mm) from their samples along their faces,
  /// and where its distance field ends.
  std::shared_ptr<const PartPatches> of(const TrainedModel& model, double distance, int threads) const;
  /// In which step along its face the places beside each sample begin, for each way; as many as there are: in none.
  const std::vector<std::uint8_t>& steps(const TrainedModel& model, int threads = 1) const;

private:
  mutable std::mutex Finding, Making;
  mutable std::vector<std::uint8_t> Found; ///< the steps
  /// By the steps that the places are farther off than the field reaches.
  mutable std::map<int, std::shared_ptr<const PartPatches>> Made;
};
}
