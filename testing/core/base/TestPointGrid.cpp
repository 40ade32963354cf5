// SPDX-License-Identifier: BSD-3-Clause
#include "base/PointGrid.h"

#include "TestParts.h"
#include "base/Error.h"
#include "base/sequences/Sequences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace
{
using parts::scattered;

std::set<int> within(const meam::PointGrid& grid, const Eigen::Vector3f& centre, double radius)
{
  std::set<int> found;
  grid.forEachWithin(centre, radius, [&](int index, float) { found.insert(index); });
  return found;
}

void expectSameAsBruteForce(const meam::Points& points, double cellSize, double radius)
{
  const meam::PointGrid grid(points, cellSize);
  for (std::size_t k = 0; k < points.size(); k += 7)
  {
    std::set<int> expected;
    int nearest = -1;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const float distance = (points[i] - points[k]).squaredNorm();
      if (distance <= static_cast<float>(radius) * static_cast<float>(radius))
      {
        expected.insert(static_cast<int>(i));
        nearest = nearest < 0 || distance < (points[nearest] - points[k]).squaredNorm() ? static_cast<int>(i) : nearest;
      }
    }
    EXPECT_EQ(within(grid, points[k], radius), expected);
    EXPECT_EQ((points[grid.nearest(points[k], radius)] - points[nearest]).norm(), 0.0f);
  }
}
}

TEST(PointGrid, FindsWhatBruteForceFinds)
{
  for (const double cell : { 0.5, 3.0, 50.0 })
  {
    expectSameAsBruteForce(scattered(500, 20.0), cell, 3.0);
  }
}

TEST(PointGrid, StrayPointsAreFoundToo)
{
  meam::Points points = scattered(3000, 20.0);
  points.emplace_back(5e4f, 5e4f, -5e4f);
  points.emplace_back(5e4f + 1.0f, 5e4f, -5e4f);
  expectSameAsBruteForce(points, 0.5, 2.0);
  const meam::PointGrid grid(points, 0.5);
  EXPECT_EQ(within(grid, { 5e4f, 5e4f, -5e4f }, 2.0), std::set<int>({ 3000, 3001 }));
  EXPECT_TRUE(within(grid, { -9e5f, 0, 0 }, 2.0).empty());
}

TEST(PointGrid, NothingIsNearAPlaceThatIsNotFinite)
{
  const meam::PointGrid grid({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 5 } }, 0.5);
  EXPECT_EQ(grid.nearest({ NAN, 0, 0 }, 1.0), -1);
  EXPECT_EQ(grid.nearest({ 0, INFINITY, 0 }, 1.0), -1);
  EXPECT_EQ(grid.nearest({ -INFINITY, NAN, 3 }, 1.0), -1);
}

TEST(PointGrid, WhatCannotBeSortedIsAnError)
{
  EXPECT_THROW(meam::PointGrid(scattered(5, 1.0), 0.0), meam::Error);
  EXPECT_THROW(meam::PointGrid({ { -3e38f, 0, 0 }, { 3e38f, 0, 0 } }, 1.0), meam::Error);
  EXPECT_EQ(meam::PointGrid({}, 1.0).nearest({ 0, 0, 0 }, 1.0), -1);
  EXPECT_EQ(meam::PointGrid({ { NAN, 0, 0 }, { 1, 0, 0 } }, 1.0).nearest({ 1, 0, 0 }, 1.0), 1);
}

