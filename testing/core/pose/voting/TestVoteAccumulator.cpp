// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/VoteAccumulator.h"

#include "base/sequences/Sequences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace
{
constexpr double Step = 7.2 * M_PI / 180.0; // 50 bins

std::uint32_t turnOf(double degrees)
{
  return static_cast<std::uint32_t>(std::lround(degrees / 360.0 * (1 << meam::TurnBits))) & meam::TurnMask;
}

std::uint32_t entry(std::uint32_t modelPoint, bool against, double degrees)
{
  return meam::voteEntry(modelPoint, against, turnOf(degrees));
}

meam::PairTurn sceneTurn(bool against, double degrees)
{
  return ((against ? 1u : 0u) << meam::TurnBits) | turnOf(degrees);
}

void vote(meam::VoteAccumulator& votes, std::uint32_t one, meam::PairTurn scene, int times = 1)
{
  const meam::VoteBucket bucket{ 0, 1, scene };
  const std::uint32_t entries[1 + meam::VoteBlock] = { one };
  for (int i = 0; i < times; ++i)
  {
    votes.vote(entries, &bucket, 1);
  }
}
}

TEST(VoteAccumulator, TheTurnIsTheDifferenceOrTheSum)
{
  meam::VoteAccumulator votes(3, Step);
  vote(votes, entry(2, false, 30.0), sceneTurn(false, 100.0)); // the same sense: 100 - 30
  meam::VotePeak peak = votes.peaks(1).at(0);
  EXPECT_EQ(peak.modelPoint, 2);
  EXPECT_EQ(peak.votes, 1);
  EXPECT_FALSE(peak.flip);
  EXPECT_NEAR(peak.alpha * 180.0 / M_PI, 70.0, 2.0 * 7.2);
  votes.clear();
  EXPECT_TRUE(votes.peaks(1).empty());
  vote(votes, entry(1, true, 30.0), sceneTurn(false, 100.0)); // against: 100 + 30
  peak = votes.peaks(1).at(0);
  EXPECT_EQ(peak.modelPoint, 1);
  EXPECT_TRUE(peak.flip);
  EXPECT_NEAR(peak.alpha * 180.0 / M_PI, 130.0, 2.0 * 7.2);
  votes.clear();
  vote(votes, entry(1, true, 30.0), sceneTurn(true, 100.0)); // both against: no flip
  EXPECT_FALSE(votes.peaks(1).at(0).flip);
}

TEST(VoteAccumulator, EverySenseHasItsExactBin)
{
  constexpr int fullTurn = 1 << meam::TurnBits;
  for (const int scene : { 0, 1, 655, 656, 5000, 16384, 32767 })
  {
    for (const int model : { 0, 1, 655, 656, 5000, 16384, 32767 })
    {
      for (const bool sceneAgainst : { false, true })
      {
        for (const bool modelAgainst : { false, true })
        {
          meam::VoteAccumulator votes(1, Step);
          const bool flip = sceneAgainst != modelAgainst;
          vote(votes, meam::voteEntry(0, modelAgainst, model), (sceneAgainst ? fullTurn : 0) | scene);
          const int alpha = (flip ? scene + model : scene - model + fullTurn) % fullTurn;
          const auto peaks = votes.peaks(3);
          ASSERT_EQ(peaks.size(), 1u);
          EXPECT_EQ(peaks[0].flip, flip);
          const double bins = peaks[0].alpha / Step + 50.0; // may come out below 0
          EXPECT_NEAR(std::fmod(bins, 50.0), alpha * 50 / fullTurn + 0.5, 1e-9) << scene << " " << model;
        }
      }
    }
  }
}

TEST(VoteAccumulator, TheLastOfTheMostModelPointsVotesToo)
{
  meam::VoteAccumulator votes(65536, M_PI_2);
  vote(votes, meam::voteEntry(65535, true, 0), sceneTurn(false, 100.0), 2);
  vote(votes, meam::voteEntry(65534, false, 0), sceneTurn(false, 100.0));
  const auto peaks = votes.peaks(9);
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_EQ(peaks[0].modelPoint, 65535);
  EXPECT_TRUE(peaks[0].flip);
  EXPECT_EQ(peaks[1].modelPoint, 65534);
}

