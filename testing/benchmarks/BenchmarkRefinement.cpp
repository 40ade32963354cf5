// SPDX-License-Identifier: BSD-3-Clause
// Refinement of verified poses: along lines and planes, and by PCL's point-to-point ICP, the paper's way; selection of
// one for each instance, with its final alignment. The first argument is the number of threads, of By... what grows.
#include "BenchmarkScene.h"
#include "baselines/BaselineSettings.h"

namespace
{
void refine(benchmark::State& state, const scenes::Search& search, meam::PoseRefinementSettings settings, int threads)
{
  const meam::Poses poses = scenes::Candidates(search).alternatives;
  settings.threads = threads;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::refinePoses(poses, search.scene, search.model, settings));
  }
  state.counters["poses/s"] =
    benchmark::Counter(static_cast<double>(poses.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void Refinement(benchmark::State& state)
{
  refine(state, *scenes::bracketSearch(), {}, static_cast<int>(state.range(0)));
}
BENCHMARK(Refinement)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void RefinementPointToPoint(benchmark::State& state)
{
  refine(state, *scenes::bracketSearch(), meam::paperRefinementSettings(), static_cast<int>(state.range(0)));
}
BENCHMARK(RefinementPointToPoint)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void RefinementByScenePoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfCopies(static_cast<int>(state.range(0)));
  refine(state, search, {}, 1);
  scenes::growsWith(state, search.edges().cloud.size());
}
BENCHMARK(RefinementByScenePoints)->ArgsProduct({ scenes::Copies })->UseRealTime()->Unit(benchmark::kMillisecond);

void RefinementByModelPoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfThinned(static_cast<int>(state.range(0)));
  refine(state, search, {}, 1);
  scenes::growsWith(state, search.model.edges.size());
}
BENCHMARK(RefinementByModelPoints)->ArgsProduct({ scenes::Leaves })->UseRealTime()->Unit(benchmark::kMillisecond);

void select(benchmark::State& state, const scenes::Search& search, int threads)
{
  const meam::Poses poses = scenes::Candidates(search).refined;
  meam::PoseSelectionSettings settings;
  settings.threads = threads;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::selectPoses(poses, search.scene, search.model, settings));
  }
  state.counters["poses/s"] =
    benchmark::Counter(static_cast<double>(poses.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void Selection(benchmark::State& state) { select(state, *scenes::bracketSearch(), static_cast<int>(state.range(0))); }
BENCHMARK(Selection)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void SelectionByScenePoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfCopies(static_cast<int>(state.range(0)));
  select(state, search, 1);
  scenes::growsWith(state, search.edges().cloud.size());
}
BENCHMARK(SelectionByScenePoints)->ArgsProduct({ scenes::Copies })->UseRealTime()->Unit(benchmark::kMillisecond);
}
