// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/FloorContact.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
constexpr float Thickness = 6.0f; // mm
meam::TriangleMesh plate() { return parts::box({ 0.0f, 0.0f, 0.0f }, { 60.0f, 40.0f, Thickness }); }

/// How thick plates are that lie `high` mm above a floor, if there is one, and are `factor` times as thick as the part.
double thicknessOf(float factor, const std::vector<float>& high, bool onFloor = true)
{
  const meam::TrainedModel& model = scenes::trained<plate>();
  const auto cornerOf = [](std::size_t i) { return Eigen::Vector2f(90.0f * (i % 2), 90.0f * (i / 2)); };
  scenes::Seen seen;
  seen.sensor = parts::fromAbove();
  for (float x = -30.0f; x <= 180.0f; ++x)
  {
    for (float y = -30.0f; y <= 160.0f; ++y)
    {
      float z = 0.0f;
      bool isOnPlate = false, isRim = false;
      for (std::size_t i = 0; i < high.size(); ++i)
      {
        const Eigen::Array2f at = Eigen::Vector2f(x, y) - cornerOf(i), size(60.0f, 40.0f);
        if ((at >= 0.0f).all() && (at <= size).all())
        {
          isOnPlate = true;
          isRim = (at == 0.0f).any() || (at == size).any();
          z = high[i] + factor * Thickness;
        }
      }
      if (isOnPlate || onFloor)
      {
        seen.surface.emplace_back(x, y, z);
      }
      if (isRim)
      {
        seen.edges.points.emplace_back(x, y, z);
      }
    }
  }
  const meam::Scene scene = scenes::prepared(scenes::withTangents(seen, model.diameter), model.diameter);
  meam::Poses poses(high.size());
  for (std::size_t i = 0; i < high.size(); ++i)
  {
    const Eigen::Vector2d corner = cornerOf(i).cast<double>();
    const double top = high[i] + factor * Thickness; // what is seen of the plate is the part's
    poses[i].T_scene_model =
      scene.T_local_scene() * Eigen::Translation3d(corner.x(), corner.y(), top - static_cast<double>(Thickness));
  }
  return meam::thicknessByFloor(poses, scene, model);
}
}

TEST(FloorContact, ThePartItselfLiesOnTheFloor) { EXPECT_EQ(thicknessOf(1.0f, { 0.0f, 0.0f, 0.0f, 9.0f }), 1.0); }

TEST(FloorContact, WhatIsThickerHoldsThePartUp)
{
  EXPECT_NEAR(thicknessOf(1.24f, { 0.0f, 0.0f, 0.0f, 9.0f }), 1.24, 0.021);
}

TEST(FloorContact, OfWhatIsThinnerThePartWouldLieInTheFloor)
{
  EXPECT_NEAR(thicknessOf(0.76f, { 0.0f, 0.0f, 0.0f, 9.0f }), 0.76, 0.021);
}

TEST(FloorContact, TwoCopiesOnTheFloorTellNothing) { EXPECT_EQ(thicknessOf(1.2f, { 0.0f, 0.0f, 5.0f, 9.0f }), 1.0); }

TEST(FloorContact, WithoutAFloorNothingIsTold) { EXPECT_EQ(thicknessOf(1.2f, { 0.0f, 0.0f, 0.0f, 0.0f }, false), 1.0); }

TEST(FloorContact, WordsNameTheThickness)
{
  EXPECT_EQ(meam::thicknessWords(1.0), "");
  EXPECT_EQ(meam::thicknessWords(0.8).find("By the floor that they lie on the parts are 0.80 times as thick"), 0u);
}
