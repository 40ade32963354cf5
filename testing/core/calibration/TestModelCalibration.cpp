// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/ModelCalibration.h"

#include "base/Error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using meam::JudgedPose;

/// As many poses in each of so many scans, all told `place`, of which the first `right` of a scan are there.
std::vector<JudgedPose> alike(int scenes, int poses, int right, double place, double certainty = 1.0)
{
  std::vector<JudgedPose> judged;
  for (int scene = 0; scene < scenes; ++scene)
  {
    for (int k = 0; k < poses; ++k)
    {
      judged.push_back({ place, certainty, k < right, true, scene });
    }
  }
  return judged;
}

/// Poses whose place is told by `told`, log odds to log odds, of what is true of as many as there are of each.
template <typename Told>
std::vector<JudgedPose> spread(Told told)
{
  std::vector<JudgedPose> judged;
  for (int scene = 0; scene < 20; ++scene)
  {
    for (double logOdds = -4.0; logOdds <= 4.0; logOdds += 0.5)
    {
      const int count = 40, right = static_cast<int>(std::lround(count * meam::probabilityOf(logOdds)));
      for (int k = 0; k < count; ++k)
      {
        judged.push_back({ meam::probabilityOf(told(logOdds)), 1.0, k < right, true, scene });
      }
    }
  }
  return judged;
}
}

TEST(ModelCalibration, TheConstantIsThatOfLargestPosteriorProbability)
{
  // All say 1 of 2 and 3 of 4 are right: 20 (p - 3/4) + a / 4 = 0 for the constant a, whose deviation is 2.
  const auto report = meam::fitModelCalibration(alike(5, 4, 3, 0.5));
  const double a = report.calibration.place.constant;
  EXPECT_NEAR(20.0 * (meam::probabilityOf(a) - 0.75) + a / 4.0, 0.0, 1e-8);
  EXPECT_EQ(report.calibration.place.slope, 1.0) << "nothing tells the slope";
  EXPECT_EQ(report.calibration.poses, 20);
  EXPECT_TRUE(report.calibration.rotation.isIdentity());
  // A scan left out: 16 (p - 3/4) + b / 4 = 0.
  const double after = report.classes.at(0).after, b = std::log(after / (1.0 - after));
  EXPECT_NEAR(16.0 * (after - 0.75) + b / 4.0, 0.0, 1e-8);
  EXPECT_NEAR(report.lossBefore, std::log(2.0), 1e-12);
  EXPECT_NEAR(report.lossAfter, -0.75 * std::log(after) - 0.25 * std::log(1.0 - after), 1e-12);
}

TEST(ModelCalibration, WhatHoldsStaysAsItIs)
{
  const auto report = meam::fitModelCalibration(alike(10, 4, 2, 0.5));
  EXPECT_TRUE(report.calibration.place.isIdentity());
  EXPECT_EQ(report.lossBefore, report.lossAfter);
  ASSERT_EQ(report.classes.size(), 2u);
  EXPECT_EQ(report.classes[0].withRotation, false);
  EXPECT_EQ(report.classes[0].poses, 40);
  EXPECT_EQ(report.classes[0].right, 0.5);
  EXPECT_EQ(report.classes[0].before, 0.5);
}

TEST(ModelCalibration, ALineThatWasLaidOnTheLogOddsComesOff)
{
  const auto report = meam::fitModelCalibration(spread([](double x) { return 1.0 + 1.6 * x; }));
  EXPECT_NEAR(report.calibration.place.slope, 1.0 / 1.6, 0.02);
  EXPECT_NEAR(report.calibration.place.constant, -1.0 / 1.6, 0.05);
  EXPECT_LT(report.lossAfter, report.lossBefore);
  for (const meam::ClaimClass& one : report.classes)
  {
    EXPECT_NEAR(one.after, one.right, 0.03) << one.least;
  }
}

TEST(ModelCalibration, ClaimsStayInTheirOrder)
{
  const auto report = meam::fitModelCalibration(spread([](double x) { return -x; }));
  EXPECT_EQ(report.calibration.place.slope, 0.1);
  EXPECT_NE(report.warning.find("surer that a copy is there, it"), std::string::npos) << report.warning;
  EXPECT_EQ(meam::fitModelCalibration(alike(10, 4, 3, 0.5)).warning, "");
}

