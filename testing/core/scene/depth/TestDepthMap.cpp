// SPDX-License-Identifier: BSD-3-Clause
#include "scene/depth/DepthMap.h"

#include "TestParts.h"
#include "base/sequences/Sequences.h"

#include <map>
#include <optional>
#include <random>

namespace
{
using parts::fromAbove;

/// Of one point.
std::optional<Eigen::Vector3f> meanAt(const meam::DepthMap& map, const Eigen::Vector3f& point, float* inside = nullptr)
{
  meam::SoAPoints columns;
  columns.add(point);
  meam::DepthMap::Seen seen;
  map.meansAt(columns, 0, 1, seen);
  if (inside)
  {
    *inside = seen.inside[0];
  }
  return seen.inside[0] > 0.0f ? std::optional<Eigen::Vector3f>({ seen.x[0], seen.y[0], seen.z[0] }) : std::nullopt;
}

/// A table of 21 x 21 points at z = 0 and a step of 5 x 21 on it at z = 8.
meam::Points step()
{
  return parts::lattice({ 0, 0 }, { 20, 20 }, 1.0f, [](float x, float) { return x >= 8 && x < 13 ? 8.0f : 0.0f; });
}
}

TEST(DepthMap, TellsHowAPointLiesToTheSurface)
{
  const meam::DepthMap map(step(), fromAbove(), 1.5);
  using Relation = meam::DepthMap::Relation;
  EXPECT_EQ(map.relation({ 3, 3, 0.2f }, 0.5f), Relation::OnSurface);
  EXPECT_EQ(map.relation({ 3, 3, 2.0f }, 0.5f), Relation::InFront);
  EXPECT_EQ(map.relation({ 3, 3, -2.0f }, 0.5f), Relation::Hidden);
  EXPECT_EQ(map.relation({ 10, 3, 8.2f }, 0.5f), Relation::OnSurface);
  EXPECT_EQ(map.relation({ 10, 3, 0.0f }, 0.5f), Relation::Hidden);
  EXPECT_EQ(map.relation({ 40, 3, 0.0f }, 0.5f), Relation::NoSurface);
  EXPECT_EQ(map.relation({ NAN, 3, 0.0f }, 0.5f), Relation::NoSurface);
}

TEST(DepthMap, ByTheMeanOnlyWhatWasMeasuredAtThePlaceCounts)
{
  using Relation = meam::DepthMap::Relation;
  meam::Points points;
  for (int x = 0; x < 7; ++x)
  {
    for (int y = 0; y < 7; ++y)
    {
      if (x != 3 || y != 3) // a gap of one cell
      {
        points.push_back({ 2.0f * x, 2.0f * y, 0.0f });
        points.push_back({ 2.0f * x + 0.1f, 2.0f * y, 1.0f });
      }
    }
  }
  const meam::DepthMap map(points, fromAbove(), 2.0);
  EXPECT_EQ(map.relation({ 4, 4, 1.2f }, 0.3f), Relation::OnSurface) << "near the nearest point";
  EXPECT_EQ(map.relationToMean({ 4, 4, 1.2f }, 0.3f), Relation::InFront);
  EXPECT_EQ(map.relationToMean({ 4, 4, 0.6f }, 0.3f), Relation::OnSurface);
  EXPECT_EQ(map.relationToMean({ 4, 4, 0.0f }, 0.3f), Relation::Hidden);
  EXPECT_EQ(map.relation({ 6, 6, 0.8f }, 0.3f), Relation::OnSurface) << "filled";
  EXPECT_EQ(map.relationToMean({ 6, 6, 0.5f }, 0.3f), Relation::NoSurface);
  EXPECT_EQ(map.relationToMean({ 40, 6, 0.5f }, 0.3f), Relation::NoSurface);
}