TEST(VoteAccumulator, NeighbouringBinsAddUpAndPullThePeak)
{
  meam::VoteAccumulator votes(1, Step);
  vote(votes, entry(0, false, 0.0), sceneTurn(false, 3.6), 6);   // bin 0
  vote(votes, entry(0, false, 0.0), sceneTurn(false, 356.4), 2); // bin 49, its neighbour over the turn's end
  vote(votes, entry(0, false, 0.0), sceneTurn(false, 10.8), 4);  // bin 1
  const meam::VotePeak peak = votes.peaks(1).at(0);
  EXPECT_EQ(peak.votes, 12);
  EXPECT_NEAR(peak.alpha, (0.5 + (4.0 - 2.0) / 12.0) * Step, 1e-9);
}

TEST(VoteAccumulator, WithoutSmoothingABinStandsAlone)
{
  for (const bool smooth : { true, false })
  {
    meam::VoteAccumulator votes(1, Step, smooth);
    vote(votes, entry(0, false, 0.0), sceneTurn(false, 10.5 * 7.2), 3);
    vote(votes, entry(0, false, 0.0), sceneTurn(false, 30.5 * 7.2), 2);
    vote(votes, entry(0, false, 0.0), sceneTurn(false, 31.5 * 7.2), 2);
    const meam::VotePeak peak = votes.peaks(1).at(0);
    EXPECT_EQ(peak.votes, smooth ? 4 : 3);
    EXPECT_NEAR(peak.alpha / Step, smooth ? 31.0 : 10.5, 1e-9);
  }
}

TEST(VoteAccumulator, PeaksComeBestFirstAndOfDifferentPoints)
{
  meam::VoteAccumulator votes(4, Step);
  vote(votes, entry(3, false, 0.0), sceneTurn(false, 90.0), 5);
  vote(votes, entry(1, false, 0.0), sceneTurn(false, 20.0), 7);
  vote(votes, entry(1, false, 0.0), sceneTurn(false, 200.0), 6);
  vote(votes, entry(2, true, 0.0), sceneTurn(false, 90.0), 5);
  const auto peaks = votes.peaks(10);
  ASSERT_EQ(peaks.size(), 3u);
  EXPECT_EQ(peaks[0].modelPoint, 1);
  EXPECT_EQ(peaks[0].votes, 7);
  EXPECT_EQ(peaks[1].modelPoint, 2) << "of equals the first";
  EXPECT_EQ(peaks[2].modelPoint, 3);
  EXPECT_EQ(votes.peaks(2).size(), 2u) << "asking does not change the votes";
}

TEST(VoteAccumulator, VeryManyVotesDoNotWrap)
{
  meam::VoteAccumulator votes(2, Step);
  vote(votes, entry(1, false, 0.0), sceneTurn(false, 50.0), 200000);
  vote(votes, entry(0, false, 0.0), sceneTurn(false, 50.0), 100);
  EXPECT_EQ(votes.peaks(1).at(0).modelPoint, 1);
  EXPECT_EQ(votes.peaks(1).at(0).votes, 21845);
  vote(votes, entry(1, false, 0.0), sceneTurn(false, 42.0), 30000);
  vote(votes, entry(1, false, 0.0), sceneTurn(false, 57.0), 30000);
  EXPECT_EQ(votes.peaks(1).at(0).votes, 65535) << "three bins that are full";
}

TEST(VoteAccumulator, FlipsOfABucketAreCountedApart)
{
  // Two entries along, one against, of three model points; the scene pair runs against its tangent.
  const std::uint32_t entries[4 + meam::VoteBlock] = { entry(9, false, 0.0), entry(0, false, 30.0),
    entry(1, false, 30.0), entry(2, true, 30.0) };
  const meam::VoteBucket bucket{ 1, 4, sceneTurn(true, 100.0) };
  meam::VoteAccumulator votes(10, Step);
  votes.vote(entries, &bucket, 1);
  const auto peaks = votes.peaks(10);
  ASSERT_EQ(peaks.size(), 3u);
  EXPECT_TRUE(peaks[0].modelPoint == 0 && peaks[0].flip);
  EXPECT_TRUE(peaks[1].modelPoint == 1 && peaks[1].flip);
  EXPECT_TRUE(peaks[2].modelPoint == 2 && !peaks[2].flip);
  EXPECT_NEAR(peaks[0].alpha * 180.0 / M_PI, 130.0, 2.0 * 7.2);
  EXPECT_NEAR(peaks[2].alpha * 180.0 / M_PI, 70.0, 2.0 * 7.2);
}

