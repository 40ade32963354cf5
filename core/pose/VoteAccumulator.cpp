// SPDX-License-Identifier: BSD-3-Clause
#include "pose/VoteAccumulator.h"

#include "AllVectors.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
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

void VoteAccumulator::clear() { std::fill(this->Counts.begin(), this->Counts.end(), 0); }

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
