// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/DiagnosisReport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using meam::LossCause;
using meam::PoseStage;

namespace
{
meam::Diagnosis example(LossCause cause, std::optional<PoseStage> lostIn = {})
{
  meam::Diagnosis diagnosis;
  diagnosis.cause = cause;
  diagnosis.lostIn = lostIn;
  diagnosis.place.emplace();
  diagnosis.place->visibleFraction = 0.12;
  diagnosis.probability = 0.3;
  diagnosis.offset = { 0.61, 1.18 };
  diagnosis.evidence.edges = 120;
  diagnosis.evidence.edgesMatched = 3;
  diagnosis.evidence.points.surface.resize(5);
  diagnosis.evidence.points.surfaceStates = { meam::PointState::Hidden, meam::PointState::Violated,
    meam::PointState::Violated, meam::PointState::Matched, meam::PointState::Unknown };
  diagnosis.votes = { { Eigen::Vector3f::Zero(), true, true, 12, 31, 4 },
    { Eigen::Vector3f::Zero(), true, true, 7, 40, 0 }, { Eigen::Vector3f::Zero(), true, false, 20, 20, 1 } };
  diagnosis.stages = { { PoseStage::Voting, 200, 3, 7 }, { PoseStage::Screening, 90, 0, 0 } };
  return diagnosis;
}

std::string verdict(LossCause cause, std::optional<PoseStage> lostIn = {})
{
  const meam::DetectionSettings detection = meam::detectionSettings(meam::Preset::Recommended, 5, 0, 0.5);
  meam::Diagnosis diagnosis = example(cause, lostIn);
  diagnosis.rankWithoutLimits = 7;
  diagnosis.candidateShare = 0.34;
  diagnosis.takenBy = 3;
  diagnosis.takenShare = 0.83;
  return meam::verdictOf(diagnosis, detection);
}
}

TEST(DiagnosisReport, VerdictsAreSentences)
{
  EXPECT_EQ(verdict(LossCause::None), "Found as rank 7, 30 %, 0.6 mm and 1.2 degrees off the place asked about.");
  EXPECT_EQ(verdict(LossCause::NotWanted, PoseStage::Selection),
    "Found as rank 7, 30 %, 0.6 mm and 1.2 degrees off, but only the best 5 of at least 50 % are wanted.");
  EXPECT_EQ(verdict(LossCause::Hidden, PoseStage::Voting),
    "Hidden: something lies in front of 88 % of the part's side towards the sensor; lost in voting.");
  EXPECT_EQ(verdict(LossCause::NotThere, PoseStage::Refinement),
    "No part there: the sensor saw past 50 % of the surface; lost in refinement.");
  EXPECT_EQ(verdict(LossCause::NotMeasured, PoseStage::Voting),
    "Not measured: at 25 % of the surface there is no point of the scan; lost in voting.");
  EXPECT_EQ(verdict(LossCause::FewEdges, PoseStage::Voting),
    "Lost at the edges: 3 of 120 predicted edge points have an edge of the scan, no more than anywhere.");
  EXPECT_EQ(verdict(LossCause::Outvoted, PoseStage::Voting),
    "Lost in voting: none of the 2 reference points on the part elects it; the best gives it 12 votes, and another "
    "pose 31.");
  EXPECT_EQ(verdict(LossCause::NoReference, PoseStage::Voting),
    "Lost in voting: 1 point of 3 on the part would elect it, but none of its 2 reference points does.");
  EXPECT_EQ(verdict(LossCause::SurfaceMissing, PoseStage::Screening),
    "Lost in screening: at the best of 3 candidates here 34 % of the surface is there, less than 50 %.");
  EXPECT_EQ(verdict(LossCause::Taken, PoseStage::Selection),
    "Lost in selection: pose 3, which has 83 % of the points that match here, was preferred.");
  EXPECT_EQ(verdict(LossCause::MovedAway, PoseStage::Refinement),
    "Lost in refinement: the best candidate here came to a place that is 0.6 mm and 1.2 degrees off.");
}

TEST(DiagnosisReport, TheLimitsThatKeepAPoseBackAreNamed)
{
  meam::Diagnosis diagnosis = example(LossCause::NotWanted, PoseStage::Selection);
  diagnosis.rankWithoutLimits = 7;
  const auto words = [&](int maximum, double least)
  {
    const meam::DetectionSettings detection = meam::detectionSettings(meam::Preset::Recommended, maximum, 0, least);
    const std::string verdict = meam::verdictOf(diagnosis, detection);
    return verdict.substr(verdict.find("but")) + " " + meam::adviceOf(diagnosis, detection);
  };
  EXPECT_EQ(words(6, 0.3), "but only the best 6 are wanted. Raise MaximumNumberOfPoses to 7 or more, or set it to 0.");
  EXPECT_EQ(words(7, 0.5), "but only poses of at least 50 % are wanted. Lower MinimumProbability.");
  EXPECT_EQ(words(0, 0.5), "but only poses of at least 50 % are wanted. Lower MinimumProbability.");
  EXPECT_EQ(words(5, 0.4), "but only the best 5 of at least 40 % are wanted. Raise MaximumNumberOfPoses to 7 or more, "
                           "or set it to 0. Lower MinimumProbability.");
}

