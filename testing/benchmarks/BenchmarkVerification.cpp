// SPDX-License-Identifier: BSD-3-Clause
// Verification of the raw candidates; the index of the scene, which all steps share, on its own.
#include "BenchmarkScene.h"

namespace
{
void verify(benchmark::State& state, const scenes::Search& search, int threads)
{
  const meam::Poses candidates = meam::detectPoses(search.scene.edges, search.model);
  const meam::SceneIndex index(search.model, search.scene);
  meam::PoseVerificationSettings settings;
  settings.threads = threads;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::verifyPoses(candidates, index, settings));
  }
  state.counters["poses/s"] =
    benchmark::Counter(static_cast<double>(candidates.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void Verification(benchmark::State& state)
{
  verify(state, *scenes::bracketSearch(), static_cast<int>(state.range(0)));
}
BENCHMARK(Verification)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void VerificationByScenePoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfCopies(static_cast<int>(state.range(0)));
  verify(state, search, 1);
  scenes::growsWith(state, search.scene.edges.size());
}
BENCHMARK(VerificationByScenePoints)->ArgsProduct({ scenes::Copies })->UseRealTime()->Unit(benchmark::kMillisecond);

void VerificationByModelPoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfThinned(static_cast<int>(state.range(0)));
  verify(state, search, 1);
  scenes::growsWith(state, search.model.edges.size());
}
BENCHMARK(VerificationByModelPoints)->ArgsProduct({ scenes::Leaves })->UseRealTime()->Unit(benchmark::kMillisecond);

void SceneIndexByScenePoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfCopies(static_cast<int>(state.range(0)));
  for (auto _ : state)
  {
    const meam::SceneIndex index(search.model, search.scene);
    benchmark::DoNotOptimize(&index);
  }
  scenes::growsWith(state, search.scene.surface.size());
}
BENCHMARK(SceneIndexByScenePoints)->ArgsProduct({ scenes::Copies })->Unit(benchmark::kMillisecond);
}
