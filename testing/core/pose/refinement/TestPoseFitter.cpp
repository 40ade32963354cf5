// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseFitter.h"

#include "TestScene.h"

namespace
{
using Eigen::Vector3d;

/// One bracket on the table, and its pose in the scene's local frame.
struct OneBracket
{
  OneBracket()
    : scene(scenes::prepared(scenes::withTangents(scenes::seenFromAbove({ T_scene_model }))))
    , pose(meam::toLocalFrame({ scenes::displaced(T_scene_model) }, scene.T_local_scene(), model.symmetries)[0])
    , fitter(scene, model)
  {
  }

  const meam::TrainedModel& model = scenes::bracket();
  Eigen::Isometry3d T_scene_model = scenes::lying(0, 0, 20);
  meam::Scene scene;
  meam::Pose pose;
  meam::PoseFitter fitter;
};

meam::Pose shifted(meam::Pose pose, const Vector3d& by)
{
  pose.T_scene_model.pretranslate(by);
  return pose;
}
}

TEST(PoseFitter, TukeysWeight)
{
  EXPECT_EQ(meam::tukeyWeight(0.0, 2.0), 1.0);
  EXPECT_EQ(meam::tukeyWeight(2.0, 2.0), 0.25); // (1 - 2 / 4)^2
  EXPECT_EQ(meam::tukeyWeight(4.0, 2.0), 0.0);
  EXPECT_EQ(meam::tukeyWeight(9.0, 2.0), 0.0);
}

TEST(PoseFitter, MotionsAreAboutThePartsMiddle)
{
  const OneBracket one;
  meam::PoseFitter::Twist turn = meam::PoseFitter::Twist::Zero();
  const double angle = 0.1;
  turn[2] = 0.5 * one.model.diameter * angle; // what it moves half a diameter away
  const Eigen::Isometry3d motion = one.fitter.motionOf(one.pose, turn);
  const Vector3d middle = one.fitter.middle(one.pose.T_scene_model);
  EXPECT_NEAR((motion * middle - middle).norm(), 0.0, 1e-9);
  EXPECT_NEAR(Eigen::AngleAxisd(motion.linear()).angle(), angle, 1e-12);

  meam::PoseFitter::Twist any;
  any << 1.0, -2.0, 0.5, 3.0, 4.0, -5.0;
  EXPECT_NEAR((one.fitter.twistOf(one.pose, one.fitter.motionOf(one.pose, any)) - any).norm(), 0.0, 1e-9);
  EXPECT_TRUE(one.fitter.motionOf(one.pose, meam::PoseFitter::Twist::Zero()).isApprox(Eigen::Isometry3d::Identity()));
}

TEST(PoseFitter, ATruePoseIsFixedAndFits)
{
  const OneBracket one;
  const double limit = 0.03 * one.model.diameter;
  const meam::PoseFit fit = one.fitter.fitAt(one.pose, limit);
  EXPECT_EQ(fit.constrained, 6);
  EXPECT_LT(fit.residual, 0.5);
  EXPECT_NEAR(fit.constrainedAxes.sum(), 6.0, 1e-9);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_GT(fit.covariance(i, i), 0.0);
  }
  const meam::PoseFit beside = one.fitter.fitAt(shifted(one.pose, { 0.0, 0.0, 1.0 }), limit);
  EXPECT_GT(beside.residual, fit.residual);
}

TEST(PoseFitter, CorrespondencesLeadBack)
{
  const OneBracket one;
  const Vector3d off(0.8, -0.6, 0.5);
  const meam::Pose pose = shifted(one.pose, off);
  meam::VisiblePart part;
  EXPECT_TRUE(one.fitter.update(part, pose, 1));
  EXPECT_FALSE(one.fitter.update(part, pose, 1)); // the sensor looks from the same side
  const auto found = one.fitter.correspondences(pose.T_scene_model, part, 0.05 * one.model.diameter);
  EXPECT_TRUE(one.fitter.isFixed(found));
  EXPECT_LT(found.remaining, 0.5 * found.squares);
  const Vector3d middle = one.fitter.middle(pose.T_scene_model);
  EXPECT_LT((found.motion * middle - (middle - off)).norm(), 0.5 * off.norm());
}

TEST(PoseFitter, WhereNothingCorrespondsNothingIsKnown)
{
  const OneBracket one;
  const meam::Pose away = shifted(one.pose, { 1000.0, 0.0, 0.0 });
  const meam::PoseFit fit = one.fitter.fitAt(away, 0.03 * one.model.diameter);
  EXPECT_EQ(fit.constrained, 0);
  const double radius = 0.5 * one.model.diameter;
  EXPECT_NEAR(fit.covariance(0, 0), 1.0, 1e-12); // a radian
  EXPECT_NEAR(fit.covariance(3, 3), radius * radius, 1e-9);
  EXPECT_FALSE(one.fitter.isFixed({}));
}

TEST(PoseFitter, OnePlaneFixesThreeOfSixMotions)
{
  const OneBracket one;
  meam::NormalEquations plane(one.fitter.middle(one.pose.T_scene_model));
  for (const double x : { -20.0, 20.0 })
  {
    for (const double y : { -20.0, 20.0 })
    {
      plane.add(one.fitter.middle(one.pose.T_scene_model) + Vector3d(x, y, 0.0), Vector3d::UnitZ(), 0.0);
    }
  }
  const auto found = plane.result();
  EXPECT_FALSE(one.fitter.isFixed(found));
  EXPECT_EQ(one.fitter.poseFit(one.pose, found, 0.0, 7).constrained, 3); // along z, and the two turns that tilt it
  EXPECT_EQ(one.fitter.poseFit(one.pose, found, 4.0, 7).residual, 1.0);  // of four points with squares 4 in all
  EXPECT_EQ(one.fitter.poseFit(one.pose, found, 0.0, 7).iterations, 7);
}
