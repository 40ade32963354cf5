// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Enclosure.h"

#include "base/sequences/Sequences.h"

#include <gtest/gtest.h>

namespace
{
constexpr double Tolerance = 1.0, PartDiameter = 40.0;

/// Points 2 mm apart of a rectangle that two edges span, mm.
void addRectangle(
  const Eigen::Vector3f& corner, const Eigen::Vector3f& a, const Eigen::Vector3f& b, meam::Points& points)
{
  for (float s = 0.0f; s <= a.norm(); s += 2.0f)
  {
    for (float t = 0.0f; t <= b.norm(); t += 2.0f)
    {
      points.push_back(corner + s * a.normalized() + t * b.normalized());
    }
  }
}

std::vector<meam::Plane> planesOf(const meam::Points& points)
{
  const meam::Sensor sensor; // at the origin, looks along +z
  return meam::enclosingPlanes(meam::DepthMap(points, sensor, 2.0), sensor, Tolerance, PartDiameter);
}

/// A floor at z = 500 and a wall, which leans outwards and ends on the floor at x = 100.
meam::Points floorAndWall()
{
  meam::Points points;
  addRectangle({ -100, -100, 500 }, { 200, 0, 0 }, { 0, 200, 0 }, points);
  addRectangle({ 100, -100, 500 }, { 80, 0, -60 }, { 0, 200, 0 }, points);
  return points;
}
}

TEST(Enclosure, FloorAndWallAreFoundWhateverLiesBeforeThem)
{
  meam::Points points = floorAndWall();
  addRectangle({ -20, -10, 470 }, { 30, 0, 5 }, { 0, 25, 0 }, points);
  const auto planes = planesOf(points);
  ASSERT_EQ(planes.size(), 2u);
  EXPECT_TRUE(planes[0].normal().isApprox(Eigen::Vector3f(0, 0, -1), 0.01f)) << planes[0].normal().transpose();
  EXPECT_NEAR(planes[0].offset(), 500.0, 0.5);
  EXPECT_TRUE(planes[1].normal().isApprox(Eigen::Vector3f(-0.6f, 0, -0.8f), 0.02f)) << planes[1].normal().transpose();
  EXPECT_NEAR(planes[1].signedDistance(Eigen::Vector3f(140, 0, 470)), 0.0, 0.5);
}

TEST(Enclosure, APlaneWithSomethingBehindItIsNone)
{
  meam::Points points;
  addRectangle({ -100, -100, 500 }, { 120, 0, 0 }, { 0, 200, 0 }, points);
  addRectangle({ 22, -100, 520 }, { 78, 0, 0 }, { 0, 200, 0 }, points);
  const auto planes = planesOf(points);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_NEAR(planes[0].offset(), 520.0, 0.5);
}

TEST(Enclosure, WhatIsNoLargerThanAPartIsNone)
{
  meam::Points points;
  addRectangle({ 0, 0, 500 }, { 40, 0, 0 }, { 0, 30, 0 }, points);
  EXPECT_TRUE(planesOf(points).empty());
  EXPECT_TRUE(planesOf({}).empty());
}

TEST(Enclosure, APlaneIsFittedToPoints)
{
  const meam::PlaneFit fit =
    meam::fitPlane({ { 0, 0, 9 }, { 0, 0, 11 }, { 60, 0, 10 }, { 0, 60, 10 }, { 60, 60, 10 } }, {});
  EXPECT_GT(std::abs(fit.plane.normal().z()), 0.999f);
  EXPECT_LT(fit.plane.normal().z(), 0.0f) << "towards the sensor";
  EXPECT_NEAR(fit.plane.absDistance(Eigen::Vector3f(36, 24, 10)), 0.0, 0.1);
  // Of a line of n points spread evenly it is the line's length, but for the ends.
  const auto line = meam::ofIndices<Eigen::Vector3f>(100,
    [&](int k) {
      return Eigen::Vector3f{ 0.5f * k, 0.1f * (k % 2), 10.0f };
    });
  EXPECT_NEAR(meam::fitPlane(line, {}).extent, 50.0, 0.1);
}
