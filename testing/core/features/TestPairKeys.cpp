// SPDX-License-Identifier: BSD-3-Clause
#include "features/PairKeys.h"

#include "TestParts.h"

#include <algorithm>
#include <numeric>

TEST(PairKeys, AnglesOfCosines)
{
  for (int i = 0; i <= 1000; ++i)
  {
    const float cosine = i / 1000.0f;
    EXPECT_NEAR(meam::acuteAngle(cosine), std::acos(cosine), 1e-6);
    EXPECT_NEAR(meam::fullAngle(-cosine), std::acos(-cosine), 1e-6);
  }
  EXPECT_EQ(meam::acuteAngle(1.0f), 0.0f);
}

TEST(PairKeys, AreThoseOfTheFeatures)
{
  const meam::PointCloud points = parts::scatteredEdges(501, 60.0); // no multiple of any vector's width
  for (const auto kind :
    { meam::PairFeatureKind::Paper, meam::PairFeatureKind::Oriented, meam::PairFeatureKind::Surface })
  {
    const meam::PairFeatureQuantizer quantizer(kind, 7.0, 7.2 * M_PI / 180.0, 100.0);
    const meam::PairKeys pairs(points.points, points.tangents, quantizer);
    std::vector<int> blocks(32);
    std::iota(blocks.begin(), blocks.end(), 0);
    std::vector<int> keys(512);
    std::vector<meam::PairTurn> turns(512);
    int differ = 0;
    int tooLong = 0;
    for (int r = 0; r < 100; ++r)
    {
      const meam::PairFrame frame(points.points[r], points.tangents[r]);
      pairs.compute(frame, blocks.data(), 32, keys.data(), turns.data());
      for (int i = 0; i < static_cast<int>(points.size()); ++i)
      {
        if (i == r)
        {
          EXPECT_EQ(keys[i], -1) << "a pair without length";
          continue;
        }
        const int key = quantizer.key(
          meam::pairFeature(kind, points.points[r], points.tangents[r], points.points[i], points.tangents[i]));
        differ += key == keys[i] ? 0 : 1; // rounding may carry a feature over the border of its bin
        tooLong += key < 0 ? 1 : 0;
        EXPECT_EQ((turns[i] >> meam::TurnBits) == 1, meam::isOfLines(kind) && frame.against(points.points[i]));
        const double exact = frame.angleOf(points.points[i]) * (1 << meam::TurnBits) / (2.0 * M_PI);
        const int apart = static_cast<int>((turns[i] - std::lround(exact) + 1) & meam::TurnMask);
        EXPECT_LE(apart, 2) << "a turn of " << exact;
      }
      EXPECT_EQ(std::count(keys.begin() + 501, keys.end(), -1), 11) << "what fills the last block is no point";
    }
    EXPECT_LT(differ, 5);
    EXPECT_GT(tooLong, 100);
  }
}

TEST(PairKeys, BlocksAreComputedInAnyOrder)
{
  const meam::PointCloud points = parts::scatteredEdges(97, 60.0);
  const meam::PairFeatureQuantizer quantizer(meam::PairFeatureKind::Oriented, 7.0, 0.1, 200.0);
  const meam::PairKeys pairs(points.points, points.tangents, quantizer);
  const meam::PairFrame frame(points.points[5], points.tangents[5]);
  constexpr int size = meam::BlockedPoints::Size;
  const int all[] = { 0, 1, 2, 3, 4, 5, 6 };
  const int some[] = { 6, 2, 3 };
  std::vector<int> keys(7 * size), someKeys(3 * size);
  std::vector<meam::PairTurn> turns(7 * size), someTurns(3 * size);
  pairs.compute(frame, all, 7, keys.data(), turns.data());
  pairs.compute(frame, some, 3, someKeys.data(), someTurns.data());
  for (int k = 0; k < 3 * size; ++k)
  {
    EXPECT_EQ(someKeys[k], keys[some[k / size] * size + k % size]);
    EXPECT_EQ(someTurns[k], turns[some[k / size] * size + k % size]);
  }
}
