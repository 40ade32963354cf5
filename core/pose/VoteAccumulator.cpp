// SPDX-License-Identifier: BSD-3-Clause
#include "pose/VoteAccumulator.h"

#include "AllVectors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meam
{
namespace
{
constexpr int MostVotes = 21845; // of a bin: three fit into 16 bits
constexpr int Chunk = 512;       // bins that wait until they are counted
constexpr int Together = 16;     // sheets that are searched at once

/// One after the other, so that votes for one bin add up.
void count(const std::uint32_t* bins, int votes, bool mayOverflow, std::uint16_t* counts)
{
  if (!mayOverflow)
  {
    for (int k = 0; k < votes; ++k)
    {
      ++counts[bins[k]];
    }
    return;
  }
  for (int k = 0; k < votes; ++k)
  {
    counts[bins[k]] = static_cast<std::uint16_t>(counts[bins[k]] + (counts[bins[k]] < MostVotes ? 1 : 0));
  }
}

MEAM_ALL_VECTORS
void castVotes(const std::uint32_t* entries, const VoteBucket* buckets, int pairs, std::uint32_t turns, std::uint32_t stride,
  bool mayOverflow, std::uint16_t* counts)
{
  std::uint32_t bins[Chunk + VoteBlock];
  int waiting = 0;
  for (int pair = 0; pair < pairs; ++pair)
  {
    const VoteBucket& bucket = buckets[pair];
    const std::uint32_t turn = bucket.turn & TurnMask;
    const std::uint32_t sceneAgainst = bucket.turn >> TurnBits;
    for (std::uint32_t begin = bucket.begin; begin < bucket.end; begin += VoteBlock)
    {
      const std::uint32_t* entry = entries + begin;
      std::uint32_t* bin = bins + waiting;
#pragma omp simd
      for (int k = 0; k < VoteBlock; ++k) // also of entries after the bucket's end, which are not counted
      {
        const std::uint32_t flip = (begin + k >= bucket.against ? 1u : 0u) ^ sceneAgainst;
        const std::uint32_t sign = flip - 1; // all ones for a difference
        const std::uint32_t sum = (turn + ((entry[k] ^ sign) - sign)) & TurnMask;
        bin[k] = (entry[k] >> (TurnBits + 1)) * 2 * stride + flip * stride + 1 + ((sum * turns) >> TurnBits);
      }
      waiting += static_cast<int>(std::min<std::uint32_t>(VoteBlock, bucket.end - begin));
      if (waiting >= Chunk)
      {
        count(bins, waiting, mayOverflow, counts);
        waiting = 0;
      }
    }
  }
  count(bins, waiting, mayOverflow, counts);
}

/// Of three neighbours, the first of which is one of `count` bins.
MEAM_ALL_VECTORS
std::uint16_t largestSum(const std::uint16_t* bins, int count)
{
  std::uint16_t most = 0;
#pragma omp simd reduction(max : most)
  for (int k = 0; k < count; ++k)
  {
    most = std::max(most, static_cast<std::uint16_t>(bins[k] + bins[k + 1] + bins[k + 2]));
  }
  return most;
}
}

VoteAccumulator::VoteAccumulator(int modelPoints, double angleStep)
  : Turns(std::max(1u, static_cast<std::uint32_t>(std::lround(2.0 * M_PI / angleStep))))
  , Stride(this->Turns + 4)
  , Maxima((2 * modelPoints + Together - 1) / Together)
  , Counts(this->Maxima.size() * Together * this->Stride, 0)
{
}

void VoteAccumulator::clear()
{
  std::fill(this->Counts.begin(), this->Counts.end(), 0);
  this->Cast = 0;
}

void VoteAccumulator::vote(const std::uint32_t* entries, const VoteBucket* buckets, int count, int mostOfOne)
{
  this->Cast += static_cast<std::int64_t>(count) * mostOfOne;
  castVotes(entries, buckets, count, this->Turns, this->Stride, this->Cast > MostVotes, this->Counts.data());
}

std::vector<VotePeak> VoteAccumulator::peaks(int count)
{
  const int turns = static_cast<int>(this->Turns), stride = static_cast<int>(this->Stride);
  for (std::size_t group = 0; group < this->Maxima.size(); ++group)
  {
    std::uint16_t* rows = this->Counts.data() + group * Together * stride;
    for (std::uint16_t* row = rows; row < rows + Together * stride; row += stride)
    {
      row[0] = row[turns];
      row[turns + 1] = row[1];
    }
    this->Maxima[group] = largestSum(rows, (Together - 1) * stride + turns);
  }
  std::vector<VotePeak> found;
  while (static_cast<int>(found.size()) < count)
  {
    const auto best = std::max_element(this->Maxima.begin(), this->Maxima.end());
    if (best == this->Maxima.end() || *best == 0)
    {
      break;
    }
    const int first = static_cast<int>(best - this->Maxima.begin()) * Together;
    const std::uint16_t* rows = this->Counts.data() + static_cast<std::size_t>(first) * stride;
    std::array<std::uint16_t, Together> each;
    for (int sheet = 0; sheet < Together; ++sheet)
    {
      const bool taken = std::any_of(found.begin(), found.end(),
        [&](const VotePeak& other) { return 2 * other.modelPoint + (other.flip ? 1 : 0) == first + sheet; });
      each[sheet] = taken ? 0 : largestSum(rows + sheet * stride, turns);
    }
    const int sheet = static_cast<int>(std::find(each.begin(), each.end(), *best) - each.begin());
    const std::uint16_t* row = rows + sheet * stride;
    int bin = 0;
    while (row[bin] + row[bin + 1] + row[bin + 2] != *best)
    {
      ++bin;
    }
    VotePeak peak;
    peak.votes = *best;
    peak.modelPoint = (first + sheet) / 2;
    peak.flip = sheet % 2 == 1;
    peak.alpha = (bin + 0.5 + (row[bin + 2] - row[bin]) / static_cast<double>(peak.votes)) * 2.0 * M_PI / turns;
    found.push_back(peak);
    each[sheet] = 0;
    *best = *std::max_element(each.begin(), each.end());
  }
  return found;
}
}
