// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/CommonDifferences.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
meam::TriangleMesh blockOnCorner() { return parts::blockOnPlate(false); }

meam::TriangleMesh pin(double radiusOfHead)
{
  return parts::revolved(
    { { 0.0, 0.0 }, { radiusOfHead, 0.0 }, { radiusOfHead, 3.0 }, { 4.0, 3.0 }, { 4.0, 50.0 }, { 0.0, 50.0 } }, 48);
}

meam::TriangleMesh pinWithHead() { return pin(8.0); }
meam::TriangleMesh plainPin() { return pin(4.0); }

/// A mesh with its vertices at so much along an axis moved.
meam::TriangleMesh stretched(meam::TriangleMesh mesh, int axis, float from, float to)
{
  for (Eigen::Vector3f& vertex : mesh.vertices)
  {
    if (vertex[axis] == from)
    {
      vertex[axis] = to;
    }
  }
  return mesh;
}

/// Else the plates' tops would be taken for it.
scenes::Copy floor(float length)
{
  return { parts::box({ -10.0f, -10.0f, -5.0f }, { length, 70.0f, 0.0f }), scenes::lying(0, 0, 0) };
}

using Places = std::vector<Eigen::Isometry3d>;

Places apart(int copies)
{
  Places places;
  for (int i = 0; i < copies; ++i)
  {
    places.push_back(scenes::lying(100.0 * (i % 2), 100.0 * (i / 2), 70.0 * i));
  }
  return places;
}

Places pinsApart(int copies = 4)
{
  Places places = apart(copies);
  for (Eigen::Isometry3d& place : places)
  {
    place = place * Eigen::Translation3d(0.0, 0.0, 8.0) * Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitY());
  }
  return places;
}

Places inRow(int copies, double distance)
{
  Places places;
  for (int i = 0; i < copies; ++i)
  {
    places.push_back(scenes::lying(distance * i, 0.0, 0.0));
  }
  return places;
}

/// In what copies of another part at these places, and what else lies there, differ from a part: from a plate with a
/// block on one corner.
meam::CommonDifferences differencesOn(const Places& places, const meam::TriangleMesh& other,
  const std::vector<scenes::Copy>& beside = {}, std::size_t most = 20,
  const meam::TrainedModel& model = scenes::trained<blockOnCorner>(),
  const Eigen::Isometry3d& turnOfEverySecond = Eigen::Isometry3d::Identity())
{
  std::vector<scenes::Copy> lying = beside;
  for (const Eigen::Isometry3d& place : places)
  {
    lying.push_back({ other, lying.size() % 2 == 0 ? place : place * turnOfEverySecond });
  }
  const meam::Scene scene =
    scenes::prepared(scenes::withTangents(scenes::seenFromAbove(lying), model.diameter), model.diameter);
  meam::Poses poses(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    poses[i].T_scene_model = scene.T_local_scene() * places[i];
  }
  const meam::Poses telling(poses.begin(), poses.begin() + std::min(most, poses.size()));
  const meam::CommonDifferences differences = meam::commonDifferences(telling, poses, scene, model, 1);
  const meam::CommonDifferences inParallel = meam::commonDifferences(telling, poses, scene, model, 4);
  EXPECT_EQ(inParallel.missing, differences.missing);
  EXPECT_EQ(inParallel.surplus, differences.surplus);
  return differences;
}
}

TEST(CommonDifferences, ThePartItselfHasNone)
{
  const meam::CommonDifferences differences = differencesOn(apart(4), blockOnCorner());
  EXPECT_EQ(differences.missing, 0);
  EXPECT_EQ(differences.surplus, 0);
}

TEST(CommonDifferences, ABlockThatIsElsewhereIsMissing)
{
  // Its top, 20 x 12 mm but for its rim, in patches of 5.2 x 5.2 mm.
  const int missing = differencesOn(apart(4), parts::blockOnPlate(true)).missing;
  EXPECT_GE(missing, 2);
  EXPECT_LE(missing, 5 * 4);
}