TEST(ModelCalibration, ASecondFitTakesThePlaceOfTheFirst)
{
  const auto first = meam::fitModelCalibration(spread([](double x) { return 1.0 + 1.6 * x; })).calibration;
  const auto second = meam::fitModelCalibration(spread([](double x) { return 0.5 + x; }), first).calibration;
  EXPECT_NEAR(second.place.slope, first.place.slope, 0.02);
  EXPECT_NEAR(second.place.constant, first.place.constant - 0.5, 0.05);
  EXPECT_EQ(second.poses, 20 * 17 * 40);
  EXPECT_NEAR(first.place.countedOf(first.place.logOdds(0.7)), 0.7, 1e-12);
}

TEST(ModelCalibration, TheSamePosesTeachTheSameAgain)
{
  // Few, so that what is known before weighs: told by the first calibration they ask for no second.
  auto judged = alike(10, 4, 1, 0.9, 0.8);
  for (std::size_t k = 0; k < judged.size(); ++k)
  {
    judged[k].isTurnedRight = k % 8 != 0;
  }
  const auto first = meam::fitModelCalibration(judged).calibration;
  ASSERT_FALSE(first.place.isIdentity());
  for (JudgedPose& pose : judged)
  {
    const double counted = std::log(pose.placeProbability / (1.0 - pose.placeProbability));
    pose.placeProbability = meam::probabilityOf(first.place.logOdds(counted));
    pose.certainty = first.certaintyOf(pose.certainty);
  }
  const auto report = meam::fitModelCalibration(judged, first);
  for (const auto line : { &meam::ModelCalibration::place, &meam::ModelCalibration::rotation })
  {
    EXPECT_EQ((report.calibration.*line).constant, (first.*line).constant);
    EXPECT_EQ((report.calibration.*line).slope, (first.*line).slope);
  }
  EXPECT_EQ(report.calibration.poses, 40);
  EXPECT_EQ(report.lossBefore, report.lossAfter);
}

TEST(ModelCalibration, TheLossIsOfRightTurnedAndWrong)
{
  auto judged = alike(5, 4, 3, 0.8, 0.9); // of a scan two right, one turned, one wrong
  for (std::size_t k = 0; k < judged.size(); ++k)
  {
    judged[k].isTurnedRight = k % 4 < 2;
  }
  const double loss = -(2.0 * std::log(0.8 * 0.9) + std::log(0.8 * 0.1) + std::log(0.2)) / 4.0;
  EXPECT_NEAR(meam::fitModelCalibration(judged).lossBefore, loss, 1e-12);
}

TEST(ModelCalibration, RotationsAreOfPosesThatAreThereAndCanBeTurned)
{
  auto judged = alike(10, 5, 5, 0.9, 0.9);
  for (std::size_t k = 0; k < judged.size(); ++k)
  {
    judged[k].isTurnedRight = k % 5 < 2;
  }
  for (int scene = 0; scene < 10; ++scene)
  {
    judged.push_back({ 0.9, 0.9, false, false, scene }); // is of nothing
    judged.push_back({ 0.9, 1.0, true, true, scene });   // looks like itself in no other rotation
  }
  const auto calibration = meam::fitModelCalibration(judged).calibration;
  EXPECT_NEAR(calibration.certaintyOf(0.9), 0.4, 0.05);
  EXPECT_EQ(calibration.certaintyOf(1.0), 1.0);
  EXPECT_EQ(meam::ModelCalibration().certaintyOf(0.9), 0.9);
}

TEST(ModelCalibration, RefusesWhatTeachesNothing)
{
  EXPECT_THROW(meam::fitModelCalibration({}), meam::Error);
  EXPECT_THROW(meam::fitModelCalibration(alike(4, 10, 5, 0.5)), meam::Error) << "few scans";
  EXPECT_THROW(meam::fitModelCalibration(alike(6, 3, 1, 0.5)), meam::Error) << "few poses";
  EXPECT_THROW(meam::fitModelCalibration(alike(10, 10, 5, 1.5)), meam::Error);
  EXPECT_THROW(meam::fitModelCalibration(alike(10, 10, 5, NAN)), meam::Error);
  EXPECT_NO_THROW(meam::fitModelCalibration(alike(10, 10, 5, 1.0)));
}
