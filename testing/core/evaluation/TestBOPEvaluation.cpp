// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/BOPEvaluation.h"

#include "TestGrids.h"
#include "TestParts.h"
#include "mesh/TriangleMesh.h"

#include <cmath>

namespace
{
constexpr double Focal = 300.0, CX = 150.0, CY = 110.0;

/// What a camera sees of a wall across its view.
meam::OrganizedCloud wall(double depth)
{
  return grids::measured(grids::camera(320, 240, Focal, CX, CY), [=](int, int) { return depth; });
}

Eigen::Isometry3d at(double x, double y, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, z)); }

meam::Pose pose(const Eigen::Isometry3d& T, double visible = 1.0)
{
  meam::Pose result;
  result.T_scene_model = T;
  result.visibleFraction = visible;
  return result;
}
}

TEST(BOPEvaluation, AShiftIsTheSameOfEveryVertex)
{
  const meam::BOPEvaluation evaluation(parts::rectangle(40, 40), {});
  const meam::BOPErrors errors = evaluation.errors(at(3, 4, 500), at(0, 0, 500), wall(600));
  EXPECT_NEAR(errors.add, 5.0, 1e-9);
  EXPECT_NEAR(errors.adi, 5.0, 1e-5);
  EXPECT_NEAR(errors.mssd, 5.0, 1e-9);
  EXPECT_NEAR(errors.mspd, 5.0 / 500.0 * Focal, 1e-9);
}

TEST(BOPEvaluation, VSDIsTheShareOfPixelsThatDiffer)
{
  const meam::BOPEvaluation evaluation(parts::rectangle(40, 40), {}, 100.0);
  // Half of the plate's width beside: a third of the union is in both.
  meam::BOPErrors errors = evaluation.errors(at(20, 0, 500), at(0, 0, 500), wall(600));
  for (const double cost : errors.vsd)
  {
    EXPECT_NEAR(cost, 2.0 / 3.0, 0.03);
  }
  // 12 mm nearer: wrong by 12 % of the diameter wherever both are, and a little larger on the image.
  errors = evaluation.errors(at(0, 0, 488), at(0, 0, 500), wall(600));
  EXPECT_DOUBLE_EQ(errors.vsd[0], 1.0);
  EXPECT_DOUBLE_EQ(errors.vsd[1], 1.0);
  EXPECT_LT(errors.vsd[2], 0.1);
  // Behind a wall nothing of either is visible.
  EXPECT_DOUBLE_EQ(evaluation.errors(at(0, 0, 500), at(0, 0, 500), wall(400)).vsd[9], 1.0);
  EXPECT_DOUBLE_EQ(evaluation.errors(at(0, 0, 500), at(0, 0, 500), wall(600)).vsd[0], 0.0);
}

TEST(BOPEvaluation, SymmetriesCountForMSSDAndADIAlone)
{
  const Eigen::Isometry3d half = meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI, { 20, 20, 0 });
  meam::Symmetries symmetries;
  symmetries.discrete = { half };
  const Eigen::Isometry3d T = at(5, 6, 500);
  const meam::BOPErrors turned =
    meam::BOPEvaluation(parts::rectangle(40, 40), symmetries).errors(T * half, T, wall(600));
  EXPECT_NEAR(turned.add, 40.0 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(turned.adi, 0.0, 1e-4);
  EXPECT_NEAR(turned.mssd, 0.0, 1e-9);
  EXPECT_NEAR(turned.mspd, 0.0, 1e-9);
  EXPECT_NEAR(
    meam::BOPEvaluation(parts::rectangle(40, 40), {}).errors(T * half, T, wall(600)).mssd, 40.0 * std::sqrt(2.0), 1e-6);
  // Any turn about an axis, to a step in which no vertex moves more than 1 % of the diameter.
  symmetries = {};
  symmetries.continuous = { { Eigen::Vector3d::UnitZ(), { 20, 20, 0 } } };
  const Eigen::Isometry3d some = meam::turnAbout(Eigen::Vector3d::UnitZ(), 1.234, { 20, 20, 0 });
  EXPECT_LT(meam::BOPEvaluation(parts::rectangle(40, 40), symmetries).errors(T * some, T, wall(600)).mssd, 0.01 * 57.0);
}

TEST(BOPEvaluation, ABallIsTheSameAnyWayItIsTurned)
{
  meam::TriangleMesh ball = parts::box({ -10, -10, -10 }, { 10, 10, 10 }); // that it is one is said below
  meam::Symmetries symmetries;
  for (int axis = 0; axis < 3; ++axis)
  {
    symmetries.continuous.push_back({ Eigen::Vector3d::Unit(axis), Eigen::Vector3d::Zero() });
  }
  ball.vertices.emplace_back(1e4f, 0.0f, -900.0f); // of no triangle
  const meam::BOPEvaluation evaluation(ball, symmetries);
  const Eigen::Isometry3d T = at(5, 6, 500);
  std::mt19937 random(4);
  Eigen::Isometry3d turned = T;
  turned.rotate(parts::motion(random, 1.0).linear());
  const meam::BOPErrors errors = evaluation.errors(turned, T, wall(600));
  EXPECT_NEAR(errors.mssd, 0.0, 1e-6);
  EXPECT_NEAR(errors.mspd, 0.0, 1e-6);
}

