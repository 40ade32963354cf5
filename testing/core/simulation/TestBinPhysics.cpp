// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"
#include "TestSteps.h"
#include "simulation/BinPhysics.h"
#include "mesh/TriangleMesh.h"

#include <algorithm>
#include <cmath>

namespace
{
using Profile = std::vector<Eigen::Vector2d>; // distance from the z axis, z; inside is on the left

/// How far a point is outside of the revolved profile; negative: inside.
double distanceTo(const Profile& profile, const Eigen::Vector3d& point)
{
  const Eigen::Vector2d p(std::hypot(point.x(), point.y()), point.z());
  double least = 1e9;
  bool inside = false;
  for (std::size_t i = 0; i < profile.size(); ++i)
  {
    const Eigen::Vector2d& a = profile[i];
    const Eigen::Vector2d& b = profile[(i + 1) % profile.size()];
    const double share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + share * (b - a) - p).norm());
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
    {
      inside = !inside;
    }
  }
  return inside ? -least : least;
}

/// A ring 100 mm across.
Profile ring()
{
  Profile profile;
  for (int i = 0; i < 16; ++i)
  {
    profile.emplace_back(45.0 + 5.0 * std::cos(i * M_PI / 8.0), 5.0 * std::sin(i * M_PI / 8.0));
  }
  return profile;
}

/// A cup with slanted walls, 40 mm high.
Profile cup() { return { { 1e-3, 0.0 }, { 20.0, 0.0 }, { 30.0, 40.0 }, { 28.0, 40.0 }, { 18.5, 2.0 }, { 1e-3, 2.0 } }; }

meam::FilledBin fill(const meam::TriangleMesh& part, double size, int copies, unsigned seed = 1)
{
  meam::Random random(seed);
  return meam::fillBin(part, Eigen::Vector2d::Constant(size), copies, random);
}

Eigen::AlignedBox3d boundsOf(const meam::TriangleMesh& part, const Eigen::Isometry3d& pose)
{
  Eigen::AlignedBox3d box;
  for (const auto& vertex : part.vertices)
  {
    box.extend(pose * vertex.cast<double>());
  }
  return box;
}

