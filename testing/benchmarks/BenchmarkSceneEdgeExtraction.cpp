// SPDX-License-Identifier: BSD-3-Clause
// From a scan of 1280 x 1024 points and its image to edge points with tangents, thinned as for a search: the
// sample part in a simulated bin. The first argument is the noise of the depth in tenths of a millimetre at 1 m,
// the second the number of threads.
#include "features/TangentEstimation.h"
#include "mesh/ConvexHull.h"
#include "scene/preparation/BackgroundRemoval.h"
#include "scene/edges/SceneEdgeExtraction.h"
#include "simulation/BinScene.h"
#include "simulation/parts/SamplePart.h"

#include <benchmark/benchmark.h>

#include <map>

namespace
{
/// `baseline` in mm: of a camera beside the sensor; 0: the image is registered.
const meam::BinScene& bin(int tenths, double baseline = 0.0)
{
  static std::map<std::pair<int, double>, meam::BinScene> bins;
  const auto found = bins.find({ tenths, baseline });
  if (found != bins.end())
  {
    return found->second;
  }
  meam::BinSceneSettings settings;
  settings.width = 1280;
  settings.height = 1024;
  settings.baseline = baseline;
  settings.quality.depthNoise = 0.1 * tenths;
  return bins[{ tenths, baseline }] = meam::simulateBin(meam::makeSamplePart(), settings);
}

meam::ThinnedEdges edgesOf(const meam::BinScene& scene, const meam::SceneEdgeExtractionSettings& settings)
{
  static const double diameter = meam::diameter(meam::makeSamplePart().vertices);
  meam::TangentEstimationSettings tangents;
  tangents.threads = settings.threads;
  const meam::PointCloud edges = meam::extractSceneEdges(scene.cloud, scene.image, settings).cloud;
  return meam::estimateTangents(
    meam::toLocalCloud(edges, settings.threads), diameter, Eigen::Vector3d::UnitZ(), tangents);
}

void run(benchmark::State& state, meam::SceneEdgeExtractionSettings settings, double baseline = 0.0)
{
  const meam::BinScene& scene = bin(static_cast<int>(state.range(0)), baseline);
  settings.threads = static_cast<int>(state.range(1));
  std::size_t points = 0;
  for (auto _ : state)
  {
    points = edgesOf(scene, settings).indices.size();
  }
  state.counters["points"] = static_cast<double>(points);
}

void ImageEdges(benchmark::State& state) { run(state, {}); }
BENCHMARK(ImageEdges)->ArgsProduct({ { 1, 3, 10 }, { 1, 2 } })->UseRealTime()->Unit(benchmark::kMillisecond);

void ImageEdgesTangentsOfPoints(benchmark::State& state)
{
  meam::SceneEdgeExtractionSettings settings;
  settings.tangents = false;
  run(state, settings);
}
BENCHMARK(ImageEdgesTangentsOfPoints)
  ->ArgsProduct({ { 1, 3, 10 }, { 1, 2 } })
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

void ImageOfAnotherCamera(benchmark::State& state)
{
  constexpr double baseline = 60.0;
  meam::SceneEdgeExtractionSettings settings;
  settings.camera = bin(static_cast<int>(state.range(0)), baseline).camera;
  run(state, settings, baseline);
}
BENCHMARK(ImageOfAnotherCamera)->ArgsProduct({ { 3 }, { 1, 2 } })->UseRealTime()->Unit(benchmark::kMillisecond);

void DepthEdgesAndCreases(benchmark::State& state)
{
  meam::SceneEdgeExtractionSettings settings;
  settings.imageEdges = false;
  settings.depthEdges = true;
  settings.creases = true;
  run(state, settings);
}
BENCHMARK(DepthEdgesAndCreases)->ArgsProduct({ { 1, 3, 10 }, { 1, 2 } })->UseRealTime()->Unit(benchmark::kMillisecond);

void BackgroundRemoval(benchmark::State& state)
{
  const meam::BinScene& scene = bin(3);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meam::removeBackground(scene.cloud));
  }
}
BENCHMARK(BackgroundRemoval)->UseRealTime()->Unit(benchmark::kMillisecond);
}
