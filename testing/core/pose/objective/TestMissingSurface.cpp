// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/MissingSurface.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
meam::TriangleMesh blockOnCorner() { return parts::blockOnPlate(false); }

/// Patches of a plate with a block on one corner that are missing on so many copies of another plate.
int missingOn(int copies, const meam::TriangleMesh& other)
{
  const meam::TrainedModel& model = scenes::trained<blockOnCorner>();
  std::vector<scenes::Copy> lying;
  for (int i = 0; i < copies; ++i)
  {
    lying.push_back({ other, scenes::lying(100.0 * (i % 2), 100.0 * (i / 2), 70.0 * i) });
  }
  const meam::Scene scene =
    scenes::prepared(scenes::withTangents(scenes::seenFromAbove(lying), model.diameter), model.diameter);
  meam::Poses poses(copies);
  for (int i = 0; i < copies; ++i)
  {
    poses[i].T_scene_model = scene.T_local_scene() * lying[i].T_scene_model;
  }
  const int missing = meam::missingPatches(poses, scene, model, 1);
  EXPECT_EQ(meam::missingPatches(poses, scene, model, 4), missing);
  return missing;
}
}

TEST(MissingSurface, OfThePartItselfNothingIsMissing) { EXPECT_EQ(missingOn(4, blockOnCorner()), 0); }

TEST(MissingSurface, ABlockThatIsElsewhereIsMissing)
{
  // Its top, 20 x 12 mm but for its rim, in patches of 5.2 x 5.2 mm.
  const int missing = missingOn(4, parts::blockOnPlate(true));
  EXPECT_GE(missing, 2);
  EXPECT_LE(missing, 5 * 4);
}

TEST(MissingSurface, ThreeCopiesTellNothing) { EXPECT_EQ(missingOn(3, parts::blockOnPlate(true)), 0); }

TEST(MissingSurface, ANarrowStripOfTheBlockIsMissing)
{
  meam::TriangleMesh narrower = blockOnCorner();
  for (Eigen::Vector3f& vertex : narrower.vertices)
  {
    if (vertex.x() == 40.0f) // of the block: its inner side
    {
      vertex.x() = 46.0f; // 8 % of the diameter
    }
  }
  EXPECT_GE(missingOn(4, narrower), 1);
}