TEST(PointGrid, OnePointStaysPerOccupiedCube)
{
  // Cubes of 2 mm from the origin: the first holds three points, whose mean is (0.9, 0, 0).
  const meam::Points points = { { 0.1f, 0, 0 }, { 5, 0, 0 }, { 0.8f, 0, 0 }, { 1.8f, 0, 0 }, { -0.1f, 0, 0 } };
  EXPECT_EQ(meam::thinPoints(points, 2.0), std::vector<int>({ 4, 2, 1 })) << "cube by cube";
  const meam::Points two = { { 0.2f, 0, 0 }, { 1.2f, 0, 0 } }; // equally near to their mean, the second to the middle
  EXPECT_EQ(meam::thinPoints(two, 2.0), std::vector<int>({ 1 }));
  EXPECT_EQ(meam::thinPoints({ two[1], two[0] }, 2.0), std::vector<int>({ 0 }));
  EXPECT_EQ(meam::thinPoints(points, 0.0).size(), 5u);
  EXPECT_EQ(meam::thinPoints({ { NAN, 0, 0 }, { 1, 0, 0 }, { 0, INFINITY, 0 } }, 2.0), std::vector<int>({ 1 }));
  EXPECT_EQ(meam::thinPoints({ { 3e38f, 0, 0 }, { 1, 0, 0 } }, 1e-3).size(), 2u);
}

TEST(PointGrid, OnePointOfEachSideOfASheetStaysPerCube)
{
  const Eigen::Vector3f up(0, 0, 1), aslant(0.8f, 0, 0.6f), down(0, 0, -1);
  meam::PointCloud sheet;
  sheet.points = { { 0.4f, 1, 1.2f }, { 1.0f, 1, 1.2f }, { 1.6f, 1, 1.2f }, { 0.5f, 1, 0.8f }, { 1.1f, 1, 0.8f },
    { 5, 1, 1 } };
  sheet.normals = { up, aslant, up, down, down, down };
  EXPECT_EQ(meam::thinSurface(sheet, 2.0), std::vector<int>({ 1, 4, 5 })) << "nearest to the mean of its side";
  sheet.normals = { up, aslant, up, up, up, down };
  EXPECT_EQ(meam::thinSurface(sheet, 2.0), meam::thinPoints(sheet.points, 2.0)) << "one side";
  EXPECT_EQ(meam::thinSurface(sheet, 0.0).size(), 6u);
}

TEST(PointGrid, ThinningLooksAtEveryCube)
{
  // Cubes on both sides of the origin, more along an axis than one digit of the sort counts.
  std::mt19937 random(17);
  std::uniform_real_distribution<float> x(-4000.0f, 5000.0f), y(-5.0f, 3.0f);
  const auto points = meam::ofIndices<Eigen::Vector3f>(20000,
    [&](int) {
      return Eigen::Vector3f{ x(random), y(random), y(random) };
    });
  constexpr double Leaf = 2.5;
  std::map<std::array<int, 3>, std::vector<int>> cubes; // by z, y, x
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Array3i cube = (points[i].cast<double>() / Leaf).array().floor().cast<int>();
    cubes[{ cube.z(), cube.y(), cube.x() }].push_back(static_cast<int>(i));
  }
  std::vector<int> expected;
  int several = 0;
  for (const auto& [cube, members] : cubes)
  {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const int i : members)
    {
      mean += points[i].cast<double>() / members.size();
    }
    const auto distance = [&](int k) { return (points[k].cast<double>() - mean).norm(); };
    std::vector<int> byDistance = members;
    std::sort(byDistance.begin(), byDistance.end(), [&](int a, int b) { return distance(a) < distance(b); });
    // Of two that are equally near, as two points always are, another rule decides.
    const bool isClear = members.size() == 1 || distance(byDistance[1]) - distance(byDistance[0]) > 2e-4 * Leaf;
    expected.push_back(isClear ? byDistance[0] : -1);
    several += members.size() > 2 ? 1 : 0;
  }
  const std::vector<int> kept = meam::thinPoints(points, Leaf);
  ASSERT_EQ(kept.size(), expected.size());
  EXPECT_GT(several, 100);
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    EXPECT_TRUE(expected[k] < 0 || kept[k] == expected[k]) << k;
  }
}

