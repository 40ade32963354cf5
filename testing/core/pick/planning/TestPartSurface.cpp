// SPDX-License-Identifier: BSD-3-Clause
#include "pick/planning/PartSurface.h"

#include "TestParts.h"
#include "base/Error.h"

namespace
{
meam::PartSurface slab() { return { parts::box({ -20, -10, -5 }, { 20, 10, 5 }), 1.0, 3.0 }; }

/// Points of a plate 1 mm apart at a height.
meam::Points plate(float fromX, float toX, float z) { return parts::lattice({ fromX, -30 }, { toX, 30 }, 1.0f, z); }
}

TEST(PartSurface, KnowsThePointsOnIt)
{
  const meam::PartSurface surface = slab();
  EXPECT_NEAR(surface.radius(), std::sqrt(400.0 + 100.0 + 25.0), 1e-4);
  const Eigen::Isometry3d pose(Eigen::Translation3d(100, 0, 0));
  const meam::Points points{ { 100, 0, 6 }, { 100, 0, 9 }, { 100, 0, 0 }, { 121.5f, 3, 3 }, { 0, 0, 5 } };
  // 1 above, 4 above, 5 inside, 1.5 beside, far away.
  EXPECT_EQ(surface.pointsAt(pose, points, 2.0), (std::vector<int>{ 0, 3 }));
}

TEST(PartSurface, IsCoveredByWhatLiesAboveIt)
{
  const meam::PartSurface surface = slab();
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_EQ(surface.covered(pose, up, {}, 2.0, 1.0), 0.0);
  EXPECT_NEAR(surface.covered(pose, up, plate(-40, 40, 12), 2.0, 1.0), 1.0, 1e-9);
  EXPECT_NEAR(surface.covered(pose, up, plate(10, 40, 12), 2.0, 1.0), 0.25, 0.05); // 10 of 40 mm
  EXPECT_EQ(surface.covered(pose, up, plate(-40, 40, -12), 2.0, 1.0), 0.0);        // under it
  EXPECT_EQ(surface.covered(pose, up, plate(-40, 40, 5.5f), 2.0, 1.0), 0.0);       // within the tolerance
}

TEST(PartSurface, RefusesPointsWithoutNumber)
{
  EXPECT_THROW(meam::PartSurface(parts::box({ 0, 0, 0 }, { 1e5, 1e5, 1 }), 0.1, 1.0), meam::Error);
}
