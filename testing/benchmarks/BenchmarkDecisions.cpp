// SPDX-License-Identifier: BSD-3-Clause
// A scene of the Tohoku dataset with one decision of the online phase changed at a time; docs/evaluation.md has what
// each is worth. One thread.
#include "BenchmarkScene.h"
#include "baselines/BaselineSettings.h"

namespace
{
using Settings = meam::DetectionSettings;

void Decision(benchmark::State& state, void (*change)(Settings&))
{
  const scenes::Search* search = scenes::tohokuSearch();
  if (!search)
  {
    return scenes::skip(state);
  }
  Settings settings = meam::detectionSettings(meam::Preset::Recommended, 0, 1);
  change(settings);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(scenes::estimatePoses(*search, settings));
  }
}

#define MEAM_DECISION(name, statement)                                                                                 \
  BENCHMARK_CAPTURE(Decision, name, [](Settings& settings) { statement; })->UseRealTime()->Unit(benchmark::kMillisecond)

MEAM_DECISION(none, (void)settings);
MEAM_DECISION(p_ref_5, settings.detection.referenceShare = 0.05);
MEAM_DECISION(p_ref_2, settings.detection.referenceShare = 0.02);
MEAM_DECISION(p_ref_1, settings.detection.referenceShare = 0.01);
MEAM_DECISION(two_peaks, settings.detection.peaksPerReference = 2);
MEAM_DECISION(candidates_15, settings.candidateSelection.maximumPoses = 15);
MEAM_DECISION(candidates_25, settings.candidateSelection.maximumPoses = 25);
MEAM_DECISION(one_of_an_instance, settings.candidateSelection.alternatives = 1);
MEAM_DECISION(
  edge_coverage,
  settings.candidateVerification.method = settings.verification.method = meam::VerificationMethod::EdgeCoverage;
  settings.candidateSelection.method = settings.selection.method = meam::SelectionMethod::Clusters);
MEAM_DECISION(point_to_point, settings.refinement = meam::paperRefinementSettings(); settings.refinement.threads = 1);
}
