// SPDX-License-Identifier: BSD-3-Clause
// The limits of voting: a vote reads an entry of 4 bytes in the order of the table, and adds 1 to a bin of 2 bytes
// anywhere in the accumulator. Both alone, on arrays of the sizes that voting has.
#include "BenchmarkScene.h"

#include "base/AllVectors.h"

#include <random>

namespace
{
using SearchOf = const scenes::Search* (*)();

MEAM_ALL_VECTORS
std::uint32_t sum(const std::uint32_t* values, std::size_t count)
{
  std::uint32_t total = 0;
#pragma omp simd reduction(+ : total)
  for (std::size_t k = 0; k < count; ++k)
  {
    total += values[k];
  }
  return total;
}

void ReadEntries(benchmark::State& state, SearchOf searchOf)
{
  const scenes::Search* search = searchOf();
  if (!search)
  {
    return scenes::skip(state);
  }
  const std::vector<std::uint32_t>& votes = search->model.table.votes;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(sum(votes.data(), votes.size()));
  }
  state.counters["MB"] = 1e-6 * votes.size() * sizeof(votes[0]);
  state.counters["entries/s"] =
    benchmark::Counter(static_cast<double>(votes.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(ReadEntries, bracket, scenes::bracketSearch)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ReadEntries, tohoku, scenes::tohokuSearch)->Unit(benchmark::kMicrosecond);

void increment(benchmark::State& state, std::size_t size)
{
  constexpr int places = 1 << 14; // that are read again and again
  std::vector<std::uint16_t> counts(size, 0);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::uint32_t> anywhere(0, static_cast<std::uint32_t>(size - 1));
  std::vector<std::uint32_t> bins(places);
  for (std::uint32_t& bin : bins)
  {
    bin = anywhere(random);
  }
  for (auto _ : state)
  {
    for (int k = 0; k < places; ++k)
    {
      ++counts[bins[k]];
    }
    benchmark::ClobberMemory();
  }
  state.counters["MB"] = 1e-6 * size * sizeof(counts[0]);
  state.counters["increments/s"] =
    benchmark::Counter(static_cast<double>(places), benchmark::Counter::kIsIterationInvariantRate);
}

void Increments(benchmark::State& state, SearchOf searchOf)
{
  const scenes::Search* search = searchOf();
  if (!search)
  {
    return scenes::skip(state);
  }
  increment(
    state, search->model.table.votingPoints * static_cast<std::size_t>(2 * 360.0 / search->model.settings.angleStep));
}
BENCHMARK_CAPTURE(Increments, bracket, scenes::bracketSearch)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Increments, tohoku, scenes::tohokuSearch)->Unit(benchmark::kMicrosecond);

void IncrementsInFirstCache(benchmark::State& state) { increment(state, 4096); }
BENCHMARK(IncrementsInFirstCache)->Unit(benchmark::kMicrosecond);
}
