// SPDX-License-Identifier: BSD-3-Clause
// The whole online phase, from edge points to poses. The first argument of Scene is the number of threads, that of the
// others what grows: copies in the scene, or how finely the model is thinned.
#include "BenchmarkScene.h"

namespace
{
void estimate(benchmark::State& state, const scenes::Search& search, int threads)
{
  const meam::DetectionSettings settings = meam::detectionSettings(meam::Preset::Recommended, 0, threads);
  std::size_t poses = 0;
  for (auto _ : state)
  {
    poses = scenes::estimatePoses(search, settings).size();
  }
  state.counters["poses"] = static_cast<double>(poses);
}

void Scene(benchmark::State& state, scenes::SearchOf searchOf)
{
  scenes::withSearch(
    state, searchOf, [&](const scenes::Search& search) { estimate(state, search, static_cast<int>(state.range(0))); });
}
BENCHMARK_CAPTURE(Scene, bracket, scenes::bracketSearch)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Scene, tohoku, scenes::tohokuSearch)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void SceneByScenePoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfCopies(static_cast<int>(state.range(0)));
  estimate(state, search, 1);
  scenes::growsWith(state, search.seen.edges.size());
}
BENCHMARK(SceneByScenePoints)->ArgsProduct({ scenes::Copies })->UseRealTime()->Unit(benchmark::kMillisecond);

void SceneByModelPoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfThinned(static_cast<int>(state.range(0)));
  estimate(state, search, 1);
  scenes::growsWith(state, search.model.edges.size());
}
BENCHMARK(SceneByModelPoints)->ArgsProduct({ scenes::Leaves })->UseRealTime()->Unit(benchmark::kMillisecond);
}
