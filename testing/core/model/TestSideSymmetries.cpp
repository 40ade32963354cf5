// SPDX-License-Identifier: BSD-3-Clause
#include "model/SideSymmetries.h"

#include "TestScene.h"

namespace
{
/// A disc of 20 mm radius with a bar on it, beside its middle.
meam::TriangleMesh barOnDisc()
{
  return parts::joined(parts::regularPrism(90, 20.0, 6.0f), parts::box({ 2.0f, -12.0f, 3.0f }, { 8.0f, 12.0f, 26.0f }));
}

meam::TriangleMesh wallOnPlate()
{
  return parts::joined(parts::box({ -20.0f, -20.0f, 0.0f }, { 20.0f, 20.0f, 6.0f }),
    parts::box({ -20.0f, -4.0f, 3.0f }, { 20.0f, 4.0f, 40.0f }));
}

meam::TriangleMesh hexagon() { return parts::regularPrism(6, 20.0, 8.0f); }

/// The turns of the side that shows from there.
std::vector<Eigen::Isometry3d> turnsFrom(const meam::TrainedModel& model, const Eigen::Vector3f& towards)
{
  for (const meam::SideSymmetry& side : model.sides->of(model))
  {
    if (side.towards.dot(towards) > 0.999f)
    {
      return side.turns;
    }
  }
  return {};
}

const Eigen::Vector3f Up = Eigen::Vector3f::UnitZ();
}

TEST(SideSymmetries, ThePlainBackOfATowerLooksTheSameAfterHalfATurn)
{
  const std::vector<Eigen::Isometry3d> turns = turnsFrom(scenes::trained<parts::tower>(), -Up);
  ASSERT_EQ(turns.size(), 1u);
  const Eigen::Isometry3d half =
    meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI, Eigen::Vector3d(30.0, 20.0, 0.0)); // the middle of the plate
  EXPECT_TRUE(scenes::areNear(turns[0], half, 0.5, 0.5));
}

TEST(SideSymmetries, TheTowerItselfIsSeenFromAbove)
{
  EXPECT_TRUE(turnsFrom(scenes::trained<parts::tower>(), Up).empty());
}

TEST(SideSymmetries, TheBackOfADiscLooksTheSameHoweverItIsTurned)
{
  const std::vector<Eigen::Isometry3d> turns = turnsFrom(scenes::trained<barOnDisc>(), -Up);
  EXPECT_EQ(turns.size(), 33u) << "in steps of 10 degrees, but for the smallest";
  for (const Eigen::Isometry3d& turn : turns)
  {
    EXPECT_LT((turn * Eigen::Vector3d::Zero()).norm(), 0.5) << "about its middle, mm";
  }
}

TEST(SideSymmetries, TurnsThatAnExactSymmetryMakesEqualAreOne)
{
  // A square plate with a wall across its middle: the same after half a turn, and from below after a quarter.
  const meam::TrainedModel& model = scenes::trained<wallOnPlate>();
  ASSERT_EQ(model.symmetries.discrete.size(), 1u);
  EXPECT_EQ(turnsFrom(model, -Up).size(), 1u);
}

TEST(SideSymmetries, WhatIsASymmetryOfThePartIsNoneOfASideAlone)
{
  const meam::TrainedModel& model = scenes::trained<hexagon>();
  ASSERT_FALSE(model.symmetries.discrete.empty());
  EXPECT_TRUE(turnsFrom(model, Up).empty());
}
