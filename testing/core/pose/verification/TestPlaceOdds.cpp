// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PlaceOdds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace
{
using meam::EvidenceCounts;

meam::EvidenceRates ratesWith(double found)
{
  meam::EvidenceRates rates;
  rates.edges.found = found;
  return rates;
}

double ofSurface(double EvidenceCounts::*count, double patches)
{
  EvidenceCounts counts;
  const double nothing = meam::placeOdds(counts, {}, true).sum();
  counts.*count = patches;
  return meam::placeOdds(counts, {}, true).sum() - nothing;
}

/// What the term of edges adds to one of `points`, of which this share is found.
double ofEdges(double share, double points, double found)
{
  EvidenceCounts counts;
  counts.edgesFound = share * points;
  counts.edgesMissing = (1.0 - share) * points;
  for (const meam::EvidenceTerm& term : meam::placeOdds(counts, ratesWith(found), true).terms)
  {
    if (std::string(term.what) == "edges")
    {
      return term.adds;
    }
  }
  return 0.0;
}
}

TEST(PlaceOdds, SurfaceCountsByItsArea)
{
  EXPECT_NEAR(ofSurface(&EvidenceCounts::there, 10.0), 6.8, 1e-9);
  EXPECT_NEAR(ofSurface(&EvidenceCounts::unclear, 10.0), 6.8, 1e-9);
  EXPECT_NEAR(ofSurface(&EvidenceCounts::past, 2.0), -3.6, 1e-9);
  EXPECT_LT(ofSurface(&EvidenceCounts::farPast, 1.0), ofSurface(&EvidenceCounts::past, 1.0));
  for (const auto against : { &EvidenceCounts::turned, &EvidenceCounts::unmeasured, &EvidenceCounts::enclosed })
  {
    EXPECT_LT(ofSurface(against, 1.0), 0.0);
  }
  EXPECT_GT(ofSurface(&EvidenceCounts::hidden, 400.0), 20.0 * ofSurface(&EvidenceCounts::hidden, 4.0));
}

TEST(PlaceOdds, EdgesAndOutlinesCountByTheirShare)
{
  // Ten times as many points beside each other tell the same, but for the logarithm of how many there are.
  const double few = ofEdges(0.7, 2e5, 0.6), many = ofEdges(0.7, 2e6, 0.6);
  EXPECT_NEAR(many - few, 0.6 * 2.4 * std::log(10.0), 1e-3);
  EXPECT_NEAR(few, 0.6 * (42.4 * (0.7 - 0.45 * 0.6) + 2.4 * std::log(1000.0)), 1e-2);
  EXPECT_GT(ofEdges(0.6, 300.0, 0.6), 0.0);
  EXPECT_LT(ofEdges(0.1, 300.0, 0.6), 0.0);
  // What half of the edges found say where all are found of other copies, and where half are.
  EXPECT_LT(ofEdges(0.3, 300.0, 0.9), 0.0);
  EXPECT_GT(ofEdges(0.3, 300.0, 0.3), 0.0);
  EXPECT_LT(std::abs(ofEdges(0.0, 200.0, 0.1)), 1.0) << "where hardly any are found they tell little";

  EvidenceCounts counts;
  const double nothing = meam::placeOdds(counts, {}, true).sum();
  counts.ends = counts.goesOn = 20.0;
  EXPECT_NEAR(meam::placeOdds(counts, {}, true).sum(), nothing, 1e-9);
  counts.goesOn = 0.0;
  EXPECT_NEAR(meam::placeOdds(counts, {}, true).sum() - nothing, 16.3 * 10.0 / 24.0, 1e-9);
}

TEST(PlaceOdds, TermsSumUpAndWhatAddsNothingIsNone)
{
  EvidenceCounts counts;
  counts.there = counts.turned = counts.past = counts.farPast = counts.hidden = counts.enclosed = counts.unmeasured =
    0.7;
  counts.ends = 5.0;
  counts.edgesFound = 30.0;
  const meam::PlaceOdds odds = meam::placeOdds(counts, {}, true);
  double sum = odds.before;
  for (const meam::EvidenceTerm& term : odds.terms)
  {
    sum += term.adds;
  }
  EXPECT_EQ(odds.terms.size(), 9u);
  EXPECT_LT(sum, 0.0);
  EXPECT_DOUBLE_EQ(odds.sum(), sum);
  EXPECT_NEAR((meam::PlaceOdds{ -2.0, { { "surface", "patches", 1.0, 14.0 } } }).sum(), 4.0 * std::log(4.0), 1e-9)
    << "much that speaks for it";
  EXPECT_LT(odds.before, 0.0);
  EXPECT_EQ(meam::placeOdds({}, {}, true).terms.size(), 1u) << "edges alone: none of those that were expected";
}

TEST(PlaceOdds, WithoutSurfacesEdgesAreAllAndCountByTheUsualRate)
{
  EvidenceCounts counts;
  counts.edgesFound = 200.0;
  counts.edgesMissing = 100.0;
  const meam::PlaceOdds odds = meam::placeOdds(counts, ratesWith(0.3), false);
  EXPECT_EQ(odds.terms.size(), 1u);
  EXPECT_DOUBLE_EQ(odds.sum(), meam::placeOdds(counts, {}, false).sum());
  EXPECT_GT(odds.sum(), 2.0);
  counts.there = 100.0;
  EXPECT_DOUBLE_EQ(odds.sum(), meam::placeOdds(counts, {}, false).sum());
  counts.edgesFound = 30.0;
  counts.edgesMissing = 270.0;
  EXPECT_LT(meam::placeOdds(counts, {}, false).sum(), 0.0);
}
