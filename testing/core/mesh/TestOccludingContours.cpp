// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/OccludingContours.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
constexpr float Radius = 10.0f; // mm
constexpr float Length = 20.0f;

/// A cylinder about z, from 0 to 20 mm, with its ends; samples about 1 mm apart.
meam::PointCloud cylinder()
{
  meam::PointCloud cloud;
  const auto add = [&](const Eigen::Vector3f& point, const Eigen::Vector3f& normal)
  {
    cloud.points.push_back(point);
    cloud.normals.push_back(normal);
  };
  for (int k = 0; k < 63; ++k)
  {
    const float angle = 0.05f + static_cast<float>(2.0 * M_PI) * k / 63.0f;
    const Eigen::Vector3f out(std::cos(angle), std::sin(angle), 0.0f);
    for (float z = 0.5f; z < Length; z += 1.0f)
    {
      add(Radius * out + z * Eigen::Vector3f::UnitZ(), out);
    }
  }
  for (float x = -9.5f; x < Radius; x += 1.0f)
  {
    for (float y = -9.5f; y < Radius; y += 1.0f)
    {
      if (std::hypot(x, y) < Radius)
      {
        add({ x, y, Length }, Eigen::Vector3f::UnitZ());
        add({ x, y, 0.0f }, -Eigen::Vector3f::UnitZ());
      }
    }
  }
  return cloud;
}
}

TEST(OccludingContours, OfACylinderTwoLinesAreSeenFromTheSide)
{
  const meam::OccludingContours contours(cylinder(), 1.0);
  const float cosine = 0.12f; // at which a sensor loses the surface
  for (const float degrees : { 0.0f, 33.0f, 71.0f })
  {
    const float angle = degrees * static_cast<float>(M_PI) / 180.0f;
    const Eigen::Vector3f towards(std::cos(angle), std::sin(angle), 0.0f);
    const auto found = contours.from(towards);
    EXPECT_NEAR(found.size(), 2 * Length, 4) << "one for each millimetre of both";
    for (const auto& point : found)
    {
      EXPECT_NEAR(std::abs(point.point.cross(towards).z()), Radius * std::sqrt(1.0f - cosine * cosine), 0.02);
      EXPECT_NEAR(point.point.dot(towards), Radius * cosine, 0.05) << "before the surface turns away";
      EXPECT_NEAR(std::abs(point.tangent.z()), 1.0, 1e-4);
      EXPECT_NEAR(point.normal.dot(towards), 0.0, 0.01);
    }
  }
}

TEST(OccludingContours, CoarseScansEndWhereTheirLastPointIs)
{
  const meam::OccludingContours contours(cylinder(), 1.0);
  // Half a millimetre inside the outline of a circle of 10 mm: at the height of sqrt(10^2 - 9.5^2) mm.
  const auto found = contours.from(Eigen::Vector3f::UnitX(), 0.5);
  ASSERT_FALSE(found.empty());
  for (const auto& point : found)
  {
    EXPECT_NEAR(std::abs(point.point.y()), Radius - 0.5, 0.02);
    EXPECT_NEAR(point.point.x(), std::sqrt(Radius * Radius - 9.5f * 9.5f), 0.08);
  }
}

TEST(OccludingContours, FlatFacesAndSharpEdgesHaveNone)
{
  const meam::OccludingContours contours(cylinder(), 1.0);
  EXPECT_TRUE(contours.from(Eigen::Vector3f::UnitZ()).empty()) << "the rim of the cylinder is a sharp edge";
  EXPECT_TRUE(meam::OccludingContours().from(Eigen::Vector3f::UnitZ()).empty());
}

TEST(OccludingContours, EdgePointsOfAViewAreContoursWhereTheSurfaceIsSmooth)
{
  const meam::OccludingContours contours(cylinder(), 1.0);
  const meam::Points views{ Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ() };
  const meam::Points edges{
    { 0.0f, Radius, 10.0f },  // on the outline from x
    { Radius, 0.0f, 10.0f },  // seen from x at a right angle: an edge that was drawn there
    { 0.0f, Radius, Length }, // the rim
    { 0.0f, 0.0f, 100.0f }    // with nothing about it
  };
  const std::vector<bool> found = contours.areContours(edges, { 1u, 1u, 3u, 1u }, views);
  EXPECT_EQ(found, std::vector<bool>({ true, false, false, false }));
}
