// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/symmetry/SymmetryDetection.h"

#include "TestParts.h"
#include "TestScale.h"
#include "mesh/ConvexHull.h"
#include "mesh/TriangleMesh.h"
#include "pose/Pose.h"

namespace
{
/// By points so far from each other, in diameters.
meam::PointCloud sampled(const meam::TriangleMesh& mesh, double spacing = SmallData ? 0.03 : 0.02)
{
  return parts::sampled(mesh, spacing * meam::diameter(mesh.vertices));
}

bool contains(const std::vector<Eigen::Isometry3d>& turns, const Eigen::Vector3d& axis, double degrees)
{
  Eigen::Isometry3d wanted = Eigen::Isometry3d::Identity();
  wanted.rotate(Eigen::AngleAxisd(degrees * M_PI / 180.0, axis.normalized()));
  return std::any_of(turns.begin(), turns.end(), [&](const auto& T) { return meam::rotationError(T, wanted) < 1.0; });
}
}

TEST(SymmetryDetection, OfABoxTheThreeHalfTurns)
{
  const meam::Symmetries found = meam::detectSymmetries(sampled(parts::box({ 5, 5, 5 }, { 35, 25, 15 })));
  EXPECT_TRUE(found.continuous.empty());
  ASSERT_EQ(found.discrete.size(), 3u);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_TRUE(contains(found.discrete, Eigen::Vector3d::Unit(axis), 180.0));
  }
  for (const auto& T : found.discrete)
  {
    EXPECT_LT((T * Eigen::Vector3d(20, 15, 10) - Eigen::Vector3d(20, 15, 10)).norm(), 0.1); // about its middle
  }
}

TEST(SymmetryDetection, OfAFlatSheetTheHalfTurn)
{
  const meam::TriangleMesh sheet = parts::rectangle(60, 40);
  const meam::Symmetries found = meam::detectSymmetries(sampled(sheet, 0.02)); // its other side is no surface
  EXPECT_TRUE(found.continuous.empty());
  ASSERT_EQ(found.discrete.size(), 1u);
  EXPECT_TRUE(contains(found.discrete, { 0, 0, 1 }, 180.0));
}

TEST(SymmetryDetection, OfACubeTheWholeGroup)
{
  const meam::Symmetries found = meam::detectSymmetries(sampled(parts::box({ -9, -9, -9 }, { 9, 9, 9 })));
  ASSERT_EQ(found.discrete.size(), 23u); // 24 rotations with the identity
  EXPECT_TRUE(contains(found.discrete, { 1, 1, 1 }, 120.0));
  EXPECT_TRUE(contains(found.discrete, { 1, 1, 0 }, 180.0));
  EXPECT_TRUE(contains(found.discrete, { 0, 1, 0 }, -90.0));
}

TEST(SymmetryDetection, OfARegularPrismItsTurnsAndFlips)
{
  const meam::Symmetries hexagon = meam::detectSymmetries(sampled(parts::regularPrism(6, 10, 8)));
  EXPECT_EQ(hexagon.discrete.size(), 11u);
  EXPECT_TRUE(contains(hexagon.discrete, { 0, 0, 1 }, 60.0));
  EXPECT_TRUE(contains(hexagon.discrete, { 1, 0, 0 }, 180.0));
  const meam::Symmetries triangle = meam::detectSymmetries(sampled(parts::regularPrism(3, 10, 8)));
  EXPECT_EQ(triangle.discrete.size(), 5u);
  EXPECT_TRUE(contains(triangle.discrete, { 0, 0, 1 }, 120.0));
  EXPECT_FALSE(contains(triangle.discrete, { 0, 0, 1 }, 180.0));
}

TEST(SymmetryDetection, OfACylinderAnAxisAndAFlip)
{
  const meam::Symmetries found = meam::detectSymmetries(sampled(parts::regularPrism(72, 10, 30)));
  ASSERT_EQ(found.continuous.size(), 1u);
  EXPECT_GT(std::abs(found.continuous[0].axis.z()), 0.9999);
  EXPECT_LT(found.continuous[0].point.head<2>().norm(), 0.1);
  ASSERT_EQ(found.discrete.size(), 1u);
  EXPECT_LT(std::abs(Eigen::AngleAxisd(found.discrete[0].linear()).axis().z()), 0.02);
}

