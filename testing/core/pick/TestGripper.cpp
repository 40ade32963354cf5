// SPDX-License-Identifier: BSD-3-Clause
#include "pick/Gripper.h"

#include "TestGrippers.h"
#include "base/Bounds.h"
#include "base/Error.h"

TEST(Gripper, JawsStandOpenAroundThePart)
{
  const meam::Gripper gripper = grippers::jaws();
  meam::Grasp grasp;
  grasp.width = 20.0;
  const auto pieces = meam::piecesOf(gripper, grasp);
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_NEAR(pieces[0].middle.x(), -17.0, 1e-9); // 10 + 3 + 4
  EXPECT_NEAR(pieces[1].middle.x(), 17.0, 1e-9);
  EXPECT_NEAR(pieces[1].middle.z() + 0.5 * pieces[1].size.z(), 6.0, 1e-9);
  EXPECT_NEAR(pieces[1].middle.z() - 0.5 * pieces[1].size.z(), -44.0, 1e-9);
  EXPECT_NEAR(pieces[2].middle.z() + 0.5 * pieces[2].size.z(), -44.0, 1e-9);
  // The way in goes backwards.
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const auto longer = meam::piecesOf(gripper, grasp, 40.0)[k];
    EXPECT_NEAR(longer.size.z(), pieces[k].size.z() + 40.0, 1e-9);
    EXPECT_NEAR(longer.middle.z() + 0.5 * longer.size.z(), pieces[k].middle.z() + 0.5 * pieces[k].size.z(), 1e-9);
  }
  const auto between = meam::betweenJaws(gripper, grasp);
  ASSERT_EQ(between.size(), 1u);
  EXPECT_NEAR(between[0].size.x(), 26.0, 1e-9);
}

TEST(Gripper, ItsFacesAreThoseOfItsPieces)
{
  meam::Gripper cup;
  cup.kind = meam::GraspKind::Suction;
  cup.cupDiameter = 20.0;
  cup.cupLength = 30.0;
  cup.bodyLength = 100.0;
  cup.bodyWidth = 60.0;
  meam::Grasp grasp;
  grasp.kind = meam::GraspKind::Suction;
  const auto mesh = meam::meshOf(cup, grasp);
  EXPECT_NO_THROW(meam::requireMesh(mesh));
  const auto box = meam::bounds(mesh.vertices);
  EXPECT_NEAR(box.max().z(), 0.0, 1e-5);
  EXPECT_NEAR(box.min().z(), -130.0, 1e-5);
  EXPECT_NEAR(box.max().x(), 30.0, 1e-5);
  // Outward: the volume that the faces enclose is positive, that of the two prisms.
  const double prism = 0.5 * 24 * std::sin(2.0 * M_PI / 24); // of a circle with radius 1
  EXPECT_NEAR(parts::volume(mesh), prism * (100.0 * 30.0 + 900.0 * 100.0), 1.0);
}

TEST(Gripper, RefusesLengthsThatAreNone)
{
  meam::Gripper gripper;
  gripper.opening = 0.0;
  EXPECT_THROW(meam::requireGripper(gripper), meam::Error);
  gripper = {};
  gripper.tipLength = gripper.fingerLength;
  EXPECT_THROW(meam::requireGripper(gripper), meam::Error);
  EXPECT_NO_THROW(meam::requireGripper({}));
}
