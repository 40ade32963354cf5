// SPDX-License-Identifier: BSD-3-Clause
#include "features/PairTable.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meam
{
void PairTable::deriveVotes(const Points& points, const Points& directions, PairFeatureKind kind)
{
  this->votingPoints = 0;
  for (const auto* indices : { &this->references, &this->referreds })
  {
    const auto last = std::max_element(indices->begin(), indices->end());
    this->votingPoints = std::max(this->votingPoints, last == indices->end() ? 0 : static_cast<int>(*last) + 1);
  }
  this->votes.assign(this->size() + VoteBlock, 0);
  this->mostOfOne = 1;
  constexpr double stepsOfRadian = (1 << TurnBits) / (2.0 * M_PI);
  for (std::size_t bucket = 0; bucket + 1 < this->offsets.size(); ++bucket)
  {
    std::uint32_t last = UINT32_MAX;
    int ofOne = 0;
    for (std::uint32_t k = this->offsets[bucket]; k < this->offsets[bucket + 1]; ++k)
    {
      const std::uint32_t reference = this->references[k];
      const Eigen::Vector3f d = points[this->referreds[k]] - points[reference];
      const bool against = isOfLines(kind) && directions[reference].dot(d) < 0.0f;
      const double steps = this->angles[k] * stepsOfRadian;
      const auto turn = static_cast<PairTurn>(static_cast<int>(steps + (steps < 0.0 ? -0.5 : 0.5))); // rounded
      this->votes[k] = voteEntry(reference, against, turn);
      ofOne = reference == last ? ofOne + 1 : 1; // entries are sorted by reference
      this->mostOfOne = std::max(this->mostOfOne, ofOne);
      last = reference;
    }
  }
}

PairTable makePairTable(const std::vector<PairEntry>& entries, std::int64_t numberOfKeys)
{
  PairTable table;
  table.offsets.assign(numberOfKeys + 1, 0);
  for (const PairEntry& entry : entries)
  {
    ++table.offsets[entry.key + 1];
  }
  std::partial_sum(table.offsets.begin(), table.offsets.end(), table.offsets.begin());
  std::vector<std::uint32_t> next(table.offsets.begin(), table.offsets.end() - 1);
  table.references.resize(entries.size());
  table.referreds.resize(entries.size());
  table.angles.resize(entries.size());
  table.viewBits.resize(entries.size());
  for (const PairEntry& entry : entries)
  {
    const std::uint32_t place = next[entry.key]++;
    table.references[place] = entry.reference;
    table.referreds[place] = entry.referred;
    table.angles[place] = entry.angle;
    table.viewBits[place] = entry.viewBits;
  }
  return table;
}
}
