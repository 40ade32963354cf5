// SPDX-License-Identifier: BSD-3-Clause
#include "pose/ScanAdvice.h"

#include <gtest/gtest.h>

namespace
{
meam::ScanQuality goodScan()
{
  meam::ScanQuality quality;
  quality.pointDistance = 0.5;
  quality.noise = 0.1;
  quality.coverage = 0.9;
  return quality;
}

meam::Pose claimed(double place, double certainty)
{
  meam::Pose pose;
  pose.placeProbability = place;
  pose.certainty = certainty;
  return pose;
}

bool says(const std::string& advice, const std::string& words) { return advice.find(words) != std::string::npos; }
}

TEST(ScanAdvice, NothingOfAGoodScan)
{
  meam::DetectionReport report;
  report.rates.emplace();
  EXPECT_EQ(meam::scanAdvice(goodScan(), report, { claimed(0.9, 1.0) }, 100.0), "");
  EXPECT_EQ(meam::scanAdvice({}, {}, { claimed(0.9, 1.0) }, 100.0), "") << "nor where nothing is known";
}

TEST(ScanAdvice, ThereMayBeMoreWhereAsManyAreThereAsWereAskedFor)
{
  meam::DetectionReport report;
  report.maximumPoses = 2;
  EXPECT_EQ(meam::scanAdvice(goodScan(), report, { claimed(0.9, 1.0), claimed(0.8, 1.0) }, 100.0),
    "No more than 2 were asked for: there may be more (MaximumNumberOfPoses, 0: all).");
  EXPECT_EQ(meam::scanAdvice(goodScan(), report, { claimed(0.9, 1.0), claimed(0.2, 1.0) }, 100.0), "");
  report.maximumPoses = 0;
  EXPECT_EQ(meam::scanAdvice(goodScan(), report, { claimed(0.9, 1.0), claimed(0.8, 1.0) }, 100.0), "");
  EXPECT_EQ(meam::scanAdvice(goodScan(), report, { claimed(0.2, 1.0) }, 100.0), "")
    << "nor where all were, and none is likely";
}

TEST(ScanAdvice, WhatItRestsOnIsALine)
{
  meam::DetectionReport report;
  report.work = { 300, 500, 120, 40, 30 };
  EXPECT_EQ(meam::scanSummary({}, report, { claimed(0.9, 1.0), claimed(0.2, 1.0) }, 100.0),
    "Of 500 candidates 120 had surface, 40 were refined; 1 of 2 poses are likely.");
  report.rates = { { 0.5, 0.2 }, { 0.9, 0.5 } };
  meam::ScanQuality scan = goodScan();
  scan.pointDistance = 0.5;
  scan.noise = 0.3;
  EXPECT_EQ(meam::scanSummary(scan, report, {}, 100.0),
    "The part is 200 pixels long, the noise 0.3 % of that. 50 % of its edges are found, 20 % anywhere. Of 500 "
    "candidates 120 had surface, 40 were refined; 0 of 0 poses are likely.");
}

TEST(ScanAdvice, AGuessedViewpointIsAskedForFirstWhereNothingIsSure)
{
  meam::ScanQuality scan = goodScan();
  scan.noise = 3.0;
  scan.coverage = 0.5;
  const std::string advice = meam::scanAdvice(scan, {}, { claimed(0.2, 1.0) }, 100.0, true);
  EXPECT_LT(advice.find("give the scan's viewpoint"), advice.find("noise")) << advice;
  EXPECT_FALSE(says(advice, "have depth")) << advice;
  scan.noise = 0.1;
  EXPECT_EQ(meam::scanAdvice(scan, {}, { claimed(0.9, 1.0) }, 100.0, true), "");
}

TEST(ScanAdvice, OfNothingFoundTheStageThatHadNothing)
{
  meam::DetectionReport report;
  const auto advice = [&] { return meam::scanAdvice(goodScan(), report, {}, 100.0); };
  EXPECT_TRUE(says(advice(), "no edges as far apart") && says(advice(), "unit") && says(advice(), "region") &&
              says(advice(), "image"))
    << advice();
  report.work.references = 100;
  EXPECT_TRUE(says(advice(), "Voting found no candidate")) << advice();
  report.work.screened = 90;
  EXPECT_TRUE(says(advice(), "Screening left none of 90 candidates")) << advice();
  report.work.verified = 80;
  EXPECT_TRUE(says(advice(), "Verification left none of 90 candidates")) << advice();
  report.work.refined = 70;
  report.work.selected = 60;
  EXPECT_TRUE(says(advice(), "Selection left none of 60 refined poses")) << advice();
  meam::ScanQuality coarse = goodScan();
  coarse.pointDistance = 2.0;
  const std::string ofCoarse = meam::scanAdvice(coarse, report, {}, 100.0);
  EXPECT_EQ(ofCoarse.find("The part is 50 pixels long"), 0u);
  EXPECT_NE(ofCoarse.find("has another unit"), std::string::npos);
  report.isCutShort = true;
  EXPECT_EQ(advice(), "") << "it is told that the time limit struck";
}

TEST(ScanAdvice, WhatStandsOutTheMoreImportantFirst)
{
  meam::DetectionReport report;
  meam::ScanQuality coarse = goodScan();
  coarse.pointDistance = 2.0;
  EXPECT_TRUE(says(meam::scanAdvice(coarse, report, {}, 100.0), "50 pixels"));
  meam::ScanQuality noisy = goodScan();
  noisy.noise = 3.0;
  EXPECT_TRUE(says(meam::scanAdvice(noisy, report, {}, 100.0), "3 %"));
  report.rates.emplace();
  report.rates->edges = { 0.35, 0.3 };
  EXPECT_TRUE(says(meam::scanAdvice(goodScan(), report, {}, 100.0), "35 % are found, anywhere 30 %"));
  const meam::Poses unsure{ claimed(0.9, 0.3), claimed(0.8, 0.4), claimed(0.7, 1.0), claimed(0.1, 0.2) };
  report.rates.reset();
  EXPECT_TRUE(says(meam::scanAdvice(goodScan(), report, unsure, 100.0), "2 of 3 parts"));
  coarse.noise = 3.0;
  coarse.coverage = 0.5;
  const std::string both = meam::scanAdvice(coarse, report, unsure, 100.0);
  EXPECT_LT(both.find("pixels long"), both.find("have depth"));
  EXPECT_FALSE(says(both, "noise")) << "two sentences";
  meam::Poses ofOtherHand{ claimed(0.01, 1.0) };
  ofOtherHand[0].contradictions.mirrored = 0.99;
  EXPECT_EQ(meam::scanAdvice(coarse, report, ofOtherHand, 100.0).find("The part's mirror image fits better"), 0u);
  meam::Poses ofOtherSize{ claimed(0.01, 1.0) };
  ofOtherSize[0].contradictions.resized = 0.99;
  ofOtherSize[0].contradictions.lengths.z() = 0.9;
  EXPECT_TRUE(says(meam::scanAdvice(goodScan(), report, ofOtherSize, 100.0), "0.90 times as long along z"));
  meam::Poses ofOtherPart{ claimed(0.01, 1.0) };
  ofOtherPart[0].contradictions.missing = 2;
  EXPECT_TRUE(says(meam::scanAdvice(goodScan(), report, ofOtherPart, 100.0), "is missing on most copies"));
  ofOtherPart[0].contradictions.surplus = 3;
  EXPECT_TRUE(says(meam::scanAdvice(goodScan(), report, ofOtherPart, 100.0), "surface that the part does not have"));
}