TEST(DepthMap, TellsWhichWayTheSurfaceFaces)
{
  const Eigen::Vector3f normal = Eigen::Vector3f(1.0f, -2.0f, 4.0f).normalized();
  const meam::Points slope =
    parts::lattice({ 0, 0 }, { 19.5f, 19.5f }, 0.5f, [](float x, float y) { return (2.0f * y - x) / 4.0f; });
  const meam::DepthMap map(slope, fromAbove(), 2.0);
  EXPECT_TRUE(map.normalAt({ 10, 10, 0 }).isApprox(normal, 1e-3f)) << map.normalAt({ 10, 10, 0 }).transpose();
  EXPECT_TRUE(map.normalAt({ 60, 10, 0 }).isZero()) << "nothing was seen";
  // Beside a jump the near side alone counts; of a single spot nothing can be told.
  const meam::DepthMap jump(step(), fromAbove(), 1.0);
  EXPECT_TRUE(jump.normalAt({ 8.0f, 10.0f, 8.0f }).isApprox(Eigen::Vector3f::UnitZ(), 1e-5f));
  EXPECT_TRUE(jump.normalAt({ 7.0f, 10.0f, 0.0f }).isApprox(Eigen::Vector3f::UnitZ(), 1e-5f));
  const meam::DepthMap spot({ { 5, 5, 0 } }, fromAbove(), 1.0);
  EXPECT_TRUE(spot.normalAt({ 5, 5, 0 }).isZero());
}

TEST(DepthMap, MeansAreOfTheNearestLayer)
{
  // Four points of one cell on a slope, two far below them.
  const meam::Points points = { { 0, 0, 1 }, { 1, 0, 2 }, { 0, 1, 1 }, { 1, 1, 2 }, { 0.5f, 0.5f, -30 },
    { 0.2f, 0.4f, -31 } };
  const meam::DepthMap map(points, fromAbove(), 4.0);
  ASSERT_EQ(map.means().size(), 1u);
  EXPECT_TRUE(map.means()[0].isApprox(Eigen::Vector3f(0.5f, 0.5f, 1.5f), 1e-5f));
  ASSERT_TRUE(meanAt(map, { 0.3f, 0.3f, 5 }));
  EXPECT_TRUE(meanAt(map, { 0.3f, 0.3f, 5 })->isApprox(map.means()[0]));
  EXPECT_FALSE(meanAt(map, { 100, 0, 0 }));
  EXPECT_EQ(map.relation({ 0.3f, 0.3f, -31 }, 0.5f), meam::DepthMap::Relation::OnSurface)
    << "the farthest was seen, too";
}

TEST(DepthMap, AGapOfOneCellIsFilledFromTheNearestSurface)
{
  meam::Points points;
  for (int x = 0; x < 5; ++x)
  {
    if (x != 2)
    {
      points.push_back({ static_cast<float>(x), 0, x < 2 ? 4.0f : 0.0f });
    }
  }
  const meam::DepthMap map(points, fromAbove(), 1.0);
  ASSERT_TRUE(meanAt(map, { 2, 0, 0 }));
  EXPECT_EQ(meanAt(map, { 2, 0, 0 })->z(), 4.0f);
  EXPECT_EQ(map.means().size(), 4u);
}

TEST(DepthMap, AGapInOneSurfaceIsTheMeanOfWhatIsBesideIt)
{
  const meam::DepthMap map({ { 0, 0, 4.0f }, { 1, 0, 4.0f }, { 3, 0, 5.0f }, { 4, 0, 5.0f } }, fromAbove(), 1.0);
  ASSERT_TRUE(meanAt(map, { 2, 0, 0 }));
  EXPECT_TRUE(meanAt(map, { 2, 0, 0 })->isApprox(Eigen::Vector3f(2, 0, 4.5f), 1e-6f));
  EXPECT_EQ(map.relation({ 2, 0, 5.0f }, 0.1f), meam::DepthMap::Relation::OnSurface);
  EXPECT_EQ(map.relation({ 2, 0, 4.0f }, 0.1f), meam::DepthMap::Relation::OnSurface);
}

TEST(DepthMap, AGapIsNotFilledWithWhatLiesBehind)
{
  // The cell beside the gap holds two surfaces: what is between them was never seen.
  const meam::DepthMap map({ { 0, 0, 4.0f }, { 1, 0, 4.0f }, { 1, 0, -9.0f }, { 3, 0, 4.0f } }, fromAbove(), 1.0);
  EXPECT_EQ(map.relation({ 2, 0, 4.0f }, 0.1f), meam::DepthMap::Relation::OnSurface);
  EXPECT_EQ(map.relation({ 2, 0, 2.0f }, 0.1f), meam::DepthMap::Relation::Hidden);
  EXPECT_EQ(map.relation({ 2, 0, -9.0f }, 0.1f), meam::DepthMap::Relation::Hidden);
}

