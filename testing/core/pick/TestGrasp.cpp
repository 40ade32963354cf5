// SPDX-License-Identifier: BSD-3-Clause
#include "pick/Grasp.h"

#include "base/Error.h"

#include <gtest/gtest.h>

TEST(Grasp, ItsFrameIsMadeOfTwoDirections)
{
  const Eigen::Isometry3d frame = meam::graspFrame({ 1, 2, 3 }, { 0, 0, -2 }, { 3, 0, 1 });
  EXPECT_TRUE(frame.translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  EXPECT_TRUE(frame.linear().col(0).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(frame.linear().col(2).isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_NEAR(frame.linear().determinant(), 1.0, 1e-12);
  EXPECT_THROW(meam::graspFrame({ 0, 0, 0 }, { 0, 0, 1 }, { 0, 0, 2 }), meam::Error);
  EXPECT_THROW(meam::graspFrame({ 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }), meam::Error);
}

TEST(Grasp, RefusesWhatIsNone)
{
  meam::Grasp grasp;
  EXPECT_NO_THROW(meam::requireGrasp(grasp));
  grasp.width = -1.0;
  EXPECT_THROW(meam::requireGrasp(grasp), meam::Error);
  grasp = {};
  grasp.quality = 1.5;
  EXPECT_THROW(meam::requireGrasp(grasp), meam::Error);
  grasp = {};
  grasp.kind = meam::GraspKind::Suction;
  grasp.freeTurn = meam::FreeTurn::Closing;
  EXPECT_THROW(meam::requireGrasp(grasp), meam::Error);
  grasp = {};
  grasp.T_model_grasp.linear() *= 2.0;
  EXPECT_THROW(meam::requireGrasp(grasp), meam::Error);
}