TEST(DiagnosisReport, EveryCauseHasAVerdictOfItsOwn)
{
  std::set<std::string> verdicts;
  for (int cause = 0; cause <= static_cast<int>(LossCause::NotWanted); ++cause)
  {
    const std::string words = verdict(static_cast<LossCause>(cause), PoseStage::Selection);
    EXPECT_EQ(words.back(), '.');
    verdicts.insert(words);
  }
  EXPECT_EQ(verdicts.size(), static_cast<std::size_t>(LossCause::NotWanted) + 1);
}

TEST(DiagnosisReport, AdviceNamesAProperty)
{
  const auto advice = [](LossCause cause, meam::Features features = meam::Features::Both)
  {
    meam::DetectionSettings detection = meam::detectionSettings(meam::Preset::Recommended);
    detection.detection.features = features;
    meam::Diagnosis diagnosis = example(cause, PoseStage::Voting);
    diagnosis.rankWithoutLimits = 7;
    return meam::adviceOf(diagnosis, detection);
  };
  EXPECT_NE(advice(LossCause::Outvoted), "");
  EXPECT_EQ(advice(LossCause::Outvoted, meam::Features::Edges), "Let edges and surface vote (Features: Both).");
  EXPECT_EQ(advice(LossCause::None), "");
}

TEST(DiagnosisReport, WhereAPartWasLostThereIsAdvice)
{
  const meam::DetectionSettings detection = meam::detectionSettings(meam::Preset::Recommended, 5);
  for (int cause = static_cast<int>(LossCause::None) + 1; cause <= static_cast<int>(LossCause::NotWanted); ++cause)
  {
    meam::Diagnosis diagnosis = example(static_cast<LossCause>(cause), PoseStage::Selection);
    diagnosis.rankWithoutLimits = 7;
    diagnosis.found.emplace();
    diagnosis.found->certainty = 0.5;
    EXPECT_NE(meam::adviceOf(diagnosis, detection), "") << cause;
  }
}

TEST(DiagnosisReport, WhatSpeaksMostForAPoseAndMostAgainstItIsTold)
{
  meam::Diagnosis diagnosis = example(LossCause::None);
  EXPECT_EQ(meam::mainReasonOf(diagnosis), "");
  diagnosis.odds.terms = { { "edges", "points found", 30.0, 2.0 }, { "visible surface", "patches", 10.0, 10.0 } };
  EXPECT_EQ(meam::mainReasonOf(diagnosis), "Most for it: visible surface.");
  diagnosis.odds.terms.push_back({ "surface that the sensor saw past", "patches", 0.5, -4.0 });
  EXPECT_EQ(
    meam::mainReasonOf(diagnosis), "Most for it: visible surface. Most against it: surface that the sensor saw past.");
  diagnosis.lessByOthers = 4.2;
  EXPECT_EQ(meam::mainReasonOf(diagnosis),
    "Most for it: visible surface. Most against it: a part of just this shape may not be in the scan.");
  diagnosis.cutsInto = 5;
  EXPECT_EQ(
    meam::mainReasonOf(diagnosis), "Most for it: visible surface. Most against it: its body cuts into that of rank 5.");
  diagnosis.cause = LossCause::NotWanted;
  diagnosis.probability = 0.9;
  EXPECT_EQ(meam::mainReasonOf(diagnosis), "") << "the limit is the reason";
}

