// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/SphereTree.h"

#include "base/Random.h"
#include "base/sequences/Sequences.h"

#include <gtest/gtest.h>

#include <set>

TEST(SphereTree, findsAllNearPointsAndFewOthers)
{
  meam::Random random(1);
  const auto points = meam::ofIndices<Eigen::Vector3f>(
    1000, [&](int) { return Eigen::Vector3f(random.uniform(), random.uniform(), random.uniform()); });
  const meam::SphereTree tree(points);
  ASSERT_EQ(tree.points().size(), points.size());
  // Those under the plane z = 0.1.
  std::set<int> visited;
  tree.forEachNear([](const Eigen::Vector3f& centre, float radius) { return centre.z() - radius <= 0.1f; },
    [&](int index) { EXPECT_TRUE(visited.insert(index).second); });
  int under = 0;
  for (int i = 0; i < 1000; ++i)
  {
    const bool isUnder = tree.points()[i].z() <= 0.1f;
    under += isUnder;
    EXPECT_TRUE(!isUnder || visited.count(i));
  }
  EXPECT_GT(under, 50);
  EXPECT_LT(visited.size(), 500u);
}

TEST(SphereTree, withoutPoints)
{
  const meam::SphereTree tree{ meam::Points{} };
  tree.forEachNear([](const Eigen::Vector3f&, float) { return true; }, [](int) { FAIL(); });
}
