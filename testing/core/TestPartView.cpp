// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PartView.h"

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
  sensor.direction = -Eigen::Vector3f::UnitZ();
  return sensor;
}
}

TEST(PartView, PosesThatHardlyDifferAreJudgedOnTheSamePoints)
{
  const meam::PartView view(scenes::bracket());
  const meam::PartView::Visible visible = view.visible(turned(10.0), fromAbove());
  const meam::PartView::Visible near = view.visible(turned(10.001), fromAbove());
  EXPECT_EQ(near.edges, visible.edges);
  EXPECT_EQ(near.surface, visible.surface);
  EXPECT_FALSE(visible.edges.empty());
  EXPECT_NE(view.visible(turned(60.0), fromAbove()).surface, visible.surface);
  // The direction is told to within a degree.
  const Eigen::Vector3f towards = turned(10.0).linear().transpose().cast<float>() * Eigen::Vector3f::UnitZ();
  EXPECT_GT(visible.from.dot(towards), std::cos(M_PI / 180.0));
}

TEST(PartView, WhatIsVisibleIsUpdatedWithTheDirectionAlone)
{
  const meam::PartView view(scenes::bracket());
  meam::PartView::Visible visible;
  view.update(visible, turned(60.0), fromAbove());
  EXPECT_EQ(visible.edges, view.visible(turned(60.0), fromAbove()).edges);
  visible.edges.clear();
  view.update(visible, turned(60.001), fromAbove());
  EXPECT_TRUE(visible.edges.empty()) << "seen from the same direction nothing is looked up";
  view.update(visible, turned(10.0), fromAbove());
  EXPECT_EQ(visible.edges, view.visible(turned(10.0), fromAbove()).edges);
  EXPECT_EQ(visible.surface, view.visible(turned(10.0), fromAbove()).surface);
}