TEST(DiagnosisReport, WhatSpeaksForAPoseAndAgainstItIsTold)
{
  meam::Diagnosis diagnosis = example(LossCause::None);
  EXPECT_TRUE(meam::reasonsOf(diagnosis).empty());
  diagnosis.odds.before = -6.3;
  diagnosis.odds.terms = { { "surface that agrees", "patches", 10.0, 10.0 },
    { "surface that the sensor saw past", "patches", 0.5, -4.0 }, { "edges", "points found", 30.0, 2.0 },
    { "outline", "patches long where surface ends", 8.0, 0.01 } };
  diagnosis.found.emplace();
  diagnosis.found->certainty = 0.7;
  diagnosis.found->alternatives = { { Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ())), 0.25 } };
  diagnosis.found->contradictions = { 0.5, 0.5, 3.0 };
  diagnosis.lessByOthers = 4.2;
  diagnosis.cutsInto = 5;
  diagnosis.otherRank = 9;
  diagnosis.otherProbability = 0.12;
  diagnosis.otherOffset = { 14.0, 90.0 };
  const std::vector<std::string> sentences{
    "For it, in the logarithm of the odds: surface that agrees, 10.0 patches (+10.0); edges, 30.0 points found "
    "(+2.0).",
    "Against it: surface that the sensor saw past, 0.5 patches (-4.0); to begin with, that most candidates are wrong "
    "(-6.3).",
    "Together that makes 1.7. So large a sum is damped, to 1.4.",
    "The rest of the scan makes it less likely, by 4.2: its body cuts into that of rank 5.",
    "Its rotation is 70 % sure; turned by 180.0 degrees it is 25 %.",
    "The nearest other pose is rank 9, 12 %, 14.0 mm and 90.0 degrees off."
  };
  EXPECT_EQ(meam::reasonsOf(diagnosis), sentences);
  diagnosis.odds.searched = 2.34;
  diagnosis.odds.shareOfSearch = 0.4;
  EXPECT_EQ(meam::reasonsOf(diagnosis)[1], sentences[1]);
  const std::string bySearch =
    "This scan shows few edges of a part: 40 % of the weight has the sum that it was searched by (2.3).";
  EXPECT_EQ(meam::reasonsOf(diagnosis)[3], bySearch);
  diagnosis.penalty = 1.0;
  diagnosis.odds.searched -= diagnosis.penalty;
  EXPECT_EQ(
    meam::reasonsOf(diagnosis)[3], bySearch + " That sum has 1.0 less, for the pose was moved to where it is largest.");
  diagnosis.odds.shareOfSearch = 0.0;
  const meam::DetectionSettings detection = meam::detectionSettings(meam::Preset::Recommended);
  diagnosis.cutsInto = 0;
  EXPECT_EQ(meam::reasonsOf(diagnosis)[3],
    "The rest of the scan makes it less likely, by 4.2: it may be another part that looks alike, for surface goes "
    "on beside it over 0.5 patches, and surface lies off the part by 3.0 times what the scan explains.");
  EXPECT_EQ(meam::adviceOf(diagnosis, detection),
    "If it is wrong: where parts that look alike lie, search for all of them together.");
  diagnosis.lessByOthers = 0.0; // what the scan explains by its own unevenness counts for no other part
  EXPECT_EQ(meam::reasonsOf(diagnosis).size(), 5u);
  EXPECT_NE(meam::adviceOf(diagnosis, detection).find("RotationCounts"), std::string::npos);
  diagnosis.continuing = 0.5;
  EXPECT_EQ(meam::reasonsOf(diagnosis)[3],
    "Against it, too: measured surface goes on beside it over 0.5 patches, unexplained.");
  // What to change where a pose that came out is wrong; of a place that was given nothing.
  diagnosis.found->certainty = 1.0;
  diagnosis.probability = 0.8;
  EXPECT_EQ(meam::adviceOf(diagnosis, detection), "");
  diagnosis.isOfFound = true;
  EXPECT_EQ(meam::adviceOf(diagnosis, detection), "If it is wrong: a MinimumProbability above 80 % keeps it back.");
  diagnosis.probability = 0.95;
  EXPECT_EQ(meam::adviceOf(diagnosis, detection).find("If it is wrong: search for what lies there, too"), 0u);
}

TEST(DiagnosisReport, WhatWasTriedAndHelpedIsAdvised)
{
  const meam::DetectionSettings detection = meam::detectionSettings(meam::Preset::Recommended);
  for (const LossCause cause : { LossCause::NoReference, LossCause::Outvoted, LossCause::OtherRotation,
         LossCause::Duplicate, LossCause::NotRefined, LossCause::Taken, LossCause::FewEdges })
  {
    meam::Diagnosis diagnosis = example(cause, PoseStage::Screening);
    diagnosis.isFoundByAllPoints = true;
    EXPECT_EQ(
      meam::adviceOf(diagnosis, detection), "Raise ReferenceShare: with all points on the part voting it is found.");
  }
}

TEST(DiagnosisReport, NumbersGoStepByStep)
{
  const std::vector<meam::DiagnosisNumber> numbers = meam::numbersOf(example(LossCause::None));
  const auto value = [&](const std::string& step, const std::string& what)
  {
    const auto found = std::find_if(numbers.begin(), numbers.end(),
      [&](const meam::DiagnosisNumber& number) { return number.step == step && number.what == what; });
    return found == numbers.end() ? std::make_pair(-1.0, -1.0) : std::make_pair(found->value, found->of);
  };
  EXPECT_EQ(value("edges", "of these that run the same way"), std::make_pair(3.0, 120.0));
  EXPECT_EQ(value("voting", "points on the part that are reference points"), std::make_pair(2.0, 3.0));
  EXPECT_EQ(value("voting", "other points that would elect it"), std::make_pair(1.0, 1.0));
  EXPECT_EQ(
    value("voting", "votes for it of its best reference point, of that point's most"), std::make_pair(12.0, 31.0));
  EXPECT_EQ(value("screening", "poses here"), std::make_pair(0.0, 90.0));
  EXPECT_TRUE(std::isnan(value("score", "probability at the place").second));
  EXPECT_TRUE(meam::numbersOf({}).empty());
}
