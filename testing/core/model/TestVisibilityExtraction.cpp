// SPDX-License-Identifier: BSD-3-Clause
#include "model/VisibilityExtraction.h"

#include "TestParts.h"
#include "base/sequences/Sequences.h"
#include "mesh/LineOfSight.h"
#include "mesh/TriangleMesh.h"

#include <cmath>
#include <set>

namespace
{
meam::PointCloud sampled(const meam::TriangleMesh& mesh) { return parts::sampled(mesh, 1.0); }

meam::TriangleMesh box() { return parts::box({ 0, 0, 0 }, { 20, 20, 10 }); }

meam::PointCloud boxSurface() { return sampled(box()); }

meam::VisibilityExtractionSettings meshVisibility(int viewpoints)
{
  meam::VisibilityExtractionSettings settings;
  settings.method = meam::VisibilityMethod::MeshVisibility;
  settings.viewpoints = viewpoints;
  return settings;
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
  meam::Points points = parts::lattice({ -5, -5 }, { 5, 5 }, 0.5f, 10.0f);
  points.emplace_back(0.0f, 0.0f, 0.0f);
  const std::vector<int> fromAbove = meam::visiblePoints(points, { 0, 0, 100 }, 1000.0);
  EXPECT_EQ(fromAbove.size(), points.size() - 1);
  EXPECT_EQ(std::count(fromAbove.begin(), fromAbove.end(), static_cast<int>(points.size()) - 1), 0);
}

TEST(VisibilityExtraction, AgainstTheMeshItIsExact)
{
  const meam::TriangleMesh mesh = box();
  const meam::PointCloud surface = boxSurface();
  const auto models = meam::extractVisibility(surface, meshVisibility(6), &mesh);
  ASSERT_EQ(models.size(), 6u);
  for (const auto& model : models)
  {
    const std::vector<int> side =
      meam::indicesWhere(surface.size(), [&](int i) { return surface.normals[i].dot(model.direction) > 0.5f; });
    EXPECT_EQ(model.cloud.pointIds, side) << model.name;
    EXPECT_NEAR((model.viewpoint - Eigen::Vector3f(10, 10, 5)).normalized().dot(model.direction), 1.0f, 1e-3f);
  }
}

TEST(VisibilityExtraction, OneBoxHidesAnother)
{
  // From far above the upper box hides the square below it, to within its perspective.
  const meam::TriangleMesh mesh =
    parts::joined(parts::box({ 0, 0, 0 }, { 20, 20, 2 }), parts::box({ 5, 5, 8 }, { 15, 15, 10 }));
  const meam::PointCloud surface = sampled(mesh);
  const std::vector<int> seen = meam::visiblePoints(surface, { 10, 10, 1000 }, meam::LineOfSight(mesh));
  const float shadow = 5.0f * 998.0f / 990.0f; // of the upper box's top, on the lower box's
  std::vector<int> expected;
  for (std::size_t i = 0; i < surface.size(); ++i)
  {
    const Eigen::Vector3f& point = surface.points[i];
    const float fromMiddle = std::max(std::abs(point.x() - 10), std::abs(point.y() - 10));
    if (surface.normals[i].z() > 0.5f && (point.z() > 9.0f || fromMiddle > shadow))
    {
      expected.push_back(static_cast<int>(i));
    }
  }
  EXPECT_EQ(seen, expected);
}

TEST(VisibilityExtraction, AnOpenSheetIsSeenFromBothSides)
{
  const meam::TriangleMesh sheet = parts::rectangle(20, 20);
  const meam::PointCloud surface = sampled(sheet);
  const auto models = meam::extractVisibility(surface, meshVisibility(6), &sheet);
  ASSERT_EQ(models.size(), 2u); // from its sides there is nothing to see
  EXPECT_EQ(models[0].name, "View 0");
  EXPECT_EQ(models[1].name, "View 1");
  for (const auto& model : models)
  {
    EXPECT_EQ(model.cloud.pointIds, surface.pointIds);
    EXPECT_EQ(model.cloud.normals, meam::Points(surface.size(), model.direction));
  }
}

TEST(VisibilityExtraction, MovingMeshSamplesAndViewpointChangesNothing)
{
  const meam::TriangleMesh mesh = parts::lBracket();
  const meam::PointCloud surface = sampled(mesh);
  std::mt19937 random(5);
  for (const Eigen::Vector3d& viewpoint : { Eigen::Vector3d(200, 150, 90), Eigen::Vector3d(70, -300, 250) })
  {
    const std::vector<int> expected = meam::visiblePoints(surface, viewpoint, meam::LineOfSight(mesh));
    EXPECT_GT(expected.size(), surface.size() / 5);
    EXPECT_LT(expected.size(), 2 * surface.size() / 3);
    const Eigen::Isometry3d T = parts::motion(random, 300.0);
    const meam::TriangleMesh moved{ meam::moved(mesh.vertices, T), mesh.triangles };
    EXPECT_EQ(meam::visiblePoints(parts::moved(surface, T), T * viewpoint, meam::LineOfSight(moved)), expected);
  }
}

TEST(VisibilityExtraction, TheConeLeavesViewpointsOut)
{
  meam::VisibilityExtractionSettings settings;
  settings.coneAngle = 91.0;
  EXPECT_EQ(meam::extractVisibility(boxSurface(), settings).size(), 5u);
  settings.coneDirection = { 1, 1, 1 };
  settings.coneAngle = 30.0;
  EXPECT_THROW(meam::extractVisibility(boxSurface(), settings), meam::Error);
  settings.viewpoints = 8;
  EXPECT_EQ(meam::extractVisibility(boxSurface(), settings).size(), 8u);
}

TEST(VisibilityExtraction, WithoutViewpointsTheWholePartIsOneModel)
{
  const meam::PointCloud surface = boxSurface();
  meam::VisibilityExtractionSettings settings = meshVisibility(0); // which needs no mesh here
  settings.coneAngle = 5.0;
  const auto models = meam::extractVisibility(surface, settings);
  ASSERT_EQ(models.size(), 1u);
  EXPECT_EQ(models[0].name, "Whole part");
  EXPECT_TRUE(models[0].wholePart);
  EXPECT_EQ(models[0].direction, Eigen::Vector3f::UnitZ());
  EXPECT_FALSE(models[0].viewpoint.allFinite());
  EXPECT_EQ(models[0].cloud.points, surface.points);
  EXPECT_EQ(models[0].cloud.normals, surface.normals);
  EXPECT_EQ(models[0].cloud.pointIds, surface.pointIds);
  EXPECT_FALSE(meam::extractVisibility(surface).front().wholePart);
  settings.viewpoints = -1;
  EXPECT_THROW(meam::extractVisibility(surface, settings), meam::Error);
}

TEST(VisibilityExtraction, BadInput)
{
  EXPECT_THROW(meam::extractVisibility({}), meam::Error);
  meam::PointCloud invalid;
  invalid.points.assign(10, Eigen::Vector3f::Constant(NAN));
  EXPECT_THROW(meam::extractVisibility(invalid), meam::Error);
  EXPECT_THROW(meam::extractVisibility(boxSurface(), {}, nullptr, [](double) { return false; }), meam::Aborted);
  EXPECT_THROW(meam::extractVisibility(boxSurface(), meshVisibility(6)), meam::Error);
  const meam::TriangleMesh mesh = box();
  EXPECT_THROW(
    meam::extractVisibility(boxSurface(), meshVisibility(6), &mesh, [](double share) { return share < 0.3; }),
    meam::Aborted);
  meam::PointCloud bare = boxSurface();
  bare.normals.clear();
  EXPECT_THROW(meam::extractVisibility(bare, meshVisibility(6), &mesh), meam::Error);
  const meam::TriangleMesh other = parts::box({ 0, 0, 0 }, { 20, 20, 5 });
  EXPECT_THROW(meam::extractVisibility(boxSurface(), meshVisibility(6), &other), meam::Error);
  const meam::TriangleMesh none;
  EXPECT_THROW(meam::extractVisibility(boxSurface(), meshVisibility(6), &none), meam::Error);
}
