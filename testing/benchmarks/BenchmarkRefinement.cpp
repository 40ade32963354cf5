// SPDX-License-Identifier: BSD-3-Clause
// Refinement of verified poses: along lines and planes, and by PCL's point-to-point ICP, the paper's way. The first
// argument is the number of threads.
#include "BenchmarkScene.h"

namespace
{
void refine(benchmark::State& state, meam::PoseRefinementSettings settings)
{
  const scenes::Search& search = *scenes::bracketSearch();
  const meam::SceneIndex index(search.model, search.scene);
  const meam::Poses poses = meam::verifyPoses(meam::detectPoses(search.scene.edges, search.model), index);
  settings.threads = static_cast<int>(state.range(0));
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::refinePoses(poses, index, settings));
  }
  state.counters["poses/s"] =
    benchmark::Counter(static_cast<double>(poses.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void Refinement(benchmark::State& state) { refine(state, {}); }
BENCHMARK(Refinement)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void RefinementPointToPoint(benchmark::State& state) { refine(state, meam::paperRefinementSettings()); }
BENCHMARK(RefinementPointToPoint)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
}
