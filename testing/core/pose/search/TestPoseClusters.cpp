// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/PoseClusters.h"

#include "TestScene.h"

namespace
{
/// With the middle of the part at x (mm), turned by so many degrees about it.
meam::Pose alongX(double x, double degrees = 0.0)
{
  const Eigen::Vector3d middle = scenes::bracket().visibility->middle().cast<double>();
  meam::Pose pose;
  pose.T_scene_model = Eigen::Translation3d(Eigen::Vector3d(x, 0, 0) - middle) *
                       meam::turnAbout(Eigen::Vector3d::UnitZ(), degrees * M_PI / 180.0, middle);
  return pose;
}

using Indices = std::vector<int>;

/// Of poses, best first, those that stay.
Indices staying(const meam::Poses& poses, int posesPerInstance = 1, const meam::Symmetries& same = {})
{
  return meam::firstOfClusters(poses, same, scenes::bracket(), 10.0, posesPerInstance);
}
}

TEST(PoseClusters, OfAnInstanceTheFirstStays)
{
  EXPECT_EQ(staying({}), Indices{});
  EXPECT_EQ(staying({ alongX(0), alongX(9), alongX(11) }), (Indices{ 0, 2 }));
  EXPECT_EQ(staying({ alongX(9), alongX(0), alongX(18) }), (Indices{ 0 })) << "both are near to the first";
  EXPECT_EQ(staying({ alongX(0), alongX(9), alongX(18), alongX(27) }), (Indices{ 0, 2 }))
    << "the second takes no one's place";
  EXPECT_EQ(staying({ alongX(0, 90), alongX(5) }), (Indices{ 0 })) << "however it is turned";
}

TEST(PoseClusters, AlternativesOfAnInstanceAreTurned)
{
  const meam::Poses poses{ alongX(0), alongX(1, 14), alongX(2, 16), alongX(3, 90), alongX(50), alongX(51, 90) };
  EXPECT_EQ(staying(poses, 2), (Indices{ 0, 2, 4, 5 }));
  EXPECT_EQ(staying(poses, 3), (Indices{ 0, 2, 3, 4, 5 }));
}

TEST(PoseClusters, WhatASymmetryMakesEqualIsNoAlternative)
{
  const Eigen::Vector3d middle = scenes::bracket().visibility->middle().cast<double>();
  const auto quarters = [&](int turns)
  { return meam::turnAbout(Eigen::Vector3d::UnitZ(), turns * M_PI / 2.0, middle); };
  const meam::Poses poses{ alongX(0), alongX(1, 180), alongX(2, 90), alongX(3, 45) };
  EXPECT_EQ(staying(poses, 2), (Indices{ 0, 1 }));
  meam::Symmetries half;
  half.discrete = { quarters(2) };
  EXPECT_EQ(staying(poses, 2, half), (Indices{ 0, 2 }));
  meam::Symmetries nearQuarters;
  nearQuarters.near = { { quarters(1) }, { quarters(2) }, { quarters(3) } };
  EXPECT_EQ(staying(poses, 2, nearQuarters), (Indices{ 0, 3 })) << "approximate ones as well";
}
