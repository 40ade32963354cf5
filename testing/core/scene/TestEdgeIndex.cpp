// SPDX-License-Identifier: BSD-3-Clause
#include "scene/EdgeIndex.h"

#include "TestParts.h"

namespace
{
struct Mean
{
  Eigen::Vector3f offset;
  float weight;
};

struct Lines
{
  explicit Lines(const meam::PointCloud& seen, double cellSize = 3.0)
    : edges(seen)
    , lines(edges, cellSize)
  {
  }

  Mean meanAround(const Eigen::Vector3f& point, const Eigen::Vector3f& tangent, double radius, double across) const
  {
    meam::SoAOrientedPoints asked;
    asked.resize(1);
    asked.set(0, point, tangent);
    const meam::EdgeIndex::Neighbours neighbours = this->lines.neighbours(asked, radius, across, 0.0);
    const meam::EdgeIndex::Means means = meam::EdgeIndex::meansAround(neighbours, asked, radius, across);
    return { means.offsets[0], means.weights[0] };
  }

  meam::PointCloud edges;
  meam::EdgeIndex lines;
};

/// Points to ask about, beside those of the lines.
meam::PointCloud asked(int count)
{
  meam::PointCloud result = parts::scatteredEdges(count, 20.0);
  for (auto& point : result.points)
  {
    point += Eigen::Vector3f(0.3f, -0.2f, 0.1f);
  }
  return result;
}
}

TEST(EdgeIndex, FindsWhatAskingEveryLineFinds)
{
  const Lines among(parts::scatteredEdges(2000, 20.0));
  const meam::PointCloud& edges = among.edges;
  const meam::PointCloud asked = ::asked(200);
  int found = 0;
  for (const double radius : { 0.5, 4.0, 15.0 }) // 15: more rows of cells than are looked at together
  {
    for (std::size_t k = 0; k < asked.size(); ++k)
    {
      const Eigen::Vector3f& point = asked.points[k];
      int expected = -1;
      double least = radius * radius;
      for (std::size_t i = 0; i < edges.size(); ++i)
      {
        const Eigen::Vector3d offset = (point - edges.points[i]).cast<double>();
        const Eigen::Vector3d tangent = edges.tangents[i].cast<double>();
        const double across = offset.cross(tangent).squaredNorm();
        if (offset.norm() <= radius && std::abs(tangent.dot(asked.tangents[k].cast<double>())) > 0.85 && across < least)
        {
          least = across;
          expected = static_cast<int>(i);
        }
      }
      const meam::EdgeIndex::Match match = among.lines.nearest(point, asked.tangents[k], radius);
      EXPECT_EQ(match.edge, expected) << k << " within " << radius;
      if (expected >= 0)
      {
        EXPECT_NEAR(match.squaredDistance, least, 1e-3 * least + 1e-5);
        ++found;
      }
    }
  }
  EXPECT_GT(found, 200);
}

TEST(EdgeIndex, DistanceIsThatToTheLine)
{
  meam::PointCloud edges;
  edges.points = { { 0, 0, 0 }, { 0, 3, 0 } };
  edges.tangents = { { 0, 1, 0 }, { 1, 0, 0 } };
  const Lines among(edges, 1.0);
  // 2 along the first line and 0.5 beside it; the second is nearer, but runs across.
  meam::EdgeIndex::Match match = among.lines.nearest({ 0.5f, 2.0f, 0.0f }, { 0, -1, 0 }, 2.5);
  EXPECT_EQ(match.edge, 0);
  EXPECT_FLOAT_EQ(match.squaredDistance, 0.25f);
  EXPECT_EQ(among.lines.nearest({ 0.5f, 2.0f, 0.0f }, { 1, 0, 0 }, 2.5).edge, 1);
  EXPECT_EQ(among.lines.nearest({ 0.5f, 2.0f, 0.0f }, { 0, 0, 1 }, 2.5).edge, -1);
  EXPECT_EQ(among.lines.nearest({ 0.5f, 2.0f, 0.0f }, { 0, -1, 0 }, 1.0).edge, -1);
}

TEST(EdgeIndex, MeansTakeEdgePointsByTheirWeights)
{
  meam::PointCloud edges;
  edges.points = { { 0, 1, 0 }, { 0, -1, 0 } };
  edges.tangents.assign(2, Eigen::Vector3f::UnitX());
  const auto mean = [&] { return Lines(edges).meanAround({ 0, 0, 0 }, Eigen::Vector3f::UnitX(), 4.0, 3.0); };
  EXPECT_NEAR(mean().offset.y(), 0.0f, 1e-6f);
  const float whole = mean().weight;
  edges.weights = { 0.25f, 0.75f };
  EXPECT_NEAR(mean().offset.y(), 0.5f, 1e-6f) << "the point lies 1 below the first and 1 above the second";
  EXPECT_NEAR(mean().weight, 0.5f * whole, 1e-6f);
  edges.weights = { 1.0f, 0.0f };
  EXPECT_NEAR(mean().offset.y(), -1.0f, 1e-6f);
}

