// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/LongLines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace
{
constexpr double LongLinesDiameter = 100.0, LongLinesTolerance = 3.0;

/// Points 1 mm apart from `from` along a unit direction, which is their tangent.
void addLine(const Eigen::Vector3f& from, const Eigen::Vector3f& along, float length, meam::PointCloud& edges)
{
  for (float s = 0.0f; s <= length; s += 1.0f)
  {
    edges.points.push_back(from + s * along);
    edges.tangents.push_back(along);
  }
}

int onLines(const meam::PointCloud& edges, int threads = 1)
{
  const auto found =
    meam::onLongLines(edges, meam::EdgeIndex(edges, 8.0), LongLinesDiameter, LongLinesTolerance, threads);
  EXPECT_EQ(found.size(), edges.size());
  return static_cast<int>(std::count(found.begin(), found.end(), 1));
}

const Eigen::Vector3f Along = Eigen::Vector3f(3, 0, 4).normalized();
}

TEST(LongLines, ALineIsLongFromOneAndAQuarterOfThePartOn)
{
  meam::PointCloud shorter, longer;
  addLine({ 10, 20, 500 }, Along, 115, shorter);
  EXPECT_EQ(onLines(shorter), 0);
  addLine({ 10, 20, 500 }, Along, 200, longer);
  EXPECT_EQ(onLines(longer), 201);
}

TEST(LongLines, OthersBesideAndAcrossALongOneAreNotOnIt)
{
  meam::PointCloud edges;
  addLine({ 0, 0, 500 }, { 1, 0, 0 }, 300, edges);
  addLine({ 100, 10, 500 }, { 1, 0, 0 }, 80, edges); // a part's edge 10 mm beside
  addLine({ 50, -40, 500 }, { 0, 1, 0 }, 80, edges); // and one across
  EXPECT_EQ(onLines(edges), 301);
}

TEST(LongLines, GapsOfAStepAreCrossedAndLongerOnesAreNot)
{
  meam::PointCloud narrow, wide;
  addLine({ 0, 0, 500 }, { 1, 0, 0 }, 80, narrow);
  addLine({ 86, 0, 500 }, { 1, 0, 0 }, 80, narrow);
  EXPECT_EQ(onLines(narrow), static_cast<int>(narrow.size()));
  addLine({ 0, 0, 500 }, { 1, 0, 0 }, 80, wide); // parts in a row, a fifth of their size apart
  addLine({ 101, 0, 500 }, { 1, 0, 0 }, 80, wide);
  EXPECT_EQ(onLines(wide), 0);
}

TEST(LongLines, OneIsFoundAmongManyOthersWhateverTheirOrder)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-250.0f, 250.0f);
  meam::PointCloud edges;
  addLine({ -70, 0, 500 }, { 1, 0, 0 }, 140, edges);
  const int count = static_cast<int>(edges.size());
  for (int k = 0; k < 5000; ++k)
  {
    edges.points.emplace_back(place(random), place(random), 500.0f + 0.3f * place(random));
    edges.tangents.push_back(Eigen::Vector3f(place(random), place(random), place(random)).normalized());
  }
  const int found = onLines(edges);
  EXPECT_GE(found, count);
  EXPECT_LT(found, count + 20);
  meam::PointCloud other;
  std::vector<int> order(edges.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  for (const int i : order)
  {
    other.points.push_back(edges.points[i]);
    other.tangents.push_back(edges.tangents[i]);
  }
  EXPECT_EQ(onLines(other), found);
}

TEST(LongLines, ACircleIsNone)
{
  meam::PointCloud edges;
  for (int k = 0; k < 720; ++k)
  {
    const float angle = static_cast<float>(k * M_PI / 360.0);
    edges.points.emplace_back(150.0f * std::cos(angle), 150.0f * std::sin(angle), 500.0f);
    edges.tangents.emplace_back(-std::sin(angle), std::cos(angle), 0.0f);
  }
  EXPECT_EQ(onLines(edges), 0);
}

TEST(LongLines, NoiseAndTheNumberOfThreadsChangeNothing)
{
  meam::PointCloud edges;
  addLine({ 0, 0, 500 }, Along, 300, edges);
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const float offset = 0.5f * std::sin(12.9898f * static_cast<float>(k));
    edges.points[k] += offset * Eigen::Vector3f::UnitY();
    edges.tangents[k] = (edges.tangents[k] + 0.2f * offset * Eigen::Vector3f::UnitY()).normalized();
  }
  EXPECT_EQ(onLines(edges), 301);
  EXPECT_EQ(onLines(edges, 2), 301);
  EXPECT_EQ(onLines(meam::PointCloud{}), 0);
}
