// SPDX-License-Identifier: BSD-3-Clause
#include "model/body/SurroundingPatches.h"

#include "TestScene.h"

#include <algorithm>

namespace
{
meam::TriangleMesh slab() { return parts::box({ 0, 0, 0 }, { 60, 40, 20 }); }

/// Of the block, mm.
float distanceTo(const Eigen::Vector3f& point)
{
  return Eigen::AlignedBox3f(Eigen::Vector3f::Zero(), Eigen::Vector3f(60, 40, 20)).exteriorDistance(point);
}

float leastDistance(const meam::Points& points)
{
  float least = 1000.0f;
  for (const Eigen::Vector3f& point : points)
  {
    least = std::min(least, distanceTo(point));
  }
  return least;
}
}

TEST(SurroundingPatches, placesLieBesideFaces)
{
  const meam::TrainedModel& model = scenes::trained<slab>();
  const auto near = model.surroundings->of(model, 0.0, 1); // where the field ends: 2.2 mm
  ASSERT_EQ(near->ofSamples.size(), model.surface.size());
  ASSERT_EQ(near->begins.size(), model.surface.size() + 1);
  ASSERT_EQ(near->begins.back(), static_cast<int>(near->beside.size()));
  EXPECT_GT(near->beside.size(), 100u);
  EXPECT_GT(leastDistance(near->beside), 1.9f);
  EXPECT_LT(leastDistance(near->beside), 2.8f);
  EXPECT_LT(*std::max_element(near->ofBeside.begin(), near->ofBeside.end()), near->count);
  for (std::size_t i = 0; i + 1 < near->begins.size(); ++i)
  {
    for (int k = near->begins[i]; k < near->begins[i + 1]; ++k)
    {
      const Eigen::Vector3f way = near->beside[k] - model.surface.points[i];
      EXPECT_NEAR(way.dot(model.surface.normals[i]), 0.0f, 1e-3f) << "in the plane of its face";
    }
  }
}

TEST(SurroundingPatches, aScanOfCoarserPixelsHasThemFarther)
{
  const meam::TrainedModel& model = scenes::trained<slab>();
  const auto near = model.surroundings->of(model, 0.0, 1);
  EXPECT_EQ(model.surroundings->of(model, 1.0, 4), near) << "the same: made once";
  const auto far = model.surroundings->of(model, 5.0, 1);
  double least = 1000.0, most = 0.0; // from their samples, whose faces end up to 4 % of D farther on
  for (std::size_t i = 0; i + 1 < far->begins.size(); ++i)
  {
    for (int k = far->begins[i]; k < far->begins[i + 1]; ++k)
    {
      const double distance = (far->beside[k] - model.surface.points[i]).norm();
      least = std::min(least, distance);
      most = std::max(most, distance);
    }
  }
  EXPECT_GT(least, 5.0 - 1e-3);
  EXPECT_LT(least, 5.0 + 0.0025 * model.diameter + 0.01 * model.diameter);
  EXPECT_LT(most, 5.0 + (0.0025 + 0.04) * model.diameter);
  EXPECT_EQ(far->ofSamples, near->ofSamples);
  EXPECT_EQ(model.surroundings->of(model, 5.0, 1), far);
  EXPECT_EQ(model.surroundings->of(model, 0.0, 1), near) << "kept, as that for coarser pixels is";
  EXPECT_EQ(model.surroundings->of(model, 5.0 - 0.001 * model.diameter, 1)->beside, far->beside) << "within a step";
}
