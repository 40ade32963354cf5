// SPDX-License-Identifier: BSD-3-Clause
// Voting, verification and refinement on a scene of brackets, and voting as a hash map of structs does it:
//   meamBenchmarks --benchmark_counters_tabular=true
// Compare rows of one run only.
#include "../core/TestScene.h"

#include "PointGrid.h"

#include <benchmark/benchmark.h>

#include <unordered_map>

namespace
{
const meam::Scene& scene()
{
  static const meam::Scene seen = []
  {
    std::vector<Eigen::Isometry3d> poses;
    for (int i = 0; i < 12; ++i)
    {
      poses.push_back(scenes::lying(80.0 * (i % 4), 80.0 * (i / 4), 37.0 * i, i % 2 == 0));
    }
    return scenes::withTangents(scenes::seenFromAbove(poses));
  }();
  return seen;
}

meam::PoseDetectionSettings settings(int threads)
{
  meam::PoseDetectionSettings result;
  result.threads = threads;
  return result;
}

/// Votes that the scene's pairs cast, for a rate that both ways of voting share.
double numberOfVotes()
{
  static const double votes = []
  {
    const meam::TrainedModel& model = scenes::bracket();
    const meam::PairFeatureQuantizer quantizer = model.quantizer();
    const auto& edges = scene().edges;
    const meam::PointGrid grid(edges.points, model.diameter);
    double sum = 0.0;
    for (std::size_t r = 0; r < edges.size(); ++r)
    {
      grid.forEachWithin(edges.points[r], model.diameter,
        [&](int i, float)
        {
          const int key = quantizer.key(meam::pairFeature(
            quantizer.kind(), edges.points[r], edges.tangents[r], edges.points[i], edges.tangents[i]));
          sum += key < 0 || i == static_cast<int>(r) ? 0 : model.table.offsets[key + 1] - model.table.offsets[key];
        });
    }
    return sum * settings(1).referenceShare;
  }();
  return votes;
}

void Voting(benchmark::State& state)
{
  numberOfVotes(); // the part is trained and the scene made before the clock starts
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(
      meam::detectPoses(scene().edges, scenes::bracket(), settings(static_cast<int>(state.range(0)))));
  }
  state.counters["votes/s"] = benchmark::Counter(numberOfVotes(), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(Voting)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/// The peer: a hash map from the key to a list of pairs, an angle computed for each vote.
void VotingByHashMap(benchmark::State& state)
{
  const meam::TrainedModel& model = scenes::bracket();
  const meam::PairFeatureQuantizer quantizer = model.quantizer();
  struct Pair
  {
    std::uint32_t reference;
    float angle;
    bool against;
  };
  std::unordered_map<int, std::vector<Pair>> table;
  for (int key = 0; key < quantizer.numberOfKeys(); ++key)
  {
    for (std::uint32_t k = model.table.offsets[key]; k < model.table.offsets[key + 1]; ++k)
    {
      const std::uint32_t r = model.table.references[k];
      const Eigen::Vector3f d = model.edges.points[model.table.referreds[k]] - model.edges.points[r];
      table[key].push_back({ r, model.table.angles[k], model.edges.tangents[r].dot(d) < 0.0f });
    }
  }
  const auto& edges = scene().edges;
  const meam::PointGrid grid(edges.points, 0.5 * model.diameter);
  const int stride = static_cast<int>(std::lround(1.0 / settings(1).referenceShare));
  std::vector<int> counts;
  for (auto _ : state)
  {
    for (std::size_t r = 0; r < edges.size(); r += stride)
    {
      counts.assign(model.edges.size() * 2 * 50, 0);
      const meam::TangentFrame frame(edges.points[r], edges.tangents[r]);
      grid.forEachWithin(edges.points[r], model.diameter,
        [&](int i, float)
        {
          const int key = quantizer.key(meam::pairFeature(
            quantizer.kind(), edges.points[r], edges.tangents[r], edges.points[i], edges.tangents[i]));
          const auto bucket = table.find(key);
          if (bucket == table.end() || i == static_cast<int>(r))
          {
            return;
          }
          const float angle = frame.angleOf(edges.points[i]);
          for (const Pair& pair : bucket->second)
          {
            const bool flip = pair.against != frame.against(edges.points[i]);
            double alpha = std::fmod((flip ? angle + pair.angle : angle - pair.angle) + 4.0 * M_PI, 2.0 * M_PI);
            ++counts[(pair.reference * 2 + flip) * 50 + static_cast<int>(alpha * 50 / (2.0 * M_PI)) % 50];
          }
        });
      benchmark::DoNotOptimize(*std::max_element(counts.begin(), counts.end()));
    }
  }
  state.counters["votes/s"] = benchmark::Counter(numberOfVotes(), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(VotingByHashMap)->UseRealTime()->Unit(benchmark::kMillisecond);

void Verification(benchmark::State& state)
{
  const meam::Poses candidates = meam::detectPoses(scene().edges, scenes::bracket());
  meam::PoseVerificationSettings verification;
  verification.threads = static_cast<int>(state.range(0));
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::verifyPoses(candidates, scenes::bracket(), scene(), verification));
  }
  state.counters["poses/s"] =
    benchmark::Counter(static_cast<double>(candidates.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(Verification)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void Refinement(benchmark::State& state)
{
  const meam::Poses candidates =
    meam::verifyPoses(meam::detectPoses(scene().edges, scenes::bracket()), scenes::bracket(), scene());
  meam::PoseRefinementSettings refinement;
  refinement.threads = static_cast<int>(state.range(0));
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::refinePoses(candidates, scenes::bracket(), scene(), refinement));
  }
  state.counters["poses/s"] =
    benchmark::Counter(static_cast<double>(candidates.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(Refinement)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK_MAIN();
