// SPDX-License-Identifier: BSD-3-Clause
#include "pose/DetectionSteps.h"

#include "TestGrids.h"

using meam::Features;
using meam::Preset;

TEST(DetectionSteps, TheRecommendedPresetLeavesFeaturesAndEdgesToTheUser)
{
  meam::DetectSettings chosen;
  chosen.features = Features::Surface;
  chosen.creases = false;
  EXPECT_EQ(meam::detectionSettings(chosen).detection.features, Features::Surface);
  const meam::SceneEdgeExtractionSettings edges = meam::sceneEdgeSettings(chosen);
  EXPECT_TRUE(edges.imageEdges && edges.depthEdges && edges.tangents);
  EXPECT_FALSE(edges.creases);
}

TEST(DetectionSteps, ThePaperHasItsOwn)
{
  meam::DetectSettings chosen;
  chosen.preset = Preset::Paper;
  EXPECT_EQ(meam::detectionSettings(chosen).detection.features, Features::Edges);
  const meam::SceneEdgeExtractionSettings edges = meam::sceneEdgeSettings(chosen);
  EXPECT_TRUE(edges.imageEdges);
  EXPECT_FALSE(edges.depthEdges || edges.creases || edges.tangents);
}

TEST(DetectionSteps, WhatIsNotChosenIsThePresets)
{
  for (int preset = 0; preset < meam::Presets; ++preset)
  {
    meam::DetectSettings chosen;
    chosen.preset = static_cast<Preset>(preset);
    const double share = meam::detectionSettings(chosen.preset).detection.referenceShare;
    EXPECT_EQ(meam::detectionSettings(chosen).detection.referenceShare, share);
    chosen.referenceShare = 0.5;
    EXPECT_EQ(meam::detectionSettings(chosen).detection.referenceShare, 0.5);
  }
}

TEST(DetectionSteps, LimitsSeedAndThreadsReachTheSteps)
{
  meam::DetectSettings chosen;
  chosen.maximumPoses = 3;
  chosen.minimumProbability = 0.25;
  chosen.seed = 7;
  chosen.threads = 2;
  const meam::DetectionSettings settings = meam::detectionSettings(chosen);
  EXPECT_EQ(settings.selection.maximumPoses, 3);
  EXPECT_EQ(settings.selection.minimumProbability, 0.25);
  EXPECT_EQ(settings.detection.seed, 7u);
  EXPECT_EQ(settings.screening->threads, 2);
  EXPECT_EQ(meam::sceneEdgeSettings(chosen).threads, 2);
}

TEST(DetectionSteps, FoundEdgesAreOfAScan)
{
  meam::ScanSource source;
  source.cloud = grids::surface(
    40, 40, [](int column, int) { return column < 20 ? 500.0 : 480.0; }, 0.2);
  for (Eigen::Vector3f& point : source.cloud.points)
  {
    point -= Eigen::Vector3f(19.5f, 19.5f, 0.0f); // the sensor looks at the middle
  }
  const std::size_t count = source.cloud.points.size();
  source.measured = [&](const meam::LocalCloud&) { return meam::Points(count, Eigen::Vector3f::Zero()); };
  const auto [scene, region, found, report] = meam::sceneOfScan(source, {});
  EXPECT_TRUE(scene.edges.fromScan);
  EXPECT_GT(found.cloud.size(), 30u) << "the step";
  EXPECT_EQ(scene.edges.cloud.size(), found.cloud.size());
  EXPECT_NEAR(scene.quality.noise, 0.2, 0.05);
  EXPECT_EQ(scene.measured.size(), count);
  EXPECT_EQ(report.find("The scan has no image: "), 0u) << report;
  source.edges = scene.edges;
  source.edges->fromScan = false;
  source.sensor = meam::Sensor();
  EXPECT_FALSE(meam::sceneOfScan(source, {}).scene.edges.fromScan);
}
