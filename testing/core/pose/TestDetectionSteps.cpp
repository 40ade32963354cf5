// SPDX-License-Identifier: BSD-3-Clause
#include "pose/DetectionSteps.h"

#include <gtest/gtest.h>

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
  meam::SceneEdges found;
  for (int i = 0; i < 10; ++i)
  {
    found.cloud.points.emplace_back(i, 0.1f * i * i, 0.0f);
  }
  found.quality.noise = 0.2;
  meam::SceneInput scene;
  meam::setFoundEdges(found, 1, scene);
  EXPECT_TRUE(scene.edges.fromScan);
  EXPECT_EQ(scene.edges.cloud.size(), 10u);
  EXPECT_EQ(scene.quality.noise, 0.2);
}
