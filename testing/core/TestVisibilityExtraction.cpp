// SPDX-License-Identifier: BSD-3-Clause
#include "model/VisibilityExtraction.h"

#include "mesh/SurfaceSampling.h"
#include "TestParts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{
meam::PointCloud boxSurface()
{
  meam::SurfaceSamplingSettings settings;
  settings.spacing = 1.0;
  return meam::sampleSurface(parts::box({ 0, 0, 0 }, { 20, 20, 10 }), settings);
}
}

TEST(VisibilityExtraction, OfABoxTheFaceTowardsTheViewpointIsSeen)
{
  const meam::PointCloud surface = boxSurface();
  const auto models = meam::extractVisibility(surface);
  ASSERT_EQ(models.size(), 6u);
  for (const auto& model : models)
  {
    std::set<int> seen(model.cloud.pointIds.begin(), model.cloud.pointIds.end());
    int towards = 0;
    int missed = 0;
    int behind = 0;
    for (std::size_t i = 0; i < surface.size(); ++i)
    {
      const bool visible = seen.count(static_cast<int>(i)) > 0;
      const float cosine = surface.normals[i].dot(model.direction);
      towards += cosine > 0.5f ? 1 : 0;
      missed += cosine > 0.5f && !visible ? 1 : 0;
      behind += cosine < -0.5f && visible ? 1 : 0;
    }
    EXPECT_LT(missed, towards / 50) << model.name;
    EXPECT_EQ(behind, 0) << model.name;
  }
}

TEST(VisibilityExtraction, PointsKeepTheirIdentityAndTheInputIsUntouched)
{
  const meam::PointCloud surface = boxSurface();
  const auto models = meam::extractVisibility(surface);
  for (const auto& model : models)
  {
    for (std::size_t k = 0; k < model.cloud.size(); ++k)
    {
      EXPECT_EQ(model.cloud.points[k], surface.points[model.cloud.pointIds[k]]);
      EXPECT_EQ(model.cloud.normals[k], surface.normals[model.cloud.pointIds[k]]);
    }
  }
}

TEST(VisibilityExtraction, APointInFrontHidesTheOneBehindADenseSurface)
{
  // A 21 x 21 plate at z = 10 above one point at z = 0.
  meam::Points points;
  for (int x = -10; x <= 10; ++x)
  {
    for (int y = -10; y <= 10; ++y)
    {
      points.emplace_back(x * 0.5f, y * 0.5f, 10.0f);
    }
  }
  points.emplace_back(0.0f, 0.0f, 0.0f);
  const std::vector<int> fromAbove = meam::visiblePoints(points, { 0, 0, 100 }, 1000.0);
  EXPECT_EQ(fromAbove.size(), points.size() - 1);
  EXPECT_EQ(std::count(fromAbove.begin(), fromAbove.end(), static_cast<int>(points.size()) - 1), 0);
}

TEST(VisibilityExtraction, BadInput)
{
  EXPECT_THROW(meam::extractVisibility({}), meam::Error);
  meam::PointCloud invalid;
  invalid.points.assign(10, Eigen::Vector3f::Constant(NAN));
  EXPECT_THROW(meam::extractVisibility(invalid), meam::Error);
  EXPECT_THROW(
    meam::extractVisibility(boxSurface(), {}, [](double) { return false; }), meam::Aborted);
}
