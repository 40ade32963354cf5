// SPDX-License-Identifier: BSD-3-Clause
#include "pick/Pick.h"

#include <gtest/gtest.h>

namespace
{
using meam::PickObstruction;

meam::Pick pickOf(int pose, PickObstruction obstruction)
{
  meam::Pick pick;
  pick.pose = pose;
  pick.obstruction = obstruction;
  return pick;
}

TEST(Pick, IsToldInWordsWithItsNumber)
{
  meam::Pick pick = pickOf(0, PickObstruction::Covered);
  pick.covered = 0.404;
  EXPECT_EQ(meam::describe(pick), "covered from above to 40 %");
  EXPECT_EQ(meam::labelOf(pick, 7), "40 % covered");
  pick = pickOf(0, PickObstruction::Instance);
  pick.obstacle = 2;
  EXPECT_EQ(meam::describe(pick), "collides with instance 3");
  EXPECT_EQ(meam::labelOf(pick, 7), "hits 3");
  pick = pickOf(0, PickObstruction::Measured);
  EXPECT_EQ(meam::describe(pick), "collides with something measured");
  EXPECT_EQ(meam::labelOf(pick, 7), "hits something");
  EXPECT_EQ(meam::labelOf(pickOf(0, PickObstruction::None), 7), "pick 7");
}

TEST(Pick, ACopyIsCountedWithTheGraspThatComesFarthest)
{
  const meam::Picks picks{ pickOf(0, PickObstruction::None), pickOf(1, PickObstruction::Tilted),
    pickOf(1, PickObstruction::Bin), pickOf(2, PickObstruction::Tilted), pickOf(2, PickObstruction::Tilted),
    pickOf(0, PickObstruction::Measured), pickOf(3, PickObstruction::Tilted) };
  EXPECT_EQ(meam::describe(picks),
    "1 of 4 copies can be picked, by 1 of 7 picks; the others: 2 without a grasp from above, "
    "1 too near to the bin.");
  EXPECT_EQ(meam::adviceOn(picks),
    "Copies without a grasp from above: raise MaximumTilt, have more grasps proposed or define one by hand, or "
    "take another gripper. Copies too near to the bin: take a slimmer or longer gripper, or lower SafetyMargin.");
}

TEST(Pick, ThereIsNoAdviceWhereAllCopiesCanBePicked)
{
  const meam::Picks picks{ pickOf(0, PickObstruction::None), pickOf(0, PickObstruction::Tilted) };
  EXPECT_EQ(meam::describe(picks), "1 of 1 copies can be picked, by 1 of 2 picks.");
  EXPECT_EQ(meam::adviceOn(picks), "");
  EXPECT_EQ(meam::describe(meam::Picks{}), "There is no copy to pick.");
  EXPECT_EQ(meam::adviceOn({}), "");
}
}
