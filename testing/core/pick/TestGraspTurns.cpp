// SPDX-License-Identifier: BSD-3-Clause
#include "pick/GraspTurns.h"

#include <gtest/gtest.h>

namespace
{
using Eigen::Vector3d;

meam::Symmetries disc()
{
  meam::Symmetries result;
  result.continuous.push_back({ Vector3d::UnitZ(), Vector3d::Zero() });
  result.discrete.push_back(meam::turnAbout(Vector3d::UnitX(), M_PI, Vector3d::Zero()));
  return result;
}
}

TEST(GraspTurns, OfADiscGoAroundItOnBothSides)
{
  EXPECT_EQ(meam::turnsOf({}, 30.0).size(), 1u);
  EXPECT_EQ(meam::turnsOf(disc(), 30.0).size(), 24u);
  EXPECT_TRUE(meam::turnsOf(disc(), 30.0).front().isApprox(Eigen::Isometry3d::Identity()));
}

TEST(GraspTurns, FramesThatAreEqualComeOnce)
{
  // From above in the middle of the disc: its own turns and the free one are the same.
  meam::Grasp cup;
  cup.kind = meam::GraspKind::Suction;
  cup.T_model_grasp = meam::graspFrame({ 0, 0, 5 }, { 0, 0, -1 }, { 1, 0, 0 });
  cup.freeTurn = meam::FreeTurn::Approach;
  const auto frames = meam::framesOf(cup, meam::turnsOf(disc(), 30.0), 30.0, 50.0);
  ASSERT_EQ(frames.size(), 24u);
  EXPECT_TRUE(frames.front().isApprox(cup.T_model_grasp));
  for (const auto& frame : frames)
  {
    EXPECT_NEAR(std::abs(frame.translation().z()), 5.0, 1e-9);
    EXPECT_NEAR(frame.linear().col(2).z() * frame.translation().z(), -5.0, 1e-9); // always from outside
  }
}

TEST(GraspTurns, AJawsFreeTurnKeepsTheClosingAxis)
{
  meam::Grasp rim;
  rim.T_model_grasp = meam::graspFrame({ 20, 0, 0 }, { 0, -1, 0 }, { 0, 0, 1 });
  rim.freeTurn = meam::FreeTurn::Closing;
  const auto frames = meam::framesOf(rim, meam::turnsOf({}, 30.0), 90.0, 50.0);
  ASSERT_EQ(frames.size(), 4u);
  for (const auto& frame : frames)
  {
    EXPECT_NEAR(frame.linear().col(0).z(), 1.0, 1e-9);
    EXPECT_TRUE(frame.translation().isApprox(Vector3d(20, 0, 0)));
  }
}
