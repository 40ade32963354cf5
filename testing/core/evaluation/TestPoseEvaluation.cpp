// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/PoseEvaluation.h"

#include "TestSteps.h"

#include <cmath>

namespace
{
using Eigen::AngleAxisd;
using Eigen::Vector3d;

meam::Pose poseAt(double x, const AngleAxisd& turn = AngleAxisd(0.0, Vector3d::UnitZ()))
{
  meam::Pose pose;
  pose.T_scene_model.linear() = turn.toRotationMatrix();
  pose.T_scene_model.translation() = Vector3d(x, 20.0, -3.0);
  return pose;
}

AngleAxisd degrees(double angle, const Vector3d& axis) { return AngleAxisd(angle * M_PI / 180.0, axis); }

/// A part of 50 mm: right within 5 mm and 5 degrees.
meam::PoseEvaluationSettings settings()
{
  meam::PoseEvaluationSettings settings;
  settings.diameter = 50.0;
  return settings;
}

meam::EvaluationFigures figuresOf(
  const meam::Poses& estimates, const meam::Poses& truths, const meam::PoseEvaluationSettings& with = settings())
{
  meam::EvaluationTotals totals;
  totals.add(meam::evaluatePoses(estimates, truths, with));
  return meam::evaluationFigures(totals);
}
}

TEST(PoseEvaluation, toleranceOfTranslationAndRotation)
{
  const meam::Poses truths = { poseAt(0), poseAt(100) };
  const auto instanceOf = [&](const meam::Pose& pose)
  { return meam::evaluatePoses({ pose }, truths, settings()).judgements.at(0).instance; };
  EXPECT_EQ(instanceOf(poseAt(4.99)), 0);
  EXPECT_EQ(instanceOf(poseAt(5.01)), -1);
  EXPECT_EQ(instanceOf(poseAt(104.99)), 1);
  EXPECT_EQ(instanceOf(poseAt(0, degrees(4.99, Vector3d::UnitX()))), 0);
  EXPECT_EQ(instanceOf(poseAt(0, degrees(5.01, Vector3d::UnitX()))), -1);
}

TEST(PoseEvaluation, errorsOfARightPose)
{
  const auto judgement =
    meam::evaluatePoses({ poseAt(103, degrees(4, Vector3d::UnitZ())) }, { poseAt(0), poseAt(100) }, settings())
      .judgements.at(0);
  EXPECT_EQ(judgement.nearest, 1);
  EXPECT_FALSE(judgement.duplicate);
  EXPECT_NEAR(judgement.translationError, 3.0, 1e-12);
  EXPECT_NEAR(judgement.rotationError, 4.0, 1e-9);
  EXPECT_NEAR(judgement.axisError, 0.0, 1e-9);
  EXPECT_NEAR(judgement.rollError, 4.0, 1e-9);
}

TEST(PoseEvaluation, axisAndRollAreToldApart)
{
  const AngleAxisd truth = degrees(77, Vector3d(1, 2, 3).normalized());
  const auto judgementOf = [&](double swing, double roll, const Vector3d& axis)
  {
    meam::PoseEvaluationSettings with = settings();
    with.axis = axis;
    const Eigen::Quaterniond turn = truth * degrees(swing, axis.unitOrthogonal()) * degrees(roll, axis.normalized());
    return meam::evaluatePoses({ poseAt(0, AngleAxisd(turn)) }, { poseAt(0, truth) }, with).judgements.at(0);
  };
  for (const Vector3d& axis : { Vector3d(0, 0, 1), Vector3d(0, 3, 4) })
  {
    EXPECT_NEAR(judgementOf(30, 0, axis).axisError, 30.0, 1e-9);
    EXPECT_NEAR(judgementOf(30, 0, axis).rollError, 0.0, 1e-9);
    EXPECT_NEAR(judgementOf(0, 180, axis).axisError, 0.0, 1e-6);
    EXPECT_NEAR(judgementOf(0, 180, axis).rollError, 180.0, 1e-6);
    EXPECT_NEAR(judgementOf(0, 200, axis).rollError, 160.0, 1e-6);
    EXPECT_NEAR(judgementOf(25, 50, axis).axisError, 25.0, 1e-9);
    EXPECT_NEAR(judgementOf(25, 50, axis).rollError, 50.0, 1e-9);
    EXPECT_NEAR(judgementOf(180, 0, axis).axisError, 180.0, 1e-6);
  }
}

