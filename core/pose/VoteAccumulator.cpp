// SPDX-License-Identifier: BSD-3-Clause
#include "pose/VoteAccumulator.h"

#include "AllVectors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace meam
{
namespace
{
constexpr int MostVotes = 21845; // of a bin: three fit into 16 bits
constexpr int Chunk = 512;       // bins that wait until they are counted

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

constexpr int Lanes = 16;
using Bins = std::uint16_t __attribute__((vector_size(Lanes * sizeof(std::uint16_t))));

[[gnu::always_inline]] inline Bins load(const std::uint16_t* bins)
{
  Bins result;
  std::memcpy(&result, bins, sizeof(result));
  return result;
}

[[gnu::always_inline]] inline Bins larger(const Bins& a, const Bins& b) { return a > b ? a : b; }

/// Of each row of bins, which starts and ends with a copy of the last and the first, the largest sum of three neighbours.
MEAM_ALL_VECTORS
void findMaxima(const std::uint16_t* counts, std::size_t sheets, int turns, std::uint16_t* maxima)
{
  for (std::size_t sheet = 0; sheet < sheets; ++sheet)
  {
    const std::uint16_t* row = counts + sheet * (turns + 2);
    std::uint16_t most = 0;
    if (turns < Lanes)
    {
      for (int bin = 0; bin < turns; ++bin)
      {
        most = std::max(most, static_cast<std::uint16_t>(row[bin] + row[bin + 1] + row[bin + 2]));
      }
    }
    else
    {
      Bins sums = {};
      for (int begin = 0; begin < turns; begin += Lanes)
      {
        const std::uint16_t* bins = row + std::min(begin, turns - Lanes); // the last block overlaps the one before
        sums = larger(sums, load(bins) + load(bins + 1) + load(bins + 2));
      }
      sums = larger(sums, __builtin_shufflevector(sums, sums, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7));
      sums = larger(sums, __builtin_shufflevector(sums, sums, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3));
      sums = larger(sums, __builtin_shufflevector(sums, sums, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1));
      most = std::max(sums[0], sums[1]);
    }
    maxima[sheet] = most;
  }
}

/// Their largest, 0 of none.
MEAM_ALL_VECTORS
std::uint16_t largest(const std::uint16_t* values, std::size_t count)
{
  std::uint16_t most = 0;
#pragma omp simd reduction(max : most)
  for (std::size_t k = 0; k < count; ++k)
  {
    most = std::max(most, values[k]);
  }
  return most;
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
  for (std::size_t begin = 0; begin < this->Counts.size(); begin += this->Stride)
  {
    std::uint16_t* row = this->Counts.data() + begin;
    row[0] = row[this->Turns];
    row[this->Turns + 1] = row[1];
  }
  findMaxima(this->Counts.data(), this->Maxima.size(), static_cast<int>(this->Turns), this->Maxima.data());
  std::vector<VotePeak> found;
  for (int k = 0; k < count; ++k)
  {
    const std::uint16_t most = largest(this->Maxima.data(), this->Maxima.size());
    if (most == 0)
    {
      break;
    }
    const auto best = std::find(this->Maxima.begin(), this->Maxima.end(), most);
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