TEST(CommonDifferences, ARingIsSeveralPatches)
{
  // The head of a pin, 3 mm high: one ring of patches of 3 mm.
  const meam::TrainedModel& model = scenes::trained<pinWithHead>();
  EXPECT_EQ(differencesOn(pinsApart(), pinWithHead(), {}, 20, model).missing, 0);
  EXPECT_GE(differencesOn(pinsApart(), plainPin(), {}, 20, model).missing, 1);
}

TEST(CommonDifferences, ARingBeforeThePartIsSurplus)
{
  const meam::TrainedModel& model = scenes::trained<plainPin>();
  EXPECT_EQ(differencesOn(pinsApart(), plainPin(), {}, 20, model).surplus, 0);
  const meam::TriangleMesh collar = parts::revolved({ { 0.0, 0.0 }, { 4.0, 0.0 }, { 4.0, 20.0 }, { 8.0, 20.0 },
                                                      { 8.0, 30.0 }, { 4.0, 30.0 }, { 4.0, 50.0 }, { 0.0, 50.0 } },
    48);
  EXPECT_GE(differencesOn(pinsApart(), collar, {}, 20, model).surplus, 1);
}

TEST(CommonDifferences, CopiesOfASymmetricPartAreTurnedAlike)
{
  // A collar near one end; half of the pins have it at the other.
  const meam::TriangleMesh collar = parts::revolved({ { 0.0, 0.0 }, { 4.0, 0.0 }, { 4.0, 8.0 }, { 8.0, 8.0 },
                                                      { 8.0, 18.0 }, { 4.0, 18.0 }, { 4.0, 50.0 }, { 0.0, 50.0 } },
    48);
  const Eigen::Isometry3d halfTurn =
    Eigen::Translation3d(0.0, 0.0, 50.0) * Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  EXPECT_GE(differencesOn(pinsApart(10), collar, {}, 20, scenes::trained<plainPin>(), halfTurn).surplus, 1);
  EXPECT_EQ(differencesOn(pinsApart(10), plainPin(), {}, 20, scenes::trained<plainPin>(), halfTurn).surplus, 0);
  EXPECT_EQ(differencesOn(pinsApart(6), collar, {}, 20, scenes::trained<plainPin>(), halfTurn).surplus, 0) << "too few";
}

TEST(CommonDifferences, WhatLiesOnThePartSomewhereIsNone)
{
  std::vector<scenes::Copy> bars; // across each pin at another place, and through none
  for (const Eigen::Isometry3d& place : apart(4))
  {
    const float x = 4.0f + 10.0f * static_cast<float>(bars.size());
    bars.push_back({ parts::box({ x, -15.0f, 13.0f }, { x + 8.0f, 15.0f, 17.0f }), place });
  }
  EXPECT_EQ(differencesOn(pinsApart(), plainPin(), bars, 20, scenes::trained<plainPin>()).surplus, 0);
}

TEST(CommonDifferences, ThreeCopiesTellNothing)
{
  EXPECT_EQ(differencesOn(apart(3), parts::blockOnPlate(true)).missing, 0);
}

TEST(CommonDifferences, ANarrowStripOfTheBlockIsMissing)
{
  EXPECT_GE(differencesOn(apart(4), stretched(blockOnCorner(), 0, 40.0f, 46.0f)).missing,
    1); // its inner side: 8 % of the diameter
}

TEST(CommonDifferences, SurfaceOfALongerPlateGoesOn)
{
  const meam::TriangleMesh longer = stretched(blockOnCorner(), 1, 40.0f, 52.0f); // beyond what sensors smear
  const meam::CommonDifferences differences = differencesOn(inRow(5, 90.0), longer, { floor(430.0f) });
  EXPECT_EQ(differences.missing, 0);
  EXPECT_GE(differences.surplus, 5); // along 60 mm
  EXPECT_LE(differences.surplus, 2 * 13);
}

TEST(CommonDifferences, ACopyThatTouchesIsNoSurfaceThatGoesOn)
{
  EXPECT_EQ(differencesOn(inRow(6, 60.0), blockOnCorner(), { floor(370.0f) }, 5).surplus, 0); // plates of 60 mm
}