TEST(PoseEvaluation, ofTwoInReachTheOneThatIsTurnedLessMatches)
{
  const meam::Poses truths = { poseAt(0, degrees(4, Vector3d::UnitX())), poseAt(3) };
  const auto judgement = meam::evaluatePoses({ poseAt(0) }, truths, settings()).judgements.at(0);
  EXPECT_EQ(judgement.instance, 1);
  EXPECT_EQ(judgement.nearest, 0);
  EXPECT_NEAR(judgement.translationError, 3.0, 1e-12);
}

TEST(PoseEvaluation, aWrongPoseIsMeasuredAgainstTheNearest)
{
  const auto judgement = meam::evaluatePoses({ poseAt(60) }, { poseAt(0), poseAt(100) }, settings()).judgements.at(0);
  EXPECT_EQ(judgement.instance, -1);
  EXPECT_EQ(judgement.nearest, 1);
  EXPECT_NEAR(judgement.translationError, 40.0, 1e-12);
  const auto alone = meam::evaluatePoses({ poseAt(60) }, {}, settings()).judgements.at(0);
  EXPECT_EQ(alone.nearest, -1);
  EXPECT_TRUE(std::isnan(alone.translationError));
}

TEST(PoseEvaluation, duplicatesCountForThePaperAlone)
{
  const meam::Poses truths = { poseAt(0), poseAt(100), poseAt(200) };
  // right, the same again, wrong, right: four poses where five were asked for
  const meam::Poses estimates = { poseAt(1), poseAt(2), poseAt(50), poseAt(103) };
  const auto scene = meam::evaluatePoses(estimates, truths, settings());
  EXPECT_FALSE(scene.judgements[0].duplicate);
  EXPECT_TRUE(scene.judgements[1].duplicate);
  const auto figures = figuresOf(estimates, truths);
  EXPECT_DOUBLE_EQ(figures.paperRate, 75.0);
  EXPECT_DOUBLE_EQ(figures.strictRate, 40.0);
  EXPECT_DOUBLE_EQ(figures.top1Rate, 100.0);
  EXPECT_DOUBLE_EQ(figures.recall, 200.0 / 3.0);
  EXPECT_NEAR(figures.meanTranslationError, 2.0, 1e-12);
  EXPECT_NEAR(figures.medianTranslationError, 2.0, 1e-12);
  EXPECT_NEAR(figures.medianRotationError, 0.0, 1e-6);
}

TEST(PoseEvaluation, onlyThePosesAskedForAreCounted)
{
  meam::PoseEvaluationSettings with = settings();
  with.posesAskedFor = 1;
  const auto figures = figuresOf({ poseAt(50), poseAt(0) }, { poseAt(0) }, with);
  EXPECT_DOUBLE_EQ(figures.paperRate, 0.0);
  EXPECT_DOUBLE_EQ(figures.strictRate, 0.0);
  EXPECT_DOUBLE_EQ(figures.recall, 100.0); // by any pose
  with.posesAskedFor = 0;
  EXPECT_DOUBLE_EQ(figuresOf({ poseAt(50), poseAt(0) }, { poseAt(0) }, with).strictRate, 50.0);
}

TEST(PoseEvaluation, addsUpScenes)
{
  meam::EvaluationTotals totals;
  totals.add(meam::evaluatePoses({ poseAt(1) }, { poseAt(0) }, settings()));
  totals.add(meam::evaluatePoses({ poseAt(50), poseAt(4) }, { poseAt(0) }, settings()));
  totals.add(meam::evaluatePoses({}, { poseAt(0) }, settings()));
  const auto figures = meam::evaluationFigures(totals);
  EXPECT_EQ(totals.scenes, 3);
  EXPECT_DOUBLE_EQ(figures.paperRate, 200.0 / 3.0);
  EXPECT_DOUBLE_EQ(figures.strictRate, 200.0 / 15.0);
  EXPECT_DOUBLE_EQ(figures.top1Rate, 100.0 / 3.0);
  EXPECT_NEAR(figures.medianTranslationError, 2.5, 1e-12);
  EXPECT_DOUBLE_EQ(figures.recall, 200.0 / 3.0);
}