TEST(BOPEvaluation, FarAlongTheRayIsNearOnTheImage)
{
  const meam::BOPEvaluation evaluation(parts::rectangle(40, 40), {});
  const meam::BOPRecall recall =
    evaluation.recall({ pose(at(-20, -20, 5120)) }, { pose(at(-20, -20, 5000)) }, wall(6000));
  EXPECT_EQ(recall.mssd[9], 0.0);
  EXPECT_EQ(recall.vsd[9], 0.0);
  EXPECT_EQ(recall.mspd[0], 1.0);
}

TEST(BOPEvaluation, CopiesThatNeedNotBeFoundTakeNoPose)
{
  const meam::BOPEvaluation evaluation(parts::rectangle(40, 40), {});
  const meam::Poses truths = { pose(at(0, 0, 505), 0.05), pose(at(0, 0, 500), 0.9) };
  EXPECT_EQ(evaluation.recall({ pose(at(0, 0, 503)) }, truths, wall(600)).add[1], 1.0);
}

TEST(BOPEvaluation, RecallCountsEveryCopyOnce)
{
  const meam::BOPEvaluation evaluation(parts::rectangle(40, 40), {}, 50.0);
  const meam::Poses truths = { pose(at(-60, -50, 500)), pose(at(20, 20, 500)), pose(at(100, 0, 500), 0.05) };
  // One right, the same again, one 6 mm off: the third pose is one too many for two targets.
  const meam::Poses estimates = { pose(at(-60, -50, 500)), pose(at(26, 20, 500)), pose(at(20, 20, 500)) };
  const meam::BOPRecall recall = evaluation.recall(estimates, truths, wall(600));
  EXPECT_EQ(recall.targets, 2);
  EXPECT_EQ(recall.mssd[0], 1.0); // 2.5 mm
  EXPECT_EQ(recall.mssd[1], 1.0); // 5 mm
  EXPECT_EQ(recall.mssd[2], 2.0); // 7.5 mm
  EXPECT_EQ(recall.add[9], 2.0);
  EXPECT_EQ(recall.mspd[0], 1.0); // 3.6 pixels against 2.5
  EXPECT_EQ(recall.mspd[1], 2.0);
  EXPECT_EQ(recall.vsd[0], 1.0);
  const meam::BOPRecall twice = evaluation.recall({ estimates[0], estimates[0] }, truths, wall(600));
  EXPECT_EQ(twice.mssd[9], 1.0);
  EXPECT_EQ(evaluation.recall({}, truths, wall(600)).mssd[9], 0.0);
  EXPECT_EQ(evaluation.recall(estimates, {}, wall(600)).targets, 0);
}

TEST(BOPEvaluation, AveragePrecisionAt2To20Millimeters)
{
  const meam::BOPEvaluation evaluation(parts::rectangle(40, 40), {});
  const meam::Poses truths = { pose(at(0, 0, 500)), pose(at(100, 0, 500)), pose(at(200, 0, 500), 0.05) };
  // 3 mm off, in the wrong place, 9 mm off, and one of the copy that need not be found, which does not count.
  meam::Poses estimates = { pose(at(3, 0, 500)), pose(at(50, 0, 500)), pose(at(100, 9, 500)), pose(at(200, 0, 500)) };
  for (int i = 0; i < 4; ++i)
  {
    estimates[i].score = 0.9 - 0.1 * i;
  }
  meam::BOPRanking ranking = evaluation.ranking(estimates, truths);
  EXPECT_EQ(ranking.targets, 2);
  EXPECT_EQ(ranking.poses[0].size(), 3u);
  // Nothing at 2 mm; precision 1 up to a recall of 1/2 (51 of 101 steps) at 4 to 8 mm, then 2/3 at 10 to 20 mm.
  EXPECT_NEAR(ranking.averagePrecision(), 10.0 * (3.0 * 51.0 + 6.0 * (51.0 + 50.0 * 2.0 / 3.0)) / 101.0, 1e-9);
  // A likelier wrong pose in another image: 1/2 in place of 1, and of 2/3.
  estimates[0].score = 0.95;
  ranking.add(evaluation.ranking({ estimates[0] }, {}));
  EXPECT_NEAR(ranking.averagePrecision(), 10.0 * (3.0 * 51.0 / 2.0 + 6.0 * 101.0 / 2.0) / 101.0, 1e-9);
  EXPECT_TRUE(std::isnan(evaluation.ranking(estimates, {}).averagePrecision()));
  EXPECT_EQ(evaluation.ranking({}, truths).averagePrecision(), 0.0);
  // The same pose twice is right once.
  EXPECT_FALSE(evaluation.ranking({ estimates[0], estimates[0] }, truths).poses[9][1].second);
}

TEST(BOPEvaluation, TheCameraIsFoundFromTheScan)
{
  meam::OrganizedCloud scan = wall(700);
  scan.points[5000] = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  const meam::Camera camera = meam::cameraOfCloud(scan);
  EXPECT_NEAR(camera.fx, Focal, 1e-3);
  EXPECT_NEAR(camera.fy, Focal, 1e-3);
  EXPECT_NEAR(camera.cx, CX, 1e-3);
  EXPECT_NEAR(camera.cy, CY, 1e-3);
}

TEST(BOPEvaluation, BadInput)
{
  EXPECT_THROW(meam::BOPEvaluation(meam::TriangleMesh{ { { 0, 0, 0 } }, {} }, {}), meam::Error);
  meam::OrganizedCloud scan = wall(700);
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    scan.points[i].x() += 0.01f * (i % 977); // of no pinhole camera
  }
  EXPECT_THROW(meam::cameraOfCloud(scan), meam::Error);
  EXPECT_THROW(meam::cameraOfCloud({ 2, 1, { { 0, 0, 0 }, { 0, 0, 0 } } }), meam::Error);
}