TEST(SymmetryDetection, OfASphereAllRotations)
{
  meam::PointCloud sphere;
  constexpr int Points = SmallData ? 2000 : 4000;
  for (int i = 0; i < Points; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / Points;
    const double radius = std::sqrt(1.0 - z * z);
    const double angle = 2.399963229728653 * i;
    sphere.normals.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    sphere.points.push_back(10.0f * sphere.normals.back() + Eigen::Vector3f(1, 2, 3));
  }
  const meam::Symmetries found = meam::detectSymmetries(sphere);
  ASSERT_EQ(found.continuous.size(), 3u);
  EXPECT_TRUE(found.discrete.empty());
  EXPECT_LT((found.continuous[0].point - Eigen::Vector3d(1, 2, 3)).norm(), 0.1);
}

TEST(SymmetryDetection, AFewSliversWithNormalsOfTheirOwnBreakNothing)
{
  meam::PointCloud surface = sampled(parts::box({ 5, 5, 5 }, { 35, 25, 15 }));
  for (const std::size_t i : { surface.size() / 7, surface.size() / 2 })
  {
    surface.normals[i] = Eigen::Vector3f(0.6f, -0.6f, 0.53f).normalized();
  }
  const meam::Symmetries found = meam::detectSymmetries(surface);
  EXPECT_EQ(found.discrete.size(), 3u);
  EXPECT_TRUE(found.near.empty());
}

TEST(SymmetryDetection, AnLBracketHasNone)
{
  const meam::Symmetries found = meam::detectSymmetries(sampled(parts::lBracket()));
  EXPECT_TRUE(found.continuous.empty());
  EXPECT_TRUE(found.discrete.empty());
}

TEST(SymmetryDetection, ANotchMakesItNearAndTheDeviationShowsWhereItIs)
{
  // A square plate, 40 x 40 x 10, with one of its corners cut off by 8 mm.
  const meam::PointCloud surface =
    sampled(parts::prism({ { -20, -20 }, { 20, -20 }, { 20, 20 }, { -12, 20 }, { -20, 12 } }, 10), 0.02);
  const meam::Symmetries found = meam::detectSymmetries(surface);
  std::vector<Eigen::Isometry3d> near;
  for (const auto& symmetry : found.near)
  {
    near.push_back(symmetry.T);
    EXPECT_GT(symmetry.overlap, 0.8);
    EXPECT_LT(symmetry.overlap, 1.0);
    EXPECT_GT(symmetry.deviation, 2.0);
  }
  EXPECT_TRUE(contains(near, { 0, 0, 1 }, 90.0));
  EXPECT_TRUE(contains(near, { 0, 0, 1 }, 180.0));
  // Half a turn about the diagonal through the cut keeps even that: the one exact symmetry.
  ASSERT_EQ(found.discrete.size(), 1u);
  EXPECT_TRUE(contains(found.discrete, { -1, 1, 0 }, 180.0));

  const auto half = std::find_if(found.near.begin(), found.near.end(),
    [](const auto& symmetry) {
      return contains({ symmetry.T }, { 0, 0, 1 }, 180.0);
    });
  ASSERT_NE(half, found.near.end());
  const std::vector<float> deviation = meam::surfaceDeviation(surface, half->T, 5.0);
  ASSERT_EQ(deviation.size(), surface.size());
  for (std::size_t i = 0; i < surface.size(); ++i)
  {
    // Only what comes from the cut corner or goes there deviates.
    const Eigen::Vector3f& p = surface.points[i];
    if (std::abs(p.x() - p.y()) < 26.0f)
    {
      EXPECT_LT(deviation[i], 0.6f) << p.transpose();
    }
  }
  EXPECT_GT(*std::max_element(deviation.begin(), deviation.end()), 2.0f);
}

TEST(SymmetryDetection, BadInput)
{
  EXPECT_THROW(meam::detectSymmetries({}), meam::Error);
  meam::PointCloud bare = sampled(parts::lBracket());
  bare.normals.clear();
  EXPECT_THROW(meam::detectSymmetries(bare), meam::Error);
  EXPECT_THROW(
    meam::detectSymmetries(sampled(parts::lBracket()), {}, [](double share) { return share < 0.2; }), meam::Aborted);
}