TEST(PoseEvaluation, noPosesHaveNoRate)
{
  const auto figures = figuresOf({}, { poseAt(0) });
  EXPECT_TRUE(std::isnan(figures.paperRate));
  EXPECT_DOUBLE_EQ(figures.strictRate, 0.0);
  EXPECT_DOUBLE_EQ(figures.averagePrecision, 0.0);
  EXPECT_TRUE(std::isnan(figures.medianRotationError));
}

TEST(PoseEvaluation, hiddenInstancesNeedNotBeFound)
{
  meam::Poses truths = { poseAt(0), poseAt(100), poseAt(200) };
  truths[0].visibleFraction = 0.9;
  truths[1].visibleFraction = 0.5;
  truths[2].visibleFraction = 0.49;
  const auto hiddenOnly = meam::evaluatePoses({ poseAt(200) }, truths, settings());
  EXPECT_EQ(hiddenOnly.visibleInstances, 2);
  EXPECT_TRUE(hiddenOnly.ranking.empty());
  EXPECT_EQ(hiddenOnly.judgements[0].instance, 2);
  EXPECT_DOUBLE_EQ(figuresOf({ poseAt(0), poseAt(200) }, truths).recall, 50.0);
}

TEST(PoseEvaluation, averagePrecision)
{
  const meam::Poses truths = { poseAt(0), poseAt(100) };
  meam::Poses estimates = { poseAt(0), poseAt(50), poseAt(100) };
  for (int i = 0; i < 3; ++i)
  {
    estimates[i].score = 0.9 - 0.1 * i;
  }
  // Precision 1 up to a recall of 1/2 (51 of 101 steps), then 2/3.
  EXPECT_NEAR(figuresOf(estimates, truths).averagePrecision, 100.0 * (51.0 + 50.0 * 2.0 / 3.0) / 101.0, 1e-9);
  estimates.pop_back();
  EXPECT_NEAR(figuresOf(estimates, truths).averagePrecision, 100.0 * 51.0 / 101.0, 1e-9);
  // The score decides over scenes: a wrong pose with the best score halves the precision.
  meam::EvaluationTotals totals;
  totals.add(meam::evaluatePoses({ estimates[0] }, { poseAt(0) }, settings()));
  estimates[1].score = 0.95;
  totals.add(meam::evaluatePoses({ estimates[1] }, {}, settings()));
  EXPECT_NEAR(meam::evaluationFigures(totals).averagePrecision, 50.0, 1e-9);
}

TEST(PoseEvaluation, whatBecameOfEachInstanceAndPose)
{
  // Three instances 100 mm apart: the first is found twice, the second turned by 90 degrees, the third not at all.
  const meam::SceneEvaluation scene =
    meam::evaluatePoses({ poseAt(1), poseAt(2), poseAt(100, degrees(90, Vector3d::UnitX())), poseAt(50) },
      { poseAt(0), poseAt(100), poseAt(300) }, settings());
  const meam::PoseOutcome outcomes[] = { meam::PoseOutcome::Hit, meam::PoseOutcome::Duplicate,
    meam::PoseOutcome::WrongTurn, meam::PoseOutcome::WrongPlace };
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(scene.judgements[i].outcome, outcomes[i]) << i;
  }
  ASSERT_EQ(scene.instances.size(), 3u);
  const int foundBy[] = { 0, -1, -1 }, nearest[] = { 0, 2, 2 };
  const double mm[] = { 1, 0, 200 }, turns[] = { 0, 90, 90 };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(scene.instances[i].pose, foundBy[i]) << i;
    EXPECT_EQ(scene.instances[i].nearest, nearest[i]) << i;
    EXPECT_TRUE(scene.instances[i].counts);
    EXPECT_NEAR(scene.instances[i].translationError, mm[i], 1e-9) << i;
    EXPECT_NEAR(scene.instances[i].rotationError, turns[i], 1e-6) << i;
  }
  const meam::SceneEvaluation nothing = meam::evaluatePoses(meam::Poses{}, { poseAt(0) }, settings());
  EXPECT_EQ(nothing.instances[0].pose, -1);
  EXPECT_EQ(nothing.instances[0].nearest, -1);
  EXPECT_TRUE(std::isnan(nothing.instances[0].translationError));
}