TEST(PointGrid, WeightsFadeAtTheBorders)
{
  // Cubes of 10 mm with one's middle at the origin. Over 1.5 mm next to a border points fade.
  const auto alone = [](const Eigen::Vector3f& point) { return meam::thinWithWeights({ point }, 10.0).weights.at(0); };
  EXPECT_FLOAT_EQ(alone({ 0, 0, 0 }), 1.0f);
  EXPECT_FLOAT_EQ(alone({ 3.4f, -13.4f, 0 }), 1.0f);
  EXPECT_NEAR(alone({ 4.25f, 0, 0 }), 0.5f, 1e-5f);
  EXPECT_NEAR(alone({ -4.25f, 0, 14.625f }), 0.125f, 1e-5f);
  EXPECT_NEAR(alone({ 0, 4.9999f, 0 }), 0.0f, 1e-4f);

  // By weights of 1, 1, 1 and 0.1 the mean is at 3.985 / 3.1 = 1.29; without them it would be at 2.09, where 3 is
  // nearer.
  const meam::Points points = { { 0, 0, 0 }, { 0.5f, 0, 0 }, { 3, 0, 0 }, { 4.85f, 0, 0 }, { 40, 0, 0 } };
  const meam::ThinnedPoints kept = meam::thinWithWeights(points, 10.0);
  EXPECT_EQ(kept.indices, std::vector<int>({ 1, 4 }));
  EXPECT_EQ(kept.weights, std::vector<float>({ 1.0f, 1.0f }));
  const meam::ThinnedPoints two = meam::thinWithWeights({ { 4.7f, 0, 0 }, { 4.85f, 0, 0 } }, 10.0);
  EXPECT_NEAR(two.weights.at(0), 0.3f, 1e-4f) << "0.2 + 0.1";
  EXPECT_TRUE(meam::thinWithWeights({}, 1.0).indices.empty());
  EXPECT_EQ(meam::thinWithWeights({ { 1, 2, 3 } }, 0.0).weights, std::vector<float>({ 1.0f })) << "no leaf";
}

TEST(PointGrid, SumsByWeightsChangeSteadily)
{
  // A row of points moves by a cube's side in small steps: the sum of what is kept hardly changes from one to the next.
  double before = -1.0, most = 0.0;
  int changes = 0, keptBefore = -1;
  for (int step = 0; step <= 1000; ++step)
  {
    const auto row = meam::ofIndices<Eigen::Vector3f>(7,
      [&](int k) {
        return Eigen::Vector3f{ 3.7f * k + 0.01f * step, 0, 0 };
      });
    const meam::ThinnedPoints kept = meam::thinWithWeights(row, 10.0);
    double sum = 0.0;
    for (const float weight : kept.weights)
    {
      sum += weight;
    }
    most = std::max(most, before < 0.0 ? 0.0 : std::abs(sum - before));
    before = sum;
    changes += keptBefore >= 0 && keptBefore != static_cast<int>(kept.indices.size()) ? 1 : 0;
    keptBefore = static_cast<int>(kept.indices.size());
  }
  EXPECT_GT(changes, 0) << "the number of cubes changes";
  EXPECT_LT(most, 0.01);
}

TEST(PointGrid, AStrayPointDoesNotChangeHowTheOthersAreThinned)
{
  auto points = meam::ofIndices<Eigen::Vector3f>(100, [&](int k) { return Eigen::Vector3f{ 0.5f + k, 0.5f, 0.5f }; });
  std::vector<int> alone = meam::thinPoints(points, 2.0);
  EXPECT_EQ(alone.size(), 50u);
  for (const float far : { 3e38f, -3e38f })
  {
    points.push_back({ 1.0f, far, 0.5f });
    const std::vector<int> kept = meam::thinPoints(points, 2.0);
    EXPECT_EQ(kept.size(), 51u);
    for (const int i : alone)
    {
      EXPECT_EQ(std::count(kept.begin(), kept.end(), i), 1) << i;
    }
    points.pop_back();
  }
  EXPECT_EQ(meam::thinPoints(points, NAN).size(), 100u) << "no leaf";
  EXPECT_GE(meam::thinPoints(points, 1e-307).size(), 1u) << "beyond what can be counted";
}