TEST(DepthMap, TellsHowFarInsideItsCellAPointLies)
{
  const meam::DepthMap map({ { 0, 0, 0 }, { 2, 2, 0 } }, fromAbove(), 1.0); // in the middle of cells
  float inside = -1.0f;
  ASSERT_TRUE(meanAt(map, { 0.0f, 0.0f, 3.0f }, &inside));
  EXPECT_NEAR(inside, 1.0f, 1e-5f);
  meanAt(map, { -0.25f, 0.0f, 3.0f }, &inside);
  EXPECT_NEAR(inside, 0.75f, 1e-5f);
  meanAt(map, { -0.25f, 0.25f, 3.0f }, &inside);
  EXPECT_NEAR(inside, 0.5625f, 1e-5f);
  meanAt(map, { -0.4999f, 0.0f, 3.0f }, &inside);
  EXPECT_NEAR(inside, 0.0f, 1e-3f);
}

TEST(DepthMap, APointThatComesOverABorderComesSlowly)
{
  // Cells of 1 mm with their middles at whole numbers; the weight is asked for in the middle.
  float inside;
  const auto insideOf = [&](float x)
  {
    const meam::DepthMap map({ { 0, 0, 0 }, { x, 0, 6 }, { 9, 0, 0 } }, fromAbove(), 1.0);
    meanAt(map, { std::round(x), 0, 3 }, &inside);
    return inside;
  };
  EXPECT_FLOAT_EQ(insideOf(4.0f), 1.0f);
  EXPECT_NEAR(insideOf(4.425f), 0.5f, 1e-5f) << "half way across the strip next to the border";
  EXPECT_NEAR(insideOf(4.4999f), 0.0f, 1e-3f);
  const auto meanOfTwo = [&](float x)
  {
    const meam::DepthMap map({ { 0, 0, 0 }, { 4, 0, 0 }, { x, 0, 1 } }, fromAbove(), 1.0);
    return meanAt(map, { 4, 0, 0 }, &inside)->z();
  };
  EXPECT_NEAR(meanOfTwo(4.2f), 0.5f, 1e-5f);
  EXPECT_NEAR(meanOfTwo(4.425f), 1.0f / 3.0f, 1e-5f);
  EXPECT_NEAR(meanOfTwo(4.4999f), 0.0f, 1e-3f);
  EXPECT_FLOAT_EQ(inside, 1.0f);
}

TEST(DepthMap, FollowsLinesOfSightOfAPerspectiveSensor)
{
  meam::Sensor sensor; // at the origin, looking along z
  const meam::DepthMap map(parts::lattice({ -100, -100 }, { 100, 100 }, 5.0f, 500.0f), sensor, 8.0);
  EXPECT_EQ(map.relation({ 40, 0, 250 }, 5.0f), meam::DepthMap::Relation::InFront) << "80 on the wall";
  EXPECT_EQ(map.relation({ 70, 0, 250 }, 5.0f), meam::DepthMap::Relation::NoSurface) << "140: beside it";
  EXPECT_EQ(map.relation({ 90, 0, 503 }, 5.0f), meam::DepthMap::Relation::OnSurface);
  EXPECT_EQ(map.relation({ 90, 0, -503 }, 5.0f), meam::DepthMap::Relation::NoSurface) << "behind the sensor";
}

TEST(DepthMap, TheLastRowOfARegularScanIsSeen)
{
  std::mt19937 random(8);
  std::uniform_real_distribution<float> side(0.1f, 3.0f), shift(-300.0f, 300.0f);
  for (int run = 0; run < 500; ++run)
  {
    const float cell = side(random), from = shift(random);
    const auto points = meam::ofIndices<Eigen::Vector3f>(2 + run % 40,
      [&](int k)
      {
        return Eigen::Vector3f{ from + 0.5f * cell * k, from, 0 };
      }); // two of each cell, so that the last may lie on a border
    const meam::DepthMap map(points, fromAbove(), cell);
    EXPECT_EQ(map.relation(points.front(), 0.1f), meam::DepthMap::Relation::OnSurface) << run;
    EXPECT_EQ(map.relation(points.back(), 0.1f), meam::DepthMap::Relation::OnSurface) << run;
  }
}

TEST(DepthMap, OfNothingTellsNothing)
{
  const meam::DepthMap map({}, fromAbove(), 1.0);
  EXPECT_EQ(map.relation({ 0, 0, 0 }, 1.0f), meam::DepthMap::Relation::NoSurface);
  EXPECT_FALSE(meanAt(map, { 0, 0, 0 }));
  EXPECT_TRUE(map.normalAt({ 0, 0, 0 }).isZero());
}