/// 100 right poses, a wrong one, 97 right ones, a wrong one, 2 right ones: 99 % is kept up to the 198th, 197 of which
/// are right; with the second wrong one it is 197 of 199, 98.99 %, and 198 of 200 are 99 % again.
TEST(PoseEvaluation, recallAtAPrecisionOf99Percent)
{
  meam::EvaluationTotals totals;
  totals.visibleInstances = 400;
  for (int i = 0; i < 201; ++i)
  {
    totals.ranking.emplace_back(1.0 - 0.001 * i, i != 100 && i != 198);
  }
  EXPECT_DOUBLE_EQ(meam::evaluationFigures(totals).recallAtPrecision99, 100.0 * 199 / 400);
  totals.ranking.resize(200);
  EXPECT_DOUBLE_EQ(meam::evaluationFigures(totals).recallAtPrecision99, 100.0 * 198 / 400);
  totals.ranking.resize(199);
  EXPECT_DOUBLE_EQ(meam::evaluationFigures(totals).recallAtPrecision99, 100.0 * 197 / 400);
  totals.ranking[0].second = false;
  totals.ranking.resize(50);
  EXPECT_DOUBLE_EQ(meam::evaluationFigures(totals).recallAtPrecision99, 0.0);
}

TEST(PoseEvaluation, equalPosesOfASymmetricPartAreRight)
{
  meam::PoseEvaluationSettings with = settings();
  with.symmetries.discrete.push_back(
    meam::turnAbout(Vector3d::UnitZ(), M_PI, Vector3d(8, 0, 0))); // half a turn about an axis beside the origin
  meam::Pose turned = poseAt(0);
  turned.T_scene_model = turned.T_scene_model * with.symmetries.discrete[0];
  EXPECT_EQ(meam::evaluatePoses({ turned }, { poseAt(0) }, settings()).judgements.at(0).instance, -1);
  const auto judgement = meam::evaluatePoses({ turned }, { poseAt(0) }, with).judgements.at(0);
  EXPECT_EQ(judgement.instance, 0);
  EXPECT_NEAR(judgement.translationError, 0.0, 1e-9);
  EXPECT_NEAR(judgement.rotationError, 0.0, 1e-5);
  EXPECT_NEAR(judgement.rollError, 0.0, 1e-5);
  EXPECT_TRUE(meam::evaluatePoses({ poseAt(0), turned }, { poseAt(0) }, with).judgements.at(1).duplicate);
}

TEST(PoseEvaluation, thePartsMiddleIsWhatMoves)
{
  meam::PoseEvaluationSettings with = settings();
  with.middle = Vector3d(1000, 0, 0); // a part 1 m from its origin
  const meam::Pose truth = poseAt(0);
  meam::Pose turned = truth;
  turned.T_scene_model = truth.T_scene_model * meam::turnAbout(Vector3d::UnitZ(), M_PI / 180.0, with.middle);
  EXPECT_EQ(meam::evaluatePoses({ turned }, { truth }, settings()).judgements.at(0).instance, -1);
  const auto judgement = meam::evaluatePoses({ turned }, { truth }, with).judgements.at(0);
  EXPECT_EQ(judgement.instance, 0);
  EXPECT_NEAR(judgement.translationError, 0.0, 1e-9);
  EXPECT_NEAR(judgement.rotationError, 1.0, 1e-6);
}

TEST(PoseEvaluation, badInput)
{
  steps::expectRefused<meam::PoseEvaluationSettings>([](const auto& with) { meam::evaluatePoses({}, {}, with); },
    { { [](auto& with) { with.diameter = 0.0; } }, { [](auto& with) { with.axis.setZero(); } },
      { [](auto& with) { with.middle.x() = INFINITY; } }, { [](auto& with) { with.posesAskedFor = -1; } },
      { [](auto& with) { with.rotationTolerance = NAN; } } },
    settings());
  EXPECT_THROW(meam::evaluatePoses({ poseAt(NAN) }, {}, settings()), meam::Error);
  EXPECT_THROW(meam::evaluatePoses({}, { poseAt(NAN) }, settings()), meam::Error);
}
