// SPDX-License-Identifier: BSD-3-Clause
#include "pose/DetectionChoices.h"

#include <gtest/gtest.h>

using meam::Features;
using meam::Preset;

TEST(DetectionChoices, TheRecommendedPresetLeavesFeaturesAndEdgesToTheUser)
{
  meam::DetectionChoices choices;
  choices.features = Features::Surface;
  choices.creases = false;
  EXPECT_EQ(meam::detectionSettings(choices).detection.features, Features::Surface);
  const meam::SceneEdgeExtractionSettings edges = meam::sceneEdgeSettings(choices);
  EXPECT_TRUE(edges.imageEdges && edges.depthEdges && edges.tangents);
  EXPECT_FALSE(edges.creases);
}

TEST(DetectionChoices, ThePaperHasItsOwn)
{
  meam::DetectionChoices choices;
  choices.preset = Preset::Paper;
  EXPECT_EQ(meam::detectionSettings(choices).detection.features, Features::Edges);
  const meam::SceneEdgeExtractionSettings edges = meam::sceneEdgeSettings(choices);
  EXPECT_TRUE(edges.imageEdges);
  EXPECT_FALSE(edges.depthEdges || edges.creases || edges.tangents);
}

TEST(DetectionChoices, WhatIsNotChosenIsThePresets)
{
  for (int preset = 0; preset < meam::Presets; ++preset)
  {
    meam::DetectionChoices choices;
    choices.preset = static_cast<Preset>(preset);
    const double share = meam::detectionSettings(choices.preset).detection.referenceShare;
    EXPECT_EQ(meam::detectionSettings(choices).detection.referenceShare, share);
    choices.referenceShare = 0.5;
    EXPECT_EQ(meam::detectionSettings(choices).detection.referenceShare, 0.5);
  }
}

TEST(DetectionChoices, LimitsSeedAndThreadsReachTheSteps)
{
  meam::DetectionChoices choices;
  choices.maximumPoses = 3;
  choices.minimumProbability = 0.25;
  choices.seed = 7;
  choices.threads = 2;
  const meam::DetectionSettings settings = meam::detectionSettings(choices);
  EXPECT_EQ(settings.selection.maximumPoses, 3);
  EXPECT_EQ(settings.selection.minimumProbability, 0.25);
  EXPECT_EQ(settings.detection.seed, 7u);
  EXPECT_EQ(settings.screening->threads, 2);
  EXPECT_EQ(meam::sceneEdgeSettings(choices).threads, 2);
}

TEST(DetectionChoices, APresentPartIsNeverLessLikelyForItsAbsence)
{
  meam::DetectionChoices choices;
  EXPECT_FALSE(meam::detectionSettings(choices).selection.partIsPresent);
  choices.partIsPresent = true;
  EXPECT_TRUE(meam::detectionSettings(choices).selection.partIsPresent);
}

TEST(DetectionChoices, FoundEdgesAreOfAScan)
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
