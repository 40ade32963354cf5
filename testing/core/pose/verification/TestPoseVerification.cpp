// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseVerification.h"

#include "TestScene.h"
#include "base/sequences/Sequences.h"

#include <gtest/gtest.h>

namespace
{
meam::Pose at(const Eigen::Isometry3d& T) { return scenes::displaced(T); }

double scoreOf(const meam::Pose& pose, const meam::Scene& in, const meam::PoseVerificationSettings& settings = {})
{
  const meam::Poses verified = scenes::verify({ pose }, in, scenes::bracket(), settings);
  return verified.empty() ? 0.0 : verified[0].score;
}
}

TEST(PoseVerification, TheTruePoseScoresBest)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const double truth = scoreOf(at(T), scenes::copiesScene());
  EXPECT_GT(truth, 0.8);
  EXPECT_LE(truth, 1.0);
  EXPECT_LT(scoreOf(scenes::displaced(T, 8.0, 0.0), scenes::copiesScene()), truth - 0.1);
  EXPECT_LT(scoreOf(scenes::displaced(T, 0.0, 25.0), scenes::copiesScene()), truth - 0.1);
  EXPECT_LT(scoreOf(scenes::displaced(T, 500.0, 0.0), scenes::copiesScene()), 0.01); // where there is nothing
}

TEST(PoseVerification, TheFlippedPartIsWorse)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  // The same place and the same height, turned upside down about the long leg.
  Eigen::Isometry3d flipped = T;
  flipped.translate(Eigen::Vector3d(0, 20, 7.5));
  flipped.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  flipped.translate(Eigen::Vector3d(0, -20, -7.5));
  EXPECT_LT(scoreOf(at(flipped), scenes::copiesScene()), scoreOf(at(T), scenes::copiesScene()) - 0.1);
}

TEST(PoseVerification, WithoutASurfaceEdgesDecide)
{
  scenes::Seen bare = scenes::seenCopies();
  bare.surface.clear();
  const meam::Scene edgesOnly = scenes::prepared(bare);
  const Eigen::Isometry3d T = scenes::threeCopies()[1];
  EXPECT_GT(scoreOf(at(T), edgesOnly), 0.8);
  EXPECT_LT(scoreOf(scenes::displaced(T, 8.0, 0.0), edgesOnly), scoreOf(at(T), edgesOnly) - 0.2);
}

TEST(PoseVerification, APartUnderAPlateIsHiddenNotWrong)
{
  scenes::Seen covered = scenes::seenCopies();
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const double before = scenes::verify({ at(T) }, scenes::copiesScene(), scenes::bracket())[0].visibleFraction;
  // A plate 30 mm above half of the part; it hides the points below it.
  meam::Points visible;
  const auto under = [&](const Eigen::Vector3f& p)
  { return p.x() < 25.0f && p.x() > -60.0f && std::abs(p.y()) < 70.0f; };
  std::copy_if(covered.surface.begin(), covered.surface.end(), std::back_inserter(visible),
    [&](const auto& p) { return !under(p); });
  parts::add(visible, parts::lattice({ -60, -70 }, { 24.7f, 70 }, 0.7f, 30.0f));
  covered.surface = visible;
  const std::vector<int> edges =
    meam::indicesWhere(covered.edges.size(), [&](int i) { return !under(covered.edges.points[i]); });
  covered.edges = covered.edges.subset(edges);
  const meam::Pose pose = scenes::verify({ at(T) }, scenes::prepared(covered), scenes::bracket())[0];
  EXPECT_LT(pose.visibleFraction, before - 0.2);
  EXPECT_GT(pose.visibleFraction, 0.2);
  // What is left to see still fits.
  EXPECT_GT(pose.score, 0.75);
}