TEST(DepthMap, TheSameForAnyNumberOfThreads)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<float> across(-50.0f, 50.0f), height(0.0f, 20.0f);
  const auto points = meam::ofIndices<Eigen::Vector3f>(
    5000, [&](int k) { return Eigen::Vector3f(across(random), across(random), k % 50 == 0 ? NAN : height(random)); });
  const meam::DepthMap one(points, fromAbove(), 2.0, 1);
  const meam::DepthMap three(points, fromAbove(), 2.0, 3);
  EXPECT_EQ(one.means(), three.means());
  for (int k = 0; k < 1000; ++k)
  {
    const Eigen::Vector3f asked(across(random), across(random), height(random));
    float ofOne, ofThree;
    EXPECT_EQ(one.relation(asked, 1.0f), three.relation(asked, 1.0f));
    EXPECT_EQ(one.normalAt(asked), three.normalAt(asked));
    EXPECT_EQ(meanAt(one, asked, &ofOne), meanAt(three, asked, &ofThree));
    EXPECT_EQ(ofOne, ofThree);
  }
  const meam::DepthMap small({ { 0, 0, 3 }, { 1, 0, 5 } }, fromAbove(), 1.0, 1000);
  EXPECT_EQ(small.means(), meam::Points({ { 0, 0, 3 }, { 1, 0, 5 } })) << "more threads than cells";
}

TEST(DepthMap, ManyAtOnceAsOneByOne)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (const bool isPerspective : { false, true })
  {
    meam::Sensor sensor = fromAbove();
    sensor.perspective = isPerspective;
    sensor.position = { 10, 10, 60 };
    const meam::DepthMap map(step(), sensor, 1.5);
    Eigen::Isometry3f toScene(Eigen::Translation3f(-4, 3, 2));
    toScene.rotate(Eigen::AngleAxisf(0.4f, Eigen::Vector3f(1, 2, -2) / 3.0f));
    meam::SoAPoints points, inScene;
    for (int k = 0; k < 600; ++k)
    {
      points.add({ 40.0f * unit(random) - 10.0f, 40.0f * unit(random) - 10.0f, 20.0f * unit(random) - 8.0f });
    }
    points.add({ 1e30f, 0, 0 });
    points.add(Eigen::Vector3f::Constant(NAN));
    points.add({ 10, 10, 90 }); // behind the sensor
    std::map<meam::DepthMap::Relation, int> counts;
    std::vector<meam::DepthMap::Relation> relations(points.size());
    map.relations(toScene, points, 0, 400, 1.5f, relations.data());
    map.relations(toScene, points, 400, static_cast<int>(points.size()) - 400, 1.5f, relations.data() + 400);
    int different = 0; // where rounding decides between cells
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      inScene.add(toScene * points[k]);
      different += relations[k] != map.relation(inScene[k], 1.5f);
      ++counts[relations[k]];
    }
    EXPECT_LE(different, 3);
    EXPECT_EQ(relations[600], meam::DepthMap::Relation::NoSurface);
    EXPECT_EQ(relations[601], meam::DepthMap::Relation::NoSurface);
    for (const auto& [relation, count] : counts)
    {
      EXPECT_GT(count, 20);
    }
    EXPECT_EQ(counts.size(), 4u);

    meam::DepthMap::Seen seen;
    int found = 0;
    for (int begin = 0; begin < 603; begin += 201)
    {
      map.meansAt(inScene, begin, 201, seen);
      for (int k = 0; k < 201; ++k)
      {
        const bool isSeen = map.relation(inScene[begin + k], 0.0f) != meam::DepthMap::Relation::NoSurface;
        float inside;
        const std::optional<Eigen::Vector3f> alone = meanAt(map, inScene[begin + k], &inside);
        EXPECT_EQ(alone.has_value(), isSeen) << begin + k;
        EXPECT_EQ(seen.inside[k], inside);
        if (alone)
        {
          EXPECT_EQ(Eigen::Vector3f(seen.x[k], seen.y[k], seen.z[k]), *alone);
          ++found;
        }
      }
    }
    EXPECT_GT(found, 100);
  }
  meam::SoAPoints origin;
  origin.add(Eigen::Vector3f::Zero());
  meam::DepthMap::Relation relation;
  meam::DepthMap({}, fromAbove(), 1.0).relations(Eigen::Isometry3f::Identity(), origin, 0, 1, 1.0f, &relation);
  EXPECT_EQ(relation, meam::DepthMap::Relation::NoSurface) << "nothing was seen at all";
}