/// What holds for every bin at rest.
void expectAtRest(const meam::FilledBin& bin, const meam::TriangleMesh& part, double size, double diameter)
{
  EXPECT_LT(bin.speed, 20.0);
  for (const Eigen::Isometry3d& pose : bin.poses)
  {
    EXPECT_LT((pose.linear().transpose() * pose.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_GT(pose.linear().determinant(), 0.0);
    const Eigen::AlignedBox3d box = boundsOf(part, pose);
    EXPECT_GT(box.min().z(), -0.005 * diameter);
    EXPECT_LT(box.sizes().z(), diameter * 1.001);
    const double side = std::max(-box.min().head<2>().minCoeff(), box.max().head<2>().maxCoeff());
    EXPECT_LT(side, 0.5 * size + 0.005 * diameter);
  }
}

/// How far the two that are the nearest are apart; negative: so deep does one stand in the other.
double leastGap(const meam::FilledBin& bin, const meam::TriangleMesh& part, const Profile& profile)
{
  double least = 1e9;
  for (const Eigen::Isometry3d& a : bin.poses)
  {
    for (const Eigen::Isometry3d& b : bin.poses)
    {
      const Eigen::Isometry3d T_b_a = b.inverse() * a;
      for (std::size_t i = 0; &a != &b && i < part.vertices.size(); ++i)
      {
        least = std::min(least, distanceTo(profile, T_b_a * part.vertices[i].cast<double>()));
      }
    }
  }
  return least;
}
}

TEST(BinPhysics, ringsReachIntoEachOtherButDoNotCross)
{
  const meam::TriangleMesh part = parts::revolved(ring(), 64);
  const double size = 250.0;
  const meam::FilledBin bin = fill(part, size, 12);
  ASSERT_EQ(bin.poses.size(), 12u);
  expectAtRest(bin, part, size, 100.0);
  EXPECT_GT(leastGap(bin, part, ring()), -1.0);
  int tilted = 0, onFloor = 0, higher = 0, inOther = 0;
  for (const Eigen::Isometry3d& pose : bin.poses)
  {
    const double tilt = std::acos(std::min(1.0, std::abs(pose(2, 2)))) * 180.0 / M_PI;
    tilted += tilt > 5.0;
    onFloor += boundsOf(part, pose).min().z() < 1.0;
    higher += pose.translation().z() > 10.0;
    // Into the opening of another one, through the plane of that one.
    for (const Eigen::Isometry3d& other : bin.poses)
    {
      const Eigen::Isometry3d T_other_ring = other.inverse() * pose;
      const auto at = [&](int degrees)
      {
        const double angle = degrees * M_PI / 180.0;
        return Eigen::Vector3d(T_other_ring * Eigen::Vector3d(45.0 * std::cos(angle), 45.0 * std::sin(angle), 0.0));
      };
      for (int i = 0; &other != &pose && i < 360; ++i)
      {
        inOther += (at(i).z() > 0.0) != (at(i + 1).z() > 0.0) && at(i).head<2>().norm() < 40.0;
      }
    }
  }
  EXPECT_GE(tilted, 3);
  EXPECT_GE(onFloor, 4);
  EXPECT_GE(higher, 3);
  EXPECT_GT(inOther, 0); // convex hulls would forbid it
}

TEST(BinPhysics, cupsDoNotCross)
{
  const meam::TriangleMesh part = parts::revolved(cup(), 48);
  const meam::FilledBin bin = fill(part, 160.0, 8, 2);
  expectAtRest(bin, part, 160.0, 72.5);
  EXPECT_GT(leastGap(bin, part, cup()), -0.72);
}

TEST(BinPhysics, aBoxComesToLieFlat)
{
  const meam::TriangleMesh part = parts::box({ 0, 0, 0 }, { 40, 30, 10 });
  for (const unsigned seed : { 1u, 2u, 3u })
  {
    const Eigen::Isometry3d pose = fill(part, 100.0, 1, seed).poses.at(0);
    EXPECT_GT(pose.linear().row(2).cwiseAbs().maxCoeff(), std::cos(0.5 * M_PI / 180.0));
    EXPECT_NEAR(boundsOf(part, pose).min().z(), 0.0, 0.1);
  }
}

TEST(BinPhysics, whatLosesItsSupportFallsAndWhatRestsStays)
{
  const meam::TriangleMesh part = parts::box({ 0, 0, 0 }, { 40, 30, 10 });
  const auto at = [](double x, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, -15.0, z)); };
  // One on the floor, and one where another has been taken from under it.
  const meam::FilledBin bin = meam::settleBin(part, { 200.0, 200.0 }, { at(-70.0, 0.1), at(20.0, 10.2) });
  ASSERT_EQ(bin.poses.size(), 2u);
  expectAtRest(bin, part, 200.0, 51.0);
  for (const auto& pose : bin.poses)
  {
    EXPECT_NEAR(boundsOf(part, pose).min().z(), 0.0, 0.3);
    EXPECT_GT(pose(2, 2), std::cos(1.0 * M_PI / 180.0));
  }
  EXPECT_LT((bin.poses[0].translation() - at(-70.0, 0.0).translation()).norm(), 1.0);
  EXPECT_LT((bin.poses[1].translation() - at(20.0, 0.0).translation()).norm(), 3.0);
  EXPECT_TRUE(meam::settleBin(part, { 200.0, 200.0 }, {}).poses.empty());
}

TEST(BinPhysics, sheetsWithoutThicknessDoNotCross)
{
  const meam::TriangleMesh part = parts::rectangle(60, 40);
  const meam::FilledBin bin = fill(part, 120.0, 8);
  expectAtRest(bin, part, 120.0, 72.1);
  for (const Eigen::Isometry3d& a : bin.poses)
  {
    for (const Eigen::Isometry3d& b : bin.poses)
    {
      for (int i = 0; &a != &b && i < 4; ++i)
      {
        const Eigen::Isometry3d T_b_a = b.inverse() * a;
        const Eigen::Vector3d from = T_b_a * part.vertices[i].cast<double>();
        const Eigen::Vector3d to = T_b_a * part.vertices[(i + 1) % 4].cast<double>();
        if (from.z() * to.z() < 0.0)
        {
          const Eigen::Vector3d at = from + from.z() / (from.z() - to.z()) * (to - from);
          EXPECT_FALSE(at.x() > 0.5 && at.x() < 59.5 && at.y() > 0.5 && at.y() < 39.5) << at.transpose();
        }
      }
    }
  }
}

TEST(BinPhysics, theUnitOfTheCoordinatesDoesNotMatter)
{
  const auto heightOf = [](float scale)
  {
    const Eigen::Vector3f size = scale * Eigen::Vector3f(40, 30, 10);
    return fill(parts::box({ 0, 0, 0 }, size), 100.0 * scale, 1).poses.at(0).translation().z() / scale;
  };
  EXPECT_NEAR(heightOf(1.0), heightOf(0.125), 0.05);
}

TEST(BinPhysics, badInput)
{
  const meam::TriangleMesh part = parts::box({ 0, 0, 0 }, { 40, 30, 10 });
  EXPECT_THROW(fill({}, 100.0, 1), meam::Error);
  EXPECT_THROW(fill(part, 5.0, 1), meam::Error);
  meam::Random random(1);
  steps::expectStops(
    [&](const meam::Progress& progress) {
      meam::fillBin(part, { 100.0, 100.0 }, 5, random, progress);
    },
    { 0.3 });
}