TEST(PoseVerification, PosesComeBestFirstForAnyNumberOfThreads)
{
  meam::Poses poses;
  for (const auto& T : scenes::threeCopies())
  {
    for (const double off : { 2.0, 0.0, 1.0 })
    {
      poses.push_back(scenes::displaced(T, off, off));
    }
  }
  meam::PoseVerificationSettings settings;
  settings.threads = 1;
  const meam::Poses one = scenes::verify(poses, scenes::copiesScene(), scenes::bracket(), settings);
  settings.threads = 3;
  const meam::Poses three = scenes::verify(poses, scenes::copiesScene(), scenes::bracket(), settings);
  ASSERT_EQ(one.size(), 9u) << "none goes";
  EXPECT_TRUE(scenes::areSame(one, three));
  EXPECT_TRUE(std::is_sorted(one.begin(), one.end(), meam::isBetter));
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(std::count_if(poses.begin(), poses.end(),
                [&](const meam::Pose& pose) { return pose.T_scene_model.isApprox(one[i].T_scene_model, 1e-9); }),
      1)
      << "where it was";
  }
}

TEST(PoseVerification, OfEachViewTheBestStay)
{
  // One copy is seen from above, one from below.
  meam::Poses poses;
  for (const std::size_t copy : { 0u, 1u })
  {
    for (const double off : { 2.0, 0.0, 1.0 })
    {
      poses.push_back(scenes::displaced(scenes::threeCopies()[copy], off, 0.0));
    }
  }
  meam::PoseVerificationSettings settings;
  settings.posesPerView = 1;
  const meam::Poses best = scenes::verify(poses, scenes::copiesScene(), scenes::bracket(), settings);
  ASSERT_EQ(best.size(), 2u);
  EXPECT_NE(best[0].viewId, best[1].viewId);
  for (const meam::Pose& pose : best)
  {
    const auto& truth = scenes::threeCopies();
    EXPECT_TRUE(std::any_of(truth.begin(), truth.begin() + 2,
      [&](const Eigen::Isometry3d& T) { return meam::translationError(pose.T_scene_model, T) < 1e-6; }));
  }
}

TEST(PoseVerification, RightPosesAreLikelyAndWrongOnesAreNot)
{
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const meam::Pose right = scenes::verify({ at(T) }, scenes::copiesScene(), scenes::bracket()).at(0);
  const meam::Pose wrong =
    scenes::verify({ scenes::displaced(T, 9.0, 20.0) }, scenes::copiesScene(), scenes::bracket()).at(0);
  EXPECT_GT(right.probability, 0.9);
  EXPECT_LT(wrong.probability, 0.1);
  EXPECT_EQ(meam::probabilityOrScore(right), right.probability);
}

TEST(PoseVerification, BadInput)
{
  const meam::Poses poses{ at(scenes::threeCopies()[0]) };
  EXPECT_TRUE(scenes::verify({}, scenes::copiesScene(), scenes::bracket()).empty());
  meam::PoseVerificationSettings settings;
  settings.pointStride = 0;
  EXPECT_THROW(scenes::verify(poses, scenes::copiesScene(), scenes::bracket(), settings), meam::Error);
  EXPECT_THROW(
    scenes::verify(poses, scenes::copiesScene(), scenes::bracket(), {}, [](double) { return false; }), meam::Aborted);
}

TEST(PoseVerification, AModelWithoutASurfaceIsVerifiedByItsEdges)
{
  meam::TrainedModel model = scenes::bracket();
  model.surface = {};
  model.deriveFields();
  scenes::Seen bare = scenes::seenCopies();
  bare.surface.clear();
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const auto poses = meam::ofIndices<meam::Pose>(8, [&](int k) { return scenes::displaced(T, 12.0 * k, 0.0); });
  const meam::Poses verified = scenes::verify(poses, scenes::copiesScene(), model);
  const meam::Poses alone = scenes::verify(poses, scenes::prepared(bare), model);
  ASSERT_EQ(verified.size(), 8u);
  ASSERT_EQ(alone.size(), 8u);
  EXPECT_LT(meam::translationError(verified[0].T_scene_model, T), 1e-6);
  EXPECT_LT(meam::translationError(alone[0].T_scene_model, T), 1e-6);
  EXPECT_GT(verified[0].probability, 0.9);
}
