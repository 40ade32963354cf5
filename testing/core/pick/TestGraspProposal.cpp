// SPDX-License-Identifier: BSD-3-Clause
#include "pick/GraspProposal.h"
#include "TestParts.h"

#include <algorithm>
#include <cmath>

namespace
{
using meam::FreeTurn;
using meam::Grasp;
using meam::GraspKind;
using meam::Grasps;

constexpr int Sides = 96; // of what is round

/// A ring around z, or with an inner radius of 0 a disc.
meam::TriangleMesh ring(double inner, double outer, double height)
{
  const double half = 0.5 * height;
  return parts::revolved({ { inner, -half }, { outer, -half }, { outer, half }, { inner, half } }, Sides);
}

/// Any turn about z, and half a turn about x.
meam::Symmetries roundAboutZ()
{
  meam::Symmetries symmetries;
  symmetries.continuous.push_back({ Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero() });
  symmetries.discrete.push_back(meam::turnAbout(Eigen::Vector3d::UnitX(), M_PI, Eigen::Vector3d::Zero()));
  return symmetries;
}

meam::Gripper cup(double diameter)
{
  meam::Gripper gripper;
  gripper.kind = GraspKind::Suction;
  gripper.cupDiameter = diameter;
  return gripper;
}

Eigen::Vector3d closing(const Grasp& grasp) { return grasp.T_model_grasp.linear().col(0); }
Eigen::Vector3d approach(const Grasp& grasp) { return grasp.T_model_grasp.linear().col(2); }

/// All are grasps, best first.
void requireAll(const Grasps& grasps)
{
  for (const Grasp& grasp : grasps)
  {
    EXPECT_NO_THROW(meam::requireGrasp(grasp));
  }
  EXPECT_TRUE(
    std::is_sorted(grasps.begin(), grasps.end(), [](const Grasp& a, const Grasp& b) { return a.quality > b.quality; }));
}
}

TEST(GraspProposal, jawsOnABox)
{
  // Only the 40 mm of x fit between the jaws.
  const auto box = parts::box({ -20, -50, -60 }, { 20, 50, 60 });
  const Grasps grasps = meam::proposeGrasps(box, {}, meam::Gripper());
  ASSERT_GT(grasps.size(), 4u);
  requireAll(grasps);
  for (const Grasp& grasp : grasps)
  {
    EXPECT_EQ(grasp.kind, GraspKind::Parallel);
    EXPECT_NEAR(grasp.width, 40.0, 1e-4);
    EXPECT_NEAR(std::abs(closing(grasp).x()), 1.0, 1e-9);
    EXPECT_NEAR(grasp.T_model_grasp.translation().x(), 0.0, 1e-4);
    // Fingers of 50 mm reach 44 mm down to the grasp: the body stays outside.
    const Eigen::Vector3d body = grasp.T_model_grasp * Eigen::Vector3d(0, 0, -44);
    EXPECT_FALSE(Eigen::AlignedBox3d(Eigen::Vector3d(-20, -50, -60), Eigen::Vector3d(20, 50, 60)).contains(body));
  }
  EXPECT_GT(grasps.front().quality, 0.5);
}

TEST(GraspProposal, theBestGraspIsAtTheCentreOfMass)
{
  const auto box = parts::box({ 100, 100, 100 }, { 120, 140, 130 });
  const Grasps grasps = meam::proposeGrasps(box, {}, meam::Gripper());
  ASSERT_FALSE(grasps.empty());
  EXPECT_TRUE(grasps.front().T_model_grasp.translation().isApprox(Eigen::Vector3d(110, 120, 115), 1e-6));
  EXPECT_EQ(grasps.front().quality, 1.0);
}

TEST(GraspProposal, aPartThatIsTooWideIsNotGrasped)
{
  const auto cube = parts::box({ 0, 0, 0 }, { 55, 55, 55 }); // and 3 mm of clearance on each side
  EXPECT_TRUE(meam::proposeGrasps(cube, {}, meam::Gripper()).empty());
  meam::Gripper wide;
  wide.opening = 61.001;
  EXPECT_FALSE(meam::proposeGrasps(cube, {}, wide).empty());
}

