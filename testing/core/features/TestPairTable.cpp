// SPDX-License-Identifier: BSD-3-Clause
#include "features/PairTable.h"

#include <gtest/gtest.h>

using Entries = std::vector<std::uint32_t>;

TEST(PairTable, EntriesOfAKeyAreTogetherInTheirOrder)
{
  const meam::PairTable table =
    meam::makePairTable({ { 2, 0, 1, 0.1f, 1 }, { 0, 0, 2, 0.2f, 2 }, { 2, 1, 0, 0.3f, 3 }, { 2, 1, 2, 0.4f, 4 } }, 4);
  EXPECT_EQ(table.offsets, (Entries{ 0, 1, 1, 4, 4 }));
  EXPECT_EQ(table.references, (Entries{ 0, 0, 1, 1 }));
  EXPECT_EQ(table.referreds, (Entries{ 2, 1, 0, 2 }));
  EXPECT_EQ(table.viewBits, (Entries{ 2, 1, 3, 4 }));
  EXPECT_EQ(table.angles, (std::vector<float>{ 0.2f, 0.1f, 0.3f, 0.4f }));
  EXPECT_EQ(table.bytes(), 4u * (5 + 4 * 4));
}

TEST(PairTable, ATangentHasTwoSensesANormalOne)
{
  const meam::Points points = { { 0, 0, 0 }, { 10, 0, 0 }, { -10, 0, 0 } };
  const meam::Points directions(3, Eigen::Vector3f(1, 0, 0));
  meam::PairTable table = meam::makePairTable({ { 0, 0, 1, 0.0f, 1 }, { 0, 0, 2, 0.0f, 1 } }, 1);
  const auto against = [&](int k) { return (table.votes[k] & meam::SheetMask) % 2 == 1; };
  table.deriveVotes(points, directions, meam::PairFeatureKind::Oriented);
  EXPECT_FALSE(against(0));
  EXPECT_TRUE(against(1)) << "d runs against the reference's tangent";
  table.deriveVotes(points, directions, meam::PairFeatureKind::Surface);
  EXPECT_FALSE(against(0));
  EXPECT_FALSE(against(1));
  EXPECT_EQ(table.mostOfOne, 2);
  EXPECT_EQ(table.votingPoints, 3);
  EXPECT_EQ(table.votes.size(), 2u + meam::VoteBlock);
}
