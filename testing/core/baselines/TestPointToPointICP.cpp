// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/PointToPointICP.h"

#include "baselines/BaselineSettings.h"
#include "TestScene.h"

TEST(PointToPointICP, ADisturbedPoseComesBack)
{
  const meam::Poses refined = scenes::refine(
    scenes::disturbedCopies(1.5, 2.0), scenes::copiesScene(), scenes::bracket(), meam::paperRefinementSettings());
  ASSERT_EQ(refined.size(), 3u);
  for (std::size_t i = 0; i < refined.size(); ++i)
  {
    EXPECT_LT(meam::translationError(refined[i].T_scene_model, scenes::threeCopies()[i]), 0.8) << i;
    EXPECT_LT(meam::rotationError(refined[i].T_scene_model, scenes::threeCopies()[i]), 1.5) << i;
  }
}

TEST(PointToPointICP, APoseThatNamesNoViewTakesTheNearestToTheSensor)
{
  meam::Poses nameless = scenes::disturbedCopies(0.3, 0.5);
  meam::Poses named = nameless;
  for (std::size_t i = 0; i < named.size(); ++i)
  {
    nameless[i].viewId = i % 2 == 0 ? -1 : 99;
    named[i].viewId =
      meam::PredictedVisibility(scenes::bracket()).view(named[i].T_scene_model, scenes::seenCopies().sensor);
  }
  const meam::PoseRefinementSettings settings = meam::paperRefinementSettings();
  const meam::Poses one = scenes::refine(nameless, scenes::copiesScene(), scenes::bracket(), settings);
  const meam::Poses other = scenes::refine(named, scenes::copiesScene(), scenes::bracket(), settings);
  for (std::size_t i = 0; i < named.size(); ++i)
  {
    EXPECT_EQ(one[i].viewId, named[i].viewId);
    EXPECT_TRUE(one[i].T_scene_model.matrix() == other[i].T_scene_model.matrix());
  }
}