TEST(GraspProposal, jawsOnADiscMayBeTurned)
{
  const Grasps grasps = meam::proposeGrasps(ring(0, 30, 10), roundAboutZ(), meam::Gripper());
  ASSERT_FALSE(grasps.empty());
  requireAll(grasps);
  // The two faces, at the middle, any way in: the one grasp there.
  const Grasp& best = grasps.front();
  EXPECT_NEAR(best.width, 10.0, 1e-5);
  EXPECT_NEAR(std::abs(closing(best).z()), 1.0, 1e-9);
  EXPECT_TRUE(best.T_model_grasp.translation().isZero(1e-5));
  EXPECT_EQ(best.freeTurn, FreeTurn::Closing);
  EXPECT_EQ(best.quality, 1.0);
  const auto alike = [](const Grasp& grasp)
  { return std::abs(closing(grasp).z()) > 0.99 && grasp.T_model_grasp.translation().norm() < 6.0; };
  EXPECT_EQ(std::count_if(grasps.begin(), grasps.end(), alike), 1);
}

TEST(GraspProposal, aPinIsHeldFromItsEnd)
{
  // 12 mm thick, 40 mm high: from above it may be turned about its axis.
  const Grasps grasps = meam::proposeGrasps(ring(0, 6, 40), roundAboutZ(), meam::Gripper());
  requireAll(grasps);
  const auto fromEnd = [](const Grasp& grasp)
  { return std::abs(approach(grasp).z()) > 0.99 && grasp.freeTurn == FreeTurn::Approach; };
  const auto found = std::find_if(grasps.begin(), grasps.end(), fromEnd);
  ASSERT_NE(found, grasps.end());
  EXPECT_NEAR(found->width, 12.0, 0.02);
  EXPECT_NEAR(found->T_model_grasp.translation().head<2>().norm(), 0.0, 0.1);
}

TEST(GraspProposal, aRingIsHeldAcrossItsWall)
{
  // A wall of 5 mm; 80 mm across, it does not fit between the jaws.
  const Grasps grasps = meam::proposeGrasps(ring(35, 40, 20), roundAboutZ(), meam::Gripper());
  ASSERT_FALSE(grasps.empty());
  requireAll(grasps);
  int across = 0;
  for (const Grasp& grasp : grasps)
  {
    if (std::abs(closing(grasp).z()) > 0.99) // on the two flat faces, from outside
    {
      EXPECT_NEAR(grasp.width, 20.0, 1e-4);
      continue;
    }
    ++across;
    EXPECT_NEAR(grasp.width, 5.0, 0.1);
    const Eigen::Vector3d place = grasp.T_model_grasp.translation();
    EXPECT_NEAR(place.head<2>().norm(), 37.5, 0.1);
    EXPECT_NEAR(std::abs(place.head<2>().normalized().dot(closing(grasp).head<2>())), 1.0, 0.01);
    EXPECT_GT(std::abs(approach(grasp).z()), 0.5); // from above or below, not through the ring
  }
  EXPECT_GT(across, 0);
  // One place around the ring, and one side, stand for all.
  const auto straight = [](const Grasp& grasp) { return std::abs(approach(grasp).z()) > 0.99; };
  EXPECT_LE(std::count_if(grasps.begin(), grasps.end(), straight), 4);
  // Without the symmetries there are many.
  const Grasps all = meam::proposeGrasps(ring(35, 40, 20), {}, meam::Gripper());
  EXPECT_EQ(all.size(), 20u);
}

TEST(GraspProposal, equalPlacesOfABoxComeOnce)
{
  const auto box = parts::box({ -20, -50, -60 }, { 20, 50, 60 });
  meam::Symmetries turns;
  for (int axis = 0; axis < 3; ++axis)
  {
    turns.discrete.push_back(meam::turnAbout(Eigen::Vector3d::Unit(axis), M_PI, Eigen::Vector3d::Zero()));
  }
  meam::ProposeSettings settings;
  settings.maximumGrasps = 1000;
  const std::size_t all = meam::proposeGrasps(box, {}, meam::Gripper(), settings).size();
  const std::size_t some = meam::proposeGrasps(box, turns, meam::Gripper(), settings).size();
  EXPECT_LT(some, 0.45 * static_cast<double>(all)); // four, but for places near the axes
  EXPECT_GT(some, 0.2 * static_cast<double>(all));
}

