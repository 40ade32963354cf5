// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/BodyOverlap.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
meam::TriangleMesh slab() { return parts::box({ -30, -20, 0 }, { 30, 20, 15 }); }

/// With a block `shift` mm along its length, turned about its end.
bool cuts(double shift, double degrees = 0.0)
{
  const meam::TrainedModel& model = scenes::trained<slab>();
  Eigen::Isometry3d other = Eigen::Isometry3d::Identity();
  other.translation().x() = shift;
  other.rotate(Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d::UnitZ()));
  const bool result = meam::bodiesOverlap(model, Eigen::Isometry3d::Identity(), other);
  EXPECT_EQ(meam::bodiesOverlap(model, other, Eigen::Isometry3d::Identity()), result);
  return result;
}
}

TEST(BodyOverlap, BlocksThatTouchDoNotCut)
{
  EXPECT_FALSE(cuts(60.0));
  EXPECT_FALSE(cuts(59.0)) << "1 mm, less than 3 % of 74 mm";
  EXPECT_FALSE(cuts(200.0));
}

TEST(BodyOverlap, TellsDepthsThatDifferByLittle)
{
  const auto above = [](double z)
  {
    return meam::bodiesOverlap(
      scenes::trained<slab>(), Eigen::Isometry3d::Identity(), Eigen::Isometry3d(Eigen::Translation3d(0, 0, z)));
  };
  EXPECT_FALSE(above(13.0)) << "2 mm deep, less than 3 % of 74 mm";
  EXPECT_TRUE(above(12.5)) << "2.5 mm deep";
  EXPECT_TRUE(above(9.0));
}

TEST(BodyOverlap, BlocksThatReachIntoEachOtherCut)
{
  EXPECT_TRUE(cuts(0.0, 90.0)) << "a cross";
  EXPECT_TRUE(cuts(35.0, 45.0)) << "a corner";
}
