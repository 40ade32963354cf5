// SPDX-License-Identifier: BSD-3-Clause
#include "model/BoundaryExtraction.h"

#include <gtest/gtest.h>

namespace
{
/// A flat grid of 11 x 11 points, 1 mm apart, with a hole of 3 x 3 in the middle.
meam::AppearanceModel plate()
{
  meam::AppearanceModel model;
  for (int x = 0; x < 11; ++x)
  {
    for (int y = 0; y < 11; ++y)
    {
      if (std::abs(x - 5) > 1 || std::abs(y - 5) > 1)
      {
        model.cloud.points.emplace_back(x, y, 0);
        model.cloud.normals.push_back(Eigen::Vector3f::UnitZ());
      }
    }
  }
  return model;
}
}

TEST(BoundaryExtraction, OfAPlateTheRimAndTheHole)
{
  meam::BoundaryExtractionSettings settings;
  settings.radius = 1.5;
  const auto edges = meam::extractBoundary({ plate() }, settings);
  ASSERT_EQ(edges.size(), 1u);
  int rim = 0;
  int hole = 0;
  for (const auto& point : edges[0].cloud.points)
  {
    const float fromRim = std::min({ point.x(), point.y(), 10 - point.x(), 10 - point.y() });
    const float fromHole = std::max(std::abs(point.x() - 5), std::abs(point.y() - 5)) - 2;
    EXPECT_TRUE(fromRim == 0 || fromHole == 0) << point.transpose();
    rim += fromRim == 0 ? 1 : 0;
    hole += fromHole == 0 ? 1 : 0;
  }
  EXPECT_EQ(rim, 40);
  EXPECT_GE(hole, 12); // the middles of its sides; a corner's gap is only a right angle
  EXPECT_EQ(edges[0].cloud.normals.size(), edges[0].cloud.size());
}

TEST(BoundaryExtraction, SpacingIsTheMedianNearestDistance)
{
  EXPECT_NEAR(meam::pointSpacing(plate().cloud.points), 1.0, 1e-6);
  EXPECT_EQ(meam::pointSpacing({ Eigen::Vector3f::Zero() }), 0.0);
}

TEST(BoundaryExtraction, BadInput)
{
  meam::AppearanceModel empty;
  EXPECT_THROW(meam::extractBoundary({ empty }), meam::Error);
  meam::AppearanceModel twice = plate(); // every point doubled is fine, one place is not
  twice.cloud.points.insert(twice.cloud.points.end(), twice.cloud.points.begin(), twice.cloud.points.end());
  twice.cloud.normals.insert(twice.cloud.normals.end(), twice.cloud.normals.begin(), twice.cloud.normals.end());
  EXPECT_FALSE(meam::extractBoundary({ twice })[0].cloud.empty());
  twice.cloud = twice.cloud.subset({ 0, 0, 0 });
  EXPECT_THROW(meam::extractBoundary({ twice }), meam::Error);
  meam::AppearanceModel bare = plate();
  bare.cloud.normals.clear();
  EXPECT_THROW(meam::extractBoundary({ bare }), meam::Error);
}