TEST(GraspProposal, aCupSitsOnFlatSpots)
{
  // A cup of 20 mm on a disc of 60: everywhere up to 20 mm from the middle; not on the side of the disc.
  const Grasps grasps = meam::proposeGrasps(ring(0, 30, 10), {}, cup(20));
  ASSERT_FALSE(grasps.empty());
  requireAll(grasps);
  for (const Grasp& grasp : grasps)
  {
    EXPECT_EQ(grasp.kind, GraspKind::Suction);
    EXPECT_EQ(grasp.freeTurn, FreeTurn::Approach);
    EXPECT_EQ(grasp.width, 0.0);
    const Eigen::Vector3d place = grasp.T_model_grasp.translation();
    EXPECT_NEAR(std::abs(place.z()), 5.0, 1e-5);
    EXPECT_NEAR(approach(grasp).z(), place.z() > 0 ? -1.0 : 1.0, 1e-9);
    EXPECT_LE(place.head<2>().norm(), 20.1);
  }
  EXPECT_TRUE(grasps.front().T_model_grasp.translation().head<2>().isZero(1e-5));
  EXPECT_EQ(grasps.front().quality, 1.0);
  const Grasps one = meam::proposeGrasps(ring(0, 11, 10), roundAboutZ(), cup(20));
  EXPECT_EQ(one.size(), 1u); // both faces are one
  EXPECT_TRUE(meam::proposeGrasps(ring(0, 9, 10), {}, cup(20)).empty());
  EXPECT_TRUE(meam::proposeGrasps(ring(20, 30, 10), {}, cup(20)).empty()); // over the hole
  EXPECT_FALSE(meam::proposeGrasps(ring(20, 30, 10), {}, cup(8)).empty());
}

TEST(GraspProposal, theSameForAnyNumberOfThreads)
{
  meam::ProposeSettings settings;
  settings.threads = 1;
  const Grasps one = meam::proposeGrasps(parts::windowPlate(), {}, meam::Gripper(), settings);
  settings.threads = 3;
  const Grasps three = meam::proposeGrasps(parts::windowPlate(), {}, meam::Gripper(), settings);
  ASSERT_EQ(one.size(), three.size());
  ASSERT_FALSE(one.empty());
  for (std::size_t k = 0; k < one.size(); ++k)
  {
    EXPECT_EQ(one[k].T_model_grasp.matrix(), three[k].T_model_grasp.matrix());
    EXPECT_EQ(one[k].quality, three[k].quality);
    EXPECT_EQ(one[k].name, "parallel " + std::to_string(k + 1));
  }
}

TEST(GraspProposal, jawsGoThroughAWindow)
{
  // The rim of 60 x 40 mm around a window of 14 x 20 mm is held across its 6 mm when a finger fits into the window.
  meam::Gripper gripper;
  gripper.fingerThickness = 4.0;
  gripper.jawClearance = 1.0;
  gripper.opening = 11.0; // too narrow for the plate itself, which is 10 mm thick
  gripper.tipLength = 4.0;
  const Grasps grasps = meam::proposeGrasps(parts::windowPlate(), {}, gripper);
  const auto throughWindow = [](const Grasp& grasp)
  { return std::abs(grasp.width - 6.0) < 1e-4 && std::abs(approach(grasp).z()) > 0.99; };
  EXPECT_TRUE(std::any_of(grasps.begin(), grasps.end(), throughWindow));
  gripper.fingerThickness = 20.0;
  const Grasps none = meam::proposeGrasps(parts::windowPlate(), {}, gripper);
  EXPECT_FALSE(std::any_of(none.begin(), none.end(), throughWindow));
}

TEST(GraspProposal, badInput)
{
  const auto box = parts::box({ 0, 0, 0 }, { 10, 20, 30 });
  EXPECT_THROW(meam::proposeGrasps({}, {}, meam::Gripper()), meam::Error);
  meam::Gripper gripper;
  gripper.opening = -1.0;
  EXPECT_THROW(meam::proposeGrasps(box, {}, gripper), meam::Error);
  meam::ProposeSettings settings;
  settings.frictionAngle = 90.0;
  EXPECT_THROW(meam::proposeGrasps(box, {}, meam::Gripper(), settings), meam::Error);
}
