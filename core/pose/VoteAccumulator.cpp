// SPDX-License-Identifier: BSD-3-Clause
#include "pose/VoteAccumulator.h"

#include "AllVectors.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr int MostVotes = 21845; // of a bin: three fit into 16 bits
constexpr int Chunk = 256;       // votes whose bins are computed at once

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
void castVotes(const std::uint32_t* entries, const VoteBucket* buckets, int pairs, std::uint32_t turns, bool mayOverflow,
  std::uint16_t* counts)
{
  const std::uint32_t stride = turns + 2;
  std::uint32_t bins[Chunk];
  for (int pair = 0; pair < pairs; ++pair)
  {
    const VoteBucket& bucket = buckets[pair];
    const std::uint32_t turn = bucket.turn & TurnMask;
    const std::uint32_t sceneAgainst = bucket.turn >> TurnBits;
    for (std::uint32_t half = 0; half < 2; ++half)
    {
      const std::uint32_t flip = half ^ sceneAgainst;
      const std::uint32_t sign = flip - 1; // all ones for a difference
      const std::uint32_t sheet = flip * stride + 1;
      const std::uint32_t end = half ? bucket.end : bucket.against;
      for (std::uint32_t begin = half ? bucket.against : bucket.begin; begin < end; begin += Chunk)
      {
        const int votes = static_cast<int>(std::min<std::uint32_t>(Chunk, end - begin));
        const std::uint32_t* entry = entries + begin;
#pragma omp simd
        for (int k = 0; k < votes; ++k)
        {
          const std::uint32_t sum = (turn + ((entry[k] ^ sign) - sign)) & TurnMask;
          bins[k] = (entry[k] >> (TurnBits + 1)) * 2 * stride + sheet + ((sum * turns) >> TurnBits);
        }
        count(bins, votes, mayOverflow, counts);
      }
    }
  }
}

MEAM_ALL_VECTORS
void findMaxima(std::uint16_t* counts, std::size_t sheets, int turns, std::uint16_t* maxima)
{
  for (std::size_t sheet = 0; sheet < sheets; ++sheet)
  {
    std::uint16_t* row = counts + sheet * (turns + 2);
    row[0] = row[turns];
    row[turns + 1] = row[1];
    std::uint16_t most = 0;
#pragma omp simd reduction(max : most)
    for (int bin = 0; bin < turns; ++bin)
    {
      most = std::max(most, static_cast<std::uint16_t>(row[bin] + row[bin + 1] + row[bin + 2]));
    }
    maxima[sheet] = most;
  }
}
}

VoteAccumulator::VoteAccumulator(int modelPoints, double angleStep)
  : Turns(std::max(1u, static_cast<std::uint32_t>(std::lround(2.0 * M_PI / angleStep))))
  , Stride(this->Turns + 2)
  , Counts(static_cast<std::size_t>(modelPoints) * 2 * this->Stride, 0)
  , Maxima(static_cast<std::size_t>(modelPoints) * 2)
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
  castVotes(entries, buckets, count, this->Turns, this->Cast > MostVotes, this->Counts.data());
}

std::vector<VotePeak> VoteAccumulator::peaks(int count)
{
  findMaxima(this->Counts.data(), this->Maxima.size(), static_cast<int>(this->Turns), this->Maxima.data());
  std::vector<VotePeak> found;
  for (int k = 0; k < count; ++k)
  {
    const auto best = std::max_element(this->Maxima.begin(), this->Maxima.end());
    if (best == this->Maxima.end() || *best == 0)
    {
      break;
    }
    const std::size_t sheet = best - this->Maxima.begin();
    const std::uint16_t* row = this->Counts.data() + sheet * this->Stride;
    VotePeak peak;
    for (std::uint32_t bin = 0; bin < this->Turns && peak.votes == 0; ++bin)
    {
      if (row[bin] + row[bin + 1] + row[bin + 2] == *best)
      {
        peak.votes = *best;
        peak.modelPoint = static_cast<int>(sheet / 2);
        peak.flip = sheet % 2 == 1;
        peak.alpha = (bin + 0.5 + (row[bin + 2] - row[bin]) / static_cast<double>(peak.votes)) * 2.0 * M_PI / this->Turns;
      }
    }
    found.push_back(peak);
    *best = 0;
  }
  return found;
}
}
