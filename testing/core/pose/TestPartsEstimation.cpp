// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PartsEstimation.h"

#include "TestScene.h"
#include "TestSteps.h"

namespace
{
meam::TriangleMesh blockOnCorner() { return parts::blockOnPlate(false); }

meam::WorkCounts workOf(const meam::TrainedModel& model, const meam::SceneInput& input, int asked)
{
  meam::DetectionReport report;
  meam::estimatePoses(model, input, meam::detectionSettings(meam::Preset::Recommended, asked), &report);
  return report.work;
}
}

TEST(PartsEstimation, TwoTypesTakeTheWorkOfEachWhereAllCopiesAreFewerThanAsked)
{
  const meam::TrainedModel &bracket = scenes::bracket(), &plate = scenes::trained<blockOnCorner>();
  const meam::SceneInput input = scenes::inputOf(scenes::seenFromAbove(
    { { parts::lBracket(), scenes::lying(0, 0, 20) }, { blockOnCorner(), scenes::lying(90, 10, 131) } }));
  meam::DetectionReport report;
  const std::vector<meam::PartPose> found =
    meam::estimateParts({ &bracket, &plate }, input, meam::detectionSettings(meam::Preset::Recommended, 5), &report);
  for (const int part : { 0, 1 })
  {
    EXPECT_GT(meam::posesOfPart(found, part).poses.at(0).placeProbability, 0.5) << part;
  }
  meam::WorkCounts each = workOf(bracket, input, 5);
  each += workOf(plate, input, 5);
  EXPECT_EQ(report.work.references, each.references);
  EXPECT_EQ(report.work.verified, each.verified);
  EXPECT_EQ(report.work.selected, each.selected);
}

TEST(PartsEstimation, TwoTypesEndTheirSearchTogetherWhereTheyHaveEnough)
{
  const meam::TrainedModel &bracket = scenes::bracket(), &plate = scenes::trained<blockOnCorner>();
  std::vector<scenes::Copy> copies;
  for (const double y : { -70.0, 0.0, 70.0 })
  {
    copies.push_back({ parts::lBracket(), scenes::lying(0, y, 20 + y) });
    copies.push_back({ blockOnCorner(), scenes::lying(90, y + 10, 131 - y) });
  }
  const meam::SceneInput input = scenes::inputOf(scenes::seenFromAbove(copies));
  const int asked = 3; // and two more: of each type alone there are too few
  meam::DetectionReport report;
  std::vector<meam::PartPose> found;
  steps::expectProgress(
    [&](const meam::Progress& progress)
    {
      found = meam::estimateParts(
        { &bracket, &plate }, input, meam::detectionSettings(meam::Preset::Recommended, asked), &report, progress);
    });
  ASSERT_EQ(found.size(), 3u);
  for (const meam::PartPose& one : found)
  {
    EXPECT_GT(one.pose.placeProbability, 0.9);
  }
  EXPECT_LT(2 * report.work.references, workOf(bracket, input, asked).references);
}

TEST(PartsEstimation, ATypeOfWhichTheScanShowsNothingIsLeftOut)
{
  meam::SceneInput input = scenes::inputOf(scenes::seenFromAbove({ { parts::lBracket(), scenes::lying(0, 0, 20) } }));
  input.edges.fromScan = true;
  const double farAway = 2000.0; // mm: the scan is large enough for the other type
  input.measured.emplace_back(farAway, 0.0f, 0.0f);
  meam::TrainedModel large = scenes::bracket();
  large.diameter = 1500.0;
  const std::vector<meam::PartPose> found =
    meam::estimateParts({ &large, &scenes::bracket() }, input, meam::detectionSettings(meam::Preset::Recommended, 1));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].part, 1);
  EXPECT_GT(found[0].pose.placeProbability, 0.5);
}

TEST(PartsEstimation, WhatOneTypeLosesToAnotherIsSearchedForFurther)
{
  // The same part twice: each claims all that the other has, so that no type may end its search with its share.
  const meam::TrainedModel& bracket = scenes::bracket();
  const std::vector<Eigen::Isometry3d> places{ scenes::lying(0, -70, -50), scenes::lying(0, 0, 20),
    scenes::lying(0, 70, 90) };
  const meam::SceneInput input = scenes::inputOf(scenes::seenFromAbove(scenes::brackets(places)));
  const auto find = [&](const meam::Progress& progress)
  {
    return meam::estimateParts(
      { &bracket, &bracket }, input, meam::detectionSettings(meam::Preset::Recommended, 3), nullptr, progress);
  };
  std::vector<meam::PartPose> found;
  steps::expectProgress([&](const meam::Progress& progress) { found = find(progress); });
  steps::expectStops(find, { 1.0 });
  ASSERT_EQ(found.size(), 3u);
  for (const meam::PartPose& one : found)
  {
    EXPECT_GT(one.pose.placeProbability, 0.9);
  }
}
