// SPDX-License-Identifier: BSD-3-Clause
#include "model/PredictedVisibility.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
/// The bracket turned by so many degrees from a pose in which a sensor above sees its upper side.
Eigen::Isometry3d turned(double degrees)
{
  return Eigen::Isometry3d(Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d(1, 2, 0).normalized()));
}

meam::Sensor fromAbove()
{
  meam::Sensor sensor;
  sensor.perspective = false;
  sensor.direction = -Eigen::Vector3d::UnitZ();
  return sensor;
}
}

TEST(PredictedVisibility, PosesThatHardlyDifferPredictTheSamePoints)
{
  const meam::PredictedVisibility view(scenes::bracket());
  const auto visible = view.visible(turned(10.0), fromAbove());
  EXPECT_EQ(view.visible(turned(10.001), fromAbove()), visible) << "seen from the same direction nothing is looked up";
  EXPECT_FALSE(visible->edges.empty());
  EXPECT_NE(view.visible(turned(60.0), fromAbove())->surface, visible->surface);
  // The direction is rounded to within a degree.
  const Eigen::Vector3f towards = turned(10.0).linear().transpose().cast<float>() * Eigen::Vector3f::UnitZ();
  EXPECT_GT(visible->from.dot(towards), std::cos(M_PI / 180.0));
}

TEST(PredictedVisibility, WhatIsVisibleIsTheSameInAnyOrderOfQuestions)
{
  // More directions than are cached.
  const meam::PredictedVisibility one(scenes::bracket()), other(scenes::bracket());
  const auto first = one.visible(turned(10.0), fromAbove());
  for (int k = 0; k < 1500; ++k)
  {
    const Eigen::Isometry3d T(
      Eigen::AngleAxisd(0.07 * k, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(2.4 * k, Eigen::Vector3d::UnitZ()));
    const auto visible = one.visible(T, fromAbove());
    if (k % 100 == 0)
    {
      EXPECT_EQ(visible->edges, other.visible(T, fromAbove())->edges) << k;
      EXPECT_EQ(visible->surface, other.visible(T, fromAbove())->surface) << k;
    }
  }
  EXPECT_EQ(one.visible(turned(10.0), fromAbove())->edges, first->edges);
  EXPECT_EQ(one.visible(turned(10.0), fromAbove())->surface, first->surface);
}

TEST(PredictedVisibility, APoseBeyondAllMeasureSeesSomething)
{
  const meam::PredictedVisibility view(scenes::bracket());
  meam::Sensor sensor;
  EXPECT_NO_THROW(view.visible(Eigen::Isometry3d(Eigen::Translation3d(1e39, 0, 0)), sensor));
}
