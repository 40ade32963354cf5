// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/symmetry/SampleIndex.h"

#include "TestParts.h"

#include <random>

namespace
{
/// Two sheets, 1 mm apart, that face away from each other: a thin plate of 10 x 10 samples, 1 mm apart.
meam::PointCloud plate()
{
  meam::PointCloud result;
  for (const float side : { -1.0f, 1.0f })
  {
    for (const Eigen::Vector3f& point : parts::lattice({ 0, 0 }, { 9, 9 }, 1.0f, 0.5f * side))
    {
      result.points.push_back(point);
      result.normals.emplace_back(0.0f, 0.0f, side);
    }
  }
  return result;
}
}

TEST(SampleIndex, TheNearestOnTheSameSide)
{
  const meam::PointCloud surface = plate();
  const meam::SampleIndex index(surface, 2.0, 0.5);
  const Eigen::Vector3f nearTheTop(3.2f, 4.1f, 0.4f);
  EXPECT_EQ(index.nearest(nearTheTop, Eigen::Vector3f::UnitZ(), 2.0), 100 + 34);
  EXPECT_EQ(index.nearest(nearTheTop, -Eigen::Vector3f::UnitZ(), 2.0), 34) << "below, farther, but it faces that way";
  EXPECT_EQ(index.nearest(nearTheTop, -Eigen::Vector3f::UnitZ(), 0.9), -1) << "sqrt(0.86) mm away";
  EXPECT_EQ(index.nearest(nearTheTop, Eigen::Vector3f::UnitX(), 2.0), -1);
  EXPECT_EQ(index.nearest({ 1e9f, 0, 0 }, Eigen::Vector3f::UnitZ(), 2.0), -1);
  EXPECT_EQ(index.nearest(Eigen::Vector3f::Constant(NAN), Eigen::Vector3f::UnitZ(), 2.0), -1);
}

TEST(SampleIndex, AtTheLimitsOfRadiusAndSide)
{
  meam::PointCloud surface;
  surface.points = { { 0, 0, 0 }, Eigen::Vector3f::Constant(NAN), { 8, 0, 0 } };
  surface.normals = { { 0.6f, 0, 0.8f }, Eigen::Vector3f::UnitZ(), Eigen::Vector3f::Constant(NAN) };
  const meam::SampleIndex index(surface, 1.0, 0.8);
  EXPECT_EQ(index.nearest({ 3, 4, 0 }, Eigen::Vector3f::UnitX(), 5.0), -1) << "the cosine is 0.6";
  EXPECT_EQ(index.nearest({ 3, 4, 0 }, Eigen::Vector3f::UnitZ(), 5.0), -1) << "0.8 and no more";
  EXPECT_EQ(index.nearest({ 3, 4, 0 }, { 0.6f, 0, 0.8f }, 5.0), 0) << "5 mm away";
  EXPECT_EQ(index.nearest({ 3, 4, 0 }, { 0.6f, 0, 0.8f }, 4.9), -1);
  EXPECT_EQ(index.nearest({ 8, 0, 0 }, Eigen::Vector3f::UnitZ(), 5.0), -1) << "a sample without a normal";
  EXPECT_EQ(meam::SampleIndex({}, 1.0, 0.8).nearest({ 0, 0, 0 }, Eigen::Vector3f::UnitZ(), 5.0), -1);
}

TEST(SampleIndex, OfEquallyNearOnesTheFirst)
{
  meam::PointCloud surface; // 24 at four places, all of them 1 mm from the middle
  for (int k = 0; k < 24; ++k)
  {
    const float side = k % 2 == 0 ? 1.0f : -1.0f;
    surface.points.emplace_back(k % 4 < 2 ? side : 0.0f, k % 4 < 2 ? 0.0f : side, 0.0f);
    surface.normals.push_back(Eigen::Vector3f::UnitZ());
  }
  for (const double cell : { 0.5, 5.0 })
  {
    const meam::SampleIndex index(surface, cell, 0.5);
    EXPECT_EQ(index.nearest({ 0, 0, 0 }, Eigen::Vector3f::UnitZ(), 1.0), index.grid().order().front()) << cell;
  }
}

TEST(SampleIndex, AsWhenAllAreLookedAt)
{
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  const auto any = [&] { return Eigen::Vector3f(normal(random), normal(random), normal(random)); };
  meam::PointCloud surface; // not a multiple of any vector
  for (int k = 0; k < 1001; ++k)
  {
    surface.points.push_back(3.0f * any());
    surface.normals.push_back(any().normalized());
  }
  const meam::SampleIndex index(surface, 0.7, 0.3);
  int found = 0;
  for (int k = 0; k < 500; ++k)
  {
    const Eigen::Vector3f point = 3.0f * any(), side = any().normalized();
    int best = -1;
    for (int i = 0; i < 1001; ++i)
    {
      const float distance = (surface.points[i] - point).squaredNorm();
      const bool isIn = distance <= 1.5f * 1.5f && surface.normals[i].dot(side) > 0.3f;
      best = isIn && (best < 0 || distance < (surface.points[best] - point).squaredNorm()) ? i : best;
    }
    EXPECT_EQ(index.nearest(point, side, 1.5), best);
    found += best >= 0 ? 1 : 0;
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(found, 500);
}
