// SPDX-License-Identifier: BSD-3-Clause
// Refinement of verified poses: along lines and planes, and by PCL's point-to-point ICP, the paper's way. The first
// argument is the number of threads, of By... what grows.
#include "BenchmarkScene.h"

namespace
{
void refine(benchmark::State& state, const scenes::Search& search, meam::PoseRefinementSettings settings, int threads)
{
  const meam::SceneIndex index(search.model, search.scene);
  const meam::Poses poses = meam::verifyPoses(meam::detectPoses(search.scene.edges, search.model), index);
  settings.threads = threads;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::refinePoses(poses, index, settings));
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
  scenes::growsWith(state, search.scene.edges.size());
}
BENCHMARK(RefinementByScenePoints)->ArgsProduct({ scenes::Copies })->UseRealTime()->Unit(benchmark::kMillisecond);

void RefinementByModelPoints(benchmark::State& state)
{
  const scenes::Search search = scenes::searchOfThinned(static_cast<int>(state.range(0)));
  refine(state, search, {}, 1);
  scenes::growsWith(state, search.model.edges.size());
}
BENCHMARK(RefinementByModelPoints)->ArgsProduct({ scenes::Leaves })->UseRealTime()->Unit(benchmark::kMillisecond);
}