TEST(EdgeIndex, MeanIsThatOfAllEdgePointsAround)
{
  const Lines among(parts::scatteredEdges(2000, 20.0));
  const meam::PointCloud& edges = among.edges;
  const meam::PointCloud asked = ::asked(100);
  int found = 0;
  for (const double radius : { 2.0, 15.0 })
  {
    const double across = 0.5 * radius;
    for (std::size_t k = 0; k < asked.size(); ++k)
    {
      const Eigen::Vector3f& point = asked.points[k];
      const Eigen::Vector3d tangent = asked.tangents[k].cast<double>();
      double weights = 0.0;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < edges.size(); ++i)
      {
        const Eigen::Vector3d d = (point - edges.points[i]).cast<double>();
        const Eigen::Vector3d beside = d - d.dot(tangent) * tangent;
        const double cosine = tangent.dot(edges.tangents[i].cast<double>());
        const double near = std::max(0.0, 1.0 - d.squaredNorm() / (radius * radius));
        const double close = std::max(0.0, 1.0 - beside.squaredNorm() / (across * across));
        const double parallel = std::max(0.0, (cosine * cosine - 0.7225) / 0.2775);
        const double weight = near * near * close * close * parallel;
        weights += weight;
        sum += weight * beside;
      }
      const Mean mean = among.meanAround(point, asked.tangents[k], radius, across);
      EXPECT_NEAR(mean.weight, weights, 1e-4 * weights + 1e-5);
      if (weights > 1e-3)
      {
        EXPECT_LT((mean.offset.cast<double>() - sum / weights).norm(), 1e-3 * radius);
        ++found;
      }
    }
  }
  EXPECT_GT(found, 100);
}

TEST(EdgeIndex, TheMeanByHand)
{
  meam::PointCloud edges;
  edges.points = { { 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0.5f } };
  edges.tangents = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 } }; // the last runs across
  const Lines among(edges, 1.0);
  // Half way between two lines; along them nothing counts.
  Mean mean = among.meanAround({ 0.6f, 0.5f, 0.0f }, { 1, 0, 0 }, 2.0, 1.0);
  EXPECT_TRUE(mean.offset.isZero(1e-6f));
  const double near = 1.0 - (0.36 + 0.25) / 4.0;
  EXPECT_NEAR(mean.weight, 2.0 * near * near * 0.75 * 0.75, 1e-5);
  // One of them out of reach.
  mean = among.meanAround({ 0.0f, -0.25f, 0.0f }, { 1, 0, 0 }, 2.0, 1.0);
  EXPECT_TRUE(mean.offset.isApprox(Eigen::Vector3f(0, -0.25f, 0), 1e-5f));
  EXPECT_EQ(among.meanAround({ 0.0f, 9.0f, 0.0f }, { 1, 0, 0 }, 2.0, 1.0).weight, 0.0f);
}

TEST(EdgeIndex, NeighboursServeUntilAPointHasMovedByTheMargin)
{
  const Lines among(parts::scatteredEdges(2000, 20.0));
  const meam::PointCloud points = asked(100);
  constexpr double Radius = 6.0, Across = 2.0, Margin = 0.4;
  const Eigen::Vector3f step = 0.99f * Margin * Eigen::Vector3f(0.6f, 0.0f, -0.8f);
  const Eigen::Matrix3f turn =
    Eigen::AngleAxisf(0.07f, Eigen::Vector3f(1, 2, 2) / 3.0f).toRotationMatrix(); // 4 degrees
  meam::SoAOrientedPoints before, after;
  before.resize(points.size());
  after.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    before.set(k, points.points[k], points.tangents[k]);
    after.set(k, points.points[k] + step, turn * points.tangents[k]);
  }
  const meam::EdgeIndex::Neighbours once = among.lines.neighbours(before, Radius, Across, Margin);
  ASSERT_EQ(once.starts.size(), points.size() + 1);
  const meam::EdgeIndex::Means means = meam::EdgeIndex::meansAround(once, after, Radius, Across);
  int found = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Mean afresh = among.meanAround(after.points[k], after.directions[k], Radius, Across);
    EXPECT_NEAR(means.weights[k], afresh.weight, 1e-5f);
    EXPECT_LT((means.offsets[k] - afresh.offset).norm(), 1e-5f);
    found += means.weights[k] > 0.0f ? 1 : 0;
  }
  EXPECT_GT(found, 50);
}

TEST(EdgeIndex, NoEdgesNoMatch)
{
  const Lines none({});
  EXPECT_EQ(none.lines.nearest({ 1, 2, 3 }, { 1, 0, 0 }, 5.0).edge, -1);
  EXPECT_EQ(none.meanAround({ 1, 2, 3 }, { 1, 0, 0 }, 5.0, 5.0).weight, 0.0f);
}
