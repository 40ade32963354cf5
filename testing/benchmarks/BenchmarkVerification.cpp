// SPDX-License-Identifier: BSD-3-Clause
// Screening of the raw candidates, verification of those that stay, and the preparation of the scene, which all steps
// share. The first argument is the number of threads, of By... what grows.
#include "BenchmarkScene.h"

namespace
{
void posesPerSecond(benchmark::State& state, std::size_t poses)
{
  state.counters["poses/s"] =
    benchmark::Counter(static_cast<double>(poses), benchmark::Counter::kIsIterationInvariantRate);
}

void screen(benchmark::State& state, const scenes::Search& search, int threads)
{
  const scenes::Candidates candidates(search);
  meam::PoseScreeningSettings settings = *candidates.settings.screening;
  settings.threads = threads;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::screenPoses(candidates.detected, search.scene, search.model, settings));
  }
  posesPerSecond(state, candidates.detected.size());
}

void Screening(benchmark::State& state) { screen(state, *scenes::bracketSearch(), static_cast<int>(state.range(0))); }
BENCHMARK(Screening)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void ScreeningByScenePoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfCopies(static_cast<int>(state.range(0)));
  screen(state, search, 1);
  scenes::growsWith(state, search.edges().cloud.size());
}
BENCHMARK(ScreeningByScenePoints)->ArgsProduct({ scenes::Copies })->UseRealTime()->Unit(benchmark::kMillisecond);

void verify(benchmark::State& state, const scenes::Search& search, int threads)
{
  const scenes::Candidates candidates(search);
  meam::PoseVerificationSettings settings = candidates.settings.candidateVerification;
  settings.threads = threads;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::verifyPoses(candidates.screened, search.scene, search.model, settings));
  }
  posesPerSecond(state, candidates.screened.size());
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
  scenes::growsWith(state, search.edges().cloud.size());
}
BENCHMARK(VerificationByScenePoints)->ArgsProduct({ scenes::Copies })->UseRealTime()->Unit(benchmark::kMillisecond);

void VerificationByModelPoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfThinned(static_cast<int>(state.range(0)));
  verify(state, search, 1);
  scenes::growsWith(state, search.model.edges.size());
}
BENCHMARK(VerificationByModelPoints)->ArgsProduct({ scenes::Leaves })->UseRealTime()->Unit(benchmark::kMillisecond);

void ScenePreparationByScenePoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfCopies(static_cast<int>(state.range(0)));
  const meam::Points measured = meam::toLocalPoints(search.seen.surface, search.scene.T_local_scene());
  meam::SceneSettings settings;
  settings.threads = 1;
  for (auto _ : state)
  {
    const meam::Scene scene(search.edges(), measured, search.seen.sensor, search.model.diameter, settings);
    benchmark::DoNotOptimize(&scene);
  }
  scenes::growsWith(state, measured.size());
}
BENCHMARK(ScenePreparationByScenePoints)->ArgsProduct({ scenes::Copies })->Unit(benchmark::kMillisecond);
}
