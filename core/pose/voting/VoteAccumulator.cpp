// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/VoteAccumulator.h"

#include "base/AllVectors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace meam
{
namespace
{
/// One after the other, so that votes for one bin add up.
inline void count(const std::uint32_t* bins, int votes, bool mayOverflow, std::uint16_t* counts)
{
  if (!mayOverflow)
  {
    int k = 0;
#pragma GCC unroll 4
    for (; k + 1 < votes; k += 2)
    {
      std::uint64_t both; // bins, read at once
      std::memcpy(&both, bins + k, sizeof(both));
      ++counts[static_cast<std::uint32_t>(both)];
      ++counts[both >> 32];
    }
    if (k < votes)
    {
      ++counts[bins[k]];
    }
    return;
  }
  for (int k = 0; k < votes; ++k)
  {
    counts[bins[k]] = static_cast<std::uint16_t>(counts[bins[k]] + (counts[bins[k]] < SheetGroup::MostVotes ? 1 : 0));
  }
}

MEAM_ALL_VECTORS
void castVotes(const std::uint32_t* entries, const VoteBucket* buckets, int pairs, std::uint32_t turns,
  bool mayOverflow, std::uint16_t* counts)
{
  constexpr std::uint32_t laneMask = SheetGroup::Sheets - 1;
  constexpr int chunk = 128; // bins that wait until they are counted
  std::uint32_t bins[chunk + VoteBlock];
  int waiting = 0;
  for (int pair = 0; pair < pairs; ++pair)
  {
    const VoteBucket& bucket = buckets[pair];
    // Of a scene pair that runs against its tangent it is the other flip, and its turn the other way round makes
    // -alpha: alpha is ~(-alpha - 1).
    const std::uint32_t against = 0u - (bucket.turn >> TurnBits);
    const std::uint32_t turn = (bucket.turn ^ against) << SheetBits;
    const std::uint32_t turned = against & (~SheetMask | 1u);
    for (std::uint32_t begin = bucket.begin; begin < bucket.end; begin += VoteBlock)
    {
      const std::uint32_t* entry = entries + begin;
      std::uint32_t* bin = bins + waiting;
#pragma omp simd
      for (int k = 0; k < VoteBlock; ++k) // also of entries after the bucket's end, which are not counted
      {
        const std::uint32_t sum = (entry[k] + turn) ^ turned;
        const std::uint32_t row = ((sum >> SheetBits) * turns) >> TurnBits;
        bin[k] = (sum & SheetMask & ~laneMask) * turns + row * SheetGroup::Sheets + (sum & laneMask);
      }
      waiting += static_cast<int>(std::min<std::uint32_t>(VoteBlock, bucket.end - begin));
      if (waiting >= chunk)
      {
        count(bins, chunk, mayOverflow, counts);
        std::copy_n(bins + chunk, VoteBlock, bins);
        waiting -= chunk;
      }
    }
  }
  count(bins, waiting, mayOverflow, counts);
}

inline void raise(SheetGroup& most, const SheetGroup& before, const SheetGroup& here, const SheetGroup& after)
{
#pragma omp simd
  for (int k = 0; k < SheetGroup::Sheets; ++k)
  {
    const auto sum = static_cast<std::uint16_t>(before.of[k] + here.of[k] + after.of[k]);
    most.of[k] = sum > most.of[k] ? sum : most.of[k];
  }
}

/// The largest sums of three neighbouring bins, the first of which follows the last, of the sheets of a group.
MEAM_ALL_VECTORS
void largestSums(const SheetGroup* bins, int turns, SheetGroup& result)
{
  SheetGroup most{};
  raise(most, bins[turns - 1], bins[0], bins[1 % turns]);
  for (int bin = 1; bin + 1 < turns; ++bin)
  {
    raise(most, bins[bin - 1], bins[bin], bins[bin + 1]);
  }
  raise(most, bins[(turns + turns - 2) % turns], bins[turns - 1], bins[0]);
  std::copy_n(most.of, SheetGroup::Sheets, result.of);
}

/// The largest bins of the sheets of a group.
void largestBins(const SheetGroup* bins, int turns, SheetGroup& result)
{
  const SheetGroup none{};
  result = none;
  for (int bin = 0; bin < turns; ++bin)
  {
    raise(result, none, bins[bin], none);
  }
}

MEAM_ALL_VECTORS
std::uint16_t largest(const std::uint16_t* values, std::size_t count)
{
  std::uint16_t most = 0;
#pragma omp simd reduction(max : most)
  for (std::size_t k = 0; k < count; ++k)
  {
    most = values[k] > most ? values[k] : most;
  }
  return most;
}
}

VoteAccumulator::VoteAccumulator(int modelPoints, double angleStep, bool smooth)
  : Turns(std::max(1, static_cast<int>(std::lround(2.0 * M_PI / angleStep))))
  , Smooth(smooth)
  , Largest(2 * modelPoints / SheetGroup::Sheets + 1)
  , Counts(this->Largest.size() * this->Turns)
{
}

void VoteAccumulator::clear()
{
  std::fill_n(this->Counts.data()->of, this->Counts.size() * SheetGroup::Sheets, std::uint16_t{ 0 });
  this->Cast = 0;
}

void VoteAccumulator::vote(const std::uint32_t* entries, const VoteBucket* buckets, int count, int mostOfOne)
{
  this->Cast += static_cast<std::int64_t>(count) * mostOfOne;
  castVotes(entries, buckets, count, this->Turns, this->Cast > SheetGroup::MostVotes, this->Counts.data()->of);
}

std::vector<VotePeak> VoteAccumulator::peaks(int count)
{
  for (std::size_t group = 0; group < this->Largest.size(); ++group)
  {
    (this->Smooth ? largestSums : largestBins)(
      this->Counts.data() + group * this->Turns, this->Turns, this->Largest[group]);
  }
  std::uint16_t* sums = this->Largest.data()->of;
  const std::size_t sheets = this->Largest.size() * SheetGroup::Sheets;
  std::vector<VotePeak> found;
  while (static_cast<int>(found.size()) < count)
  {
    const std::uint16_t most = largest(sums, sheets);
    if (most == 0)
    {
      break;
    }
    const int sheet = static_cast<int>(std::find(sums, sums + sheets, most) - sums);
    const SheetGroup* bins = this->Counts.data() + sheet / SheetGroup::Sheets * this->Turns;
    const auto votes = [&](int bin)
    {
      bin = bin < 0 ? this->Turns - 1 : bin;
      return int{ bins[bin == this->Turns ? 0 : bin].of[sheet % SheetGroup::Sheets] };
    };
    const auto beside = [&](int bin) { return this->Smooth ? votes(bin) : 0; };
    int bin = 0;
    while (bin + 1 < this->Turns && beside(bin - 1) + votes(bin) + beside(bin + 1) != most)
    {
      ++bin;
    }
    VotePeak peak;
    peak.votes = most;
    peak.modelPoint = sheet / 2;
    peak.flip = sheet % 2 == 1;
    peak.alpha =
      (bin + 0.5 + (beside(bin + 1) - beside(bin - 1)) / static_cast<double>(peak.votes)) * 2.0 * M_PI / this->Turns;
    found.push_back(peak);
    sums[sheet] = 0;
  }
  return found;
}

int VoteAccumulator::votesFor(int modelPoint, bool flip, double alpha) const
{
  const int sheet = 2 * modelPoint + (flip ? 1 : 0);
  const SheetGroup* bins = this->Counts.data() + static_cast<std::size_t>(sheet / SheetGroup::Sheets) * this->Turns;
  const auto votes = [&](int bin)
  { return int{ bins[(bin + this->Turns) % this->Turns].of[sheet % SheetGroup::Sheets] }; };
  const double share = alpha / (2.0 * M_PI);
  const int bin = static_cast<int>((share - std::floor(share)) * this->Turns) % this->Turns;
  return this->Smooth ? votes(bin - 1) + votes(bin) + votes(bin + 1) : votes(bin);
}
}
