// SPDX-License-Identifier: BSD-3-Clause
// Keys and turns of pairs, as voting computes them, and one after the other with the functions of the library. Of
// Threads each computes all of them.
#include "BenchmarkScene.h"

#include "features/PairKeys.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace
{
constexpr int Block = 512;          // as voting takes them
constexpr int ReferenceStride = 16; // every so many points are references

/// Calls compute(reference, begin, end, keys, turns) for blocks of all pairs of some references.
template <typename Compute>
void run(benchmark::State& state, const meam::PointCloud& edges, Compute&& compute)
{
  const int count = static_cast<int>(edges.size());
  std::int64_t pairs = 0;
  int keys[Block];
  meam::PairTurn turns[Block];
  for (auto _ : state)
  {
    for (int r = 0; r < count; r += ReferenceStride)
    {
      const meam::PairFrame frame(edges.points[r], edges.tangents[r]);
      for (int begin = 0; begin < count; begin += Block)
      {
        compute(frame, begin, std::min(count, begin + Block), keys, turns);
        benchmark::DoNotOptimize(keys);
        benchmark::DoNotOptimize(turns);
        benchmark::ClobberMemory();
      }
      pairs += count;
    }
  }
  state.counters["pairs/s"] = benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kIsRate);
}

void computeKeys(benchmark::State& state, const scenes::Search& search)
{
  const meam::PairKeys pairs(search.edges().cloud.points, search.edges().cloud.tangents, search.model.quantizer());
  std::vector<int> blocks((search.edges().cloud.size() + meam::BlockedPoints::Size - 1) / meam::BlockedPoints::Size);
  std::iota(blocks.begin(), blocks.end(), 0);
  run(state, search.edges().cloud,
    [&](const meam::PairFrame& frame, int begin, int end, int* keys, meam::PairTurn* turns)
    {
      constexpr int size = meam::BlockedPoints::Size;
      pairs.compute(frame, blocks.data() + begin / size, (end - begin + size - 1) / size, keys, turns);
    });
}

void PairKeys(benchmark::State& state) { computeKeys(state, *scenes::bracketSearch()); }
BENCHMARK(PairKeys)->Threads(1)->Threads(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void PairKeysByScenePoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfCopies(static_cast<int>(state.range(0)));
  computeKeys(state, search);
  scenes::growsWith(state, search.edges().cloud.size());
}
BENCHMARK(PairKeysByScenePoints)->ArgsProduct({ scenes::Copies })->Unit(benchmark::kMillisecond);

void PairKeysOneByOne(benchmark::State& state)
{
  const scenes::Search& search = *scenes::bracketSearch();
  const meam::PointCloud& edges = search.edges().cloud;
  const meam::PairFeatureQuantizer quantizer = search.model.quantizer();
  run(state, edges,
    [&](const meam::PairFrame& frame, int begin, int end, int* keys, meam::PairTurn* turns)
    {
      const Eigen::Vector3f tangent = frame.Axes.col(0);
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Vector3f d = edges.points[i] - frame.Origin;
        const float length = d.norm();
        const float reference = tangent.dot(d);
        const float referred = edges.tangents[i].dot(d);
        const float sign = (reference < 0.0f) != (referred < 0.0f) ? -1.0f : 1.0f;
        meam::PairFeature feature;
        feature.distance = length;
        feature.referenceAngle = std::acos(std::min(std::abs(reference) / length, 1.0f));
        feature.referredAngle = std::acos(std::min(std::abs(referred) / length, 1.0f));
        feature.betweenAngle = std::acos(std::clamp(sign * tangent.dot(edges.tangents[i]), -1.0f, 1.0f));
        feature.rightHanded = sign * tangent.cross(edges.tangents[i]).dot(d) > 0.0f;
        keys[i - begin] = length > 0.0f ? quantizer.key(feature) : -1;
        const double turn = frame.angleOf(edges.points[i]) * (1 << meam::TurnBits) / (2.0 * M_PI);
        turns[i - begin] =
          (static_cast<int>(std::floor(turn + 0.5)) & meam::TurnMask) | (reference < 0.0f ? 1u << meam::TurnBits : 0u);
      }
    });
}
BENCHMARK(PairKeysOneByOne)->Unit(benchmark::kMillisecond);
}
