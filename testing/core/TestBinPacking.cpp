// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/BinPacking.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
const Eigen::Vector3f size(40, 30, 10);

/// A box from the origin to `size`.
meam::TriangleMesh box()
{
  meam::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.vertices.emplace_back((i & 1) * size.x(), ((i >> 1) & 1) * size.y(), ((i >> 2) & 1) * size.z());
  }
  mesh.triangles = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 }, { 2, 6, 3 },
    { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  return mesh;
}

/// How far apart two of the boxes are along the best of the axes that can separate boxes; negative:
/// they cross.
double gap(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  std::vector<Eigen::Vector3d> axes;
  for (int i = 0; i < 3; ++i)
  {
    axes.emplace_back(a.linear().col(i));
    axes.emplace_back(b.linear().col(i));
    for (int j = 0; j < 3; ++j)
    {
      const Eigen::Vector3d across = a.linear().col(i).cross(b.linear().col(j));
      if (across.norm() > 1e-6)
      {
        axes.emplace_back(across.normalized());
      }
    }
  }
  const Eigen::Vector3d half = 0.5 * size.cast<double>();
  const Eigen::Vector3d between = b * half - a * half;
  double best = -1e9;
  for (const auto& axis : axes)
  {
    const double reach =
      (a.linear().transpose() * axis).cwiseAbs().dot(half) + (b.linear().transpose() * axis).cwiseAbs().dot(half);
    best = std::max(best, std::abs(between.dot(axis)) - reach);
  }
  return best;
}
}

TEST(BinPacking, copiesDoNotCrossEachOtherOrTheBin)
{
  meam::Random random(3);
  const auto poses = meam::packBin(box(), 100.0, 12, random);
  ASSERT_EQ(poses.size(), 12u);
  double highest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    EXPECT_NEAR(poses[i].linear().determinant(), 1.0, 1e-9);
    for (std::size_t j = 0; j < i; ++j)
    {
      EXPECT_GE(gap(poses[i], poses[j]), -1e-3) << i << " " << j;
    }
    for (const auto& vertex : box().vertices)
    {
      const Eigen::Vector3d point = poses[i] * vertex.cast<double>();
      EXPECT_LE(std::abs(point.x()), 50.001);
      EXPECT_LE(std::abs(point.y()), 50.001);
      EXPECT_GE(point.z(), -1e-3);
      highest = std::max(highest, point.z());
    }
  }
  // 12 boxes of 12000 mm3 on 10000 mm2: 14 mm high if there were no gaps.
  EXPECT_GT(highest, 20.0);
  EXPECT_LT(highest, 80.0);
}

TEST(BinPacking, aLoneBoxLiesOnAFace)
{
  for (const unsigned seed : { 1u, 2u, 3u })
  {
    meam::Random random(seed);
    const Eigen::Isometry3d pose = meam::packBin(box(), 200.0, 1, random)[0];
    const double steepest = pose.linear().row(2).cwiseAbs().maxCoeff();
    EXPECT_GT(steepest, std::cos(3.0 * M_PI / 180.0));
    double lowest = 1e9;
    for (const auto& vertex : box().vertices)
    {
      lowest = std::min(lowest, (pose * vertex.cast<double>()).z());
    }
    EXPECT_NEAR(lowest, 0.0, 1e-3);
  }
}

TEST(BinPacking, theSeedDecides)
{
  const auto matrixOf = [](unsigned seed)
  {
    meam::Random random(seed);
    return meam::packBin(box(), 100.0, 3, random)[2].matrix().eval();
  };
  EXPECT_EQ(matrixOf(1), matrixOf(1));
  EXPECT_NE(matrixOf(1), matrixOf(2));
}

TEST(BinPacking, aBinThatIsTooSmall)
{
  meam::Random random(1);
  EXPECT_THROW(meam::packBin(box(), 5.0, 1, random), meam::Error);
  EXPECT_THROW(meam::packBin(box(), 100.0, 5, random, [](double) { return false; }), meam::Aborted);
}
