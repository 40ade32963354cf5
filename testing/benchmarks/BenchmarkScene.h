// SPDX-License-Identifier: BSD-3-Clause
// What the benchmarks share: brackets on a table and, where it is there, a scene of the Tohoku dataset.
#pragma once

#include "../core/TestScene.h"

#include <benchmark/benchmark.h>

namespace scenes
{
/// A part and a scene of it.
struct Search
{
  const meam::TrainedModel& model;
  const meam::Scene& scene;
  const Seen& seen; ///< what it is made of; its edges have no tangents yet

  const meam::LocalCloud& edges() const { return this->scene.edges; }
};

/// The whole online phase, from what the sensor saw, as a filter has it.
inline meam::Poses estimatePoses(const Search& search, const meam::DetectionSettings& settings)
{
  return estimatePoses(search.model, search.seen, settings);
}

/// What the first steps of the online phase come to, one thread, in the local frame.
struct Candidates
{
  explicit Candidates(const Search& search)
    : settings(meam::detectionSettings(meam::Preset::Recommended, 0, 1))
    , detected(meam::detectPoses(search.edges(), search.model, this->settings.detection))
    , screened(meam::screenPoses(this->detected, search.scene, search.model, *this->settings.screening))
  {
    const auto& [model, scene, seen] = search;
    this->alternatives = meam::verifyPoses(this->screened, scene, model, this->settings.candidateVerification);
    this->alternatives = meam::selectPoses(this->alternatives, scene, model, this->settings.candidateSelection);
    this->refined = meam::refinePoses(this->alternatives, scene, model, this->settings.refinement);
    this->refined = meam::verifyPoses(this->refined, scene, model, this->settings.verification);
  }

  meam::DetectionSettings settings;
  meam::Poses detected;
  meam::Poses screened;
  meam::Poses alternatives; ///< of the screened ones, verified, those to be refined
  meam::Poses refined;      ///< and verified again
};

/// Copies of the bracket on a table, far enough from each other that no pair of points joins two; the bracket as it is
/// trained by default.
Search searchOfCopies(int copies);

/// Twelve copies; the bracket trained with edge points thinned to one in a cube of `tenths` of a millimetre.
Search searchOfThinned(int tenths);

/// Twelve copies.
const Search* bracketSearch();

/// Part 1 and scene 0 of the dataset in $PPFMEAM_DATA/tohoku; null without it.
const Search* tohokuSearch();

/// Tells what a benchmark's time grows with, for slopes.py.
inline void growsWith(benchmark::State& state, std::size_t points)
{
  state.counters["points"] = static_cast<double>(points);
}

/// Skips a benchmark for want of data.
inline void skip(benchmark::State& state) { state.SkipWithError("no Tohoku dataset: set PPFMEAM_DATA"); }

using SearchOf = const Search* (*)();

/// Calls work(search), or skips the benchmark for want of data.
template <typename Work>
void withSearch(benchmark::State& state, SearchOf searchOf, Work&& work)
{
  if (const Search* search = searchOf())
  {
    work(*search);
  }
  else
  {
    skip(state);
  }
}

/// Copies in a scene, for what grows with the scene.
inline const std::vector<std::int64_t> Copies{ 3, 6, 12, 24, 48 };

/// Tenths of a millimetre, for what grows with the model.
inline const std::vector<std::int64_t> Leaves{ 40, 28, 20, 14, 10 };
}