TEST(VoteAccumulator, LongBucketsCountEveryEntry)
{
  auto entries = meam::ofIndices<std::uint32_t>(1000, [&](int k) { return entry(k % 7, false, 0.36 * k); });
  entries.resize(1000 + meam::VoteBlock);
  const meam::VoteBucket bucket{ 0, 1000, sceneTurn(false, 0.0) };
  meam::VoteAccumulator votes(7, Step);
  votes.vote(entries.data(), &bucket, 1, 1000);
  votes.vote(entries.data(), &bucket, 1, 100000); // from here on bins might run over
  int slow[7][50] = {};
  for (int k = 0; k < 1000; ++k)
  {
    const std::uint32_t turn = (0u - turnOf(0.36 * k)) & meam::TurnMask;
    slow[k % 7][(turn * 50) >> meam::TurnBits] += 2;
  }
  const auto peaks = votes.peaks(14);
  ASSERT_EQ(peaks.size(), 7u);
  for (const meam::VotePeak& peak : peaks)
  {
    int most = 0;
    for (int bin = 0; bin < 50; ++bin)
    {
      most = std::max(most,
        slow[peak.modelPoint][bin] + slow[peak.modelPoint][(bin + 1) % 50] + slow[peak.modelPoint][(bin + 49) % 50]);
    }
    EXPECT_EQ(peak.votes, most) << peak.modelPoint;
  }
}

TEST(VoteAccumulator, EveryPointAndFlipHasItsOwnPeak)
{
  // Many votes in the first and the last bin of each, which are neighbours of each other and of no other sheet's.
  constexpr int modelPoints = 41;
  meam::VoteAccumulator votes(modelPoints, Step);
  std::mt19937 random(1);
  std::vector<int> expected;
  for (int sheet = 0; sheet < 2 * modelPoints; ++sheet)
  {
    const std::uint32_t one = entry(sheet / 2, sheet % 2 == 1, 0.0);
    const int first = random() % 20, last = random() % 20, far = random() % 40;
    vote(votes, one, sceneTurn(false, 3.6), first);
    vote(votes, one, sceneTurn(false, 356.4), last);
    vote(votes, one, sceneTurn(false, 180.0), far);
    expected.push_back(std::max(first + last, far));
  }
  const auto peaks = votes.peaks(1000);
  ASSERT_EQ(peaks.size(), expected.size() - std::count(expected.begin(), expected.end(), 0));
  int before = 1000, sheetBefore = -1;
  for (const meam::VotePeak& peak : peaks)
  {
    const int sheet = 2 * peak.modelPoint + (peak.flip ? 1 : 0);
    EXPECT_EQ(peak.votes, expected.at(sheet)) << sheet;
    EXPECT_TRUE(peak.votes < before || (peak.votes == before && sheet > sheetBefore))
      << "best first, of equals the first";
    before = peak.votes;
    sheetBefore = sheet;
  }
}

TEST(VoteAccumulator, TellsTheVotesOfAnyTurn)
{
  for (const bool smooth : { true, false })
  {
    meam::VoteAccumulator votes(3, Step, smooth);
    vote(votes, entry(2, true, 0.0), sceneTurn(false, 3.6), 5);   // bin 0
    vote(votes, entry(2, true, 0.0), sceneTurn(false, 356.4), 2); // bin 49
    vote(votes, entry(2, true, 0.0), sceneTurn(false, 10.8), 4);  // bin 1
    for (const double turn : { 0.0, 2.0 * M_PI, -2.0 * M_PI })
    {
      EXPECT_EQ(votes.votesFor(2, true, turn + 0.5 * Step), smooth ? 11 : 5);
      EXPECT_EQ(votes.votesFor(2, true, turn - 0.5 * Step), smooth ? 7 : 2);
      EXPECT_EQ(votes.votesFor(2, true, turn + 2.5 * Step), smooth ? 4 : 0);
    }
    EXPECT_EQ(votes.votesFor(2, false, 0.5 * Step), 0);
    EXPECT_EQ(votes.votesFor(1, true, 0.5 * Step), 0);
    const meam::VotePeak peak = votes.peaks(1).at(0);
    EXPECT_EQ(votes.votesFor(peak.modelPoint, peak.flip, peak.alpha), peak.votes);
  }
}
