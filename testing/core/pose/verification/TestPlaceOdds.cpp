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

constexpr double Thick = 0.3; // diameters

double oddsOf(const EvidenceCounts& counts) { return meam::placeOdds(counts, {}, 0.0, Thick).sum(); }

/// What it adds.
double ofSurface(double EvidenceCounts::*count, double patches)
{
  EvidenceCounts counts;
  counts.*count = patches;
  return oddsOf(counts) - oddsOf({});
}

/// What the term of edges adds to one of `points`, of which this share is found.
double ofEdges(double share, double points, double found)
{
  EvidenceCounts counts;
  counts.edgesFound = share * points;
  counts.edgesMissing = (1.0 - share) * points;
  for (const meam::EvidenceTerm& term : meam::placeOdds(counts, ratesWith(found), 0.0, Thick).terms)
  {
    if (std::string(term.what) == "edges")
    {
      return term.adds;
    }
  }
  return 0.0;
}
}

TEST(PlaceOdds, SurfaceInSightCountsByItsLogarithmAndWhatContradictsByItsArea)
{
  EXPECT_NEAR(ofSurface(&EvidenceCounts::inSight, 9.0), 5.9 * std::log(10.0), 1e-9);
  EXPECT_NEAR(ofSurface(&EvidenceCounts::inSight, 1.0), 5.9 * std::log(2.0), 1e-9);
  EXPECT_NEAR(ofSurface(&EvidenceCounts::turned, 2.0), -2.0, 1e-9);
  EXPECT_NEAR(ofSurface(&EvidenceCounts::past, 2.0), -8.6, 1e-9);
  EXPECT_EQ(ofSurface(&EvidenceCounts::farPast, 2.0), ofSurface(&EvidenceCounts::past, 2.0));
  EXPECT_NEAR(ofSurface(&EvidenceCounts::enclosed, 1.0), -3.0, 1e-9);
  EXPECT_NEAR(ofSurface(&EvidenceCounts::unmeasured, 1.0), -0.35, 1e-9);
  EvidenceCounts unmeasured;
  unmeasured.inSight = unmeasured.unmeasured = 10.0;
  EXPECT_NEAR(oddsOf(unmeasured) - oddsOf({}), -3.5, 1e-9) << "what was not measured is no surface in sight";
  EXPECT_EQ(ofSurface(&EvidenceCounts::hidden, 10.0), 0.0) << "it says nothing";
  EvidenceCounts agreeing, seenPast;
  agreeing.inSight = seenPast.inSight = 10.0;
  seenPast.past = 5.0;
  EXPECT_LT(oddsOf(seenPast), oddsOf({})) << "half of it is not there";
  EXPECT_GT(oddsOf(agreeing), oddsOf({}) + 10.0);
}

TEST(PlaceOdds, SurfaceOfASheetIsLikeWhatItLiesOn)
{
  const auto of = [](double thickness) { return meam::placeOdds({}, {}, 0.0, thickness).sum(); };
  EXPECT_NEAR(of(Thick) - of(0.0), 6.6, 1e-9);
  EXPECT_NEAR(of(Thick) - of(0.03), 3.3, 1e-9);
  EXPECT_EQ(of(0.06), of(Thick));
}

TEST(PlaceOdds, EdgesAndOutlinesCountByTheirShare)
{
  EXPECT_NEAR(ofEdges(0.7, 2e5, 0.6), 34.0 * 0.6 * (0.7 - 0.7 * 0.6), 1e-2);
  EXPECT_NEAR(ofEdges(0.7, 2e6, 0.6), ofEdges(0.7, 2e5, 0.6), 1e-2) << "points beside each other tell the same";
  EXPECT_GT(ofEdges(0.6, 300.0, 0.6), 0.0);
  EXPECT_LT(ofEdges(0.1, 300.0, 0.6), 0.0);
  // What half of the edges found say where all are found of other copies, and where half are.
  EXPECT_LT(ofEdges(0.3, 300.0, 0.9), 0.0);
  EXPECT_GT(ofEdges(0.3, 300.0, 0.3), 0.0);
  EXPECT_LT(std::abs(ofEdges(0.0, 200.0, 0.1)), 1.0) << "where hardly any are found they tell little";

  EvidenceCounts counts;
  const double nothing = oddsOf(counts);
  counts.ends = counts.goesOn = 20.0;
  EXPECT_NEAR(oddsOf(counts), nothing, 1e-9);
  counts.goesOn = 0.0;
  EXPECT_NEAR(oddsOf(counts) - nothing, 6.2 * 10.0 / 24.0, 1e-9);
}

TEST(PlaceOdds, WhereFewEdgesAreFoundThatItWasSearchedForCounts)
{
  const auto of = [](double found, double searched)
  { return meam::placeOdds({}, ratesWith(found), searched, Thick).sum(); };
  EXPECT_EQ(of(0.6, 5.0), of(0.6, -5.0));
  EXPECT_NEAR(of(0.4, 5.0) - of(0.4, -5.0), 5.0, 1e-9) << "half of it";
  EXPECT_NEAR(of(0.3, -7.5), -7.5, 1e-9);
  EXPECT_NEAR(of(0.1, 3.5), 3.5, 1e-9);
}

TEST(PlaceOdds, TermsSumUpAndWhatAddsNothingIsNone)
{
  EvidenceCounts counts;
  counts.unmeasured = 0.1;
  counts.inSight = counts.turned = counts.past = counts.farPast = counts.enclosed = 0.7;
  counts.ends = 5.0;
  counts.edgesFound = 30.0;
  const meam::PlaceOdds odds = meam::placeOdds(counts, {}, 9.0, 0.03);
  double sum = odds.before;
  for (const meam::EvidenceTerm& term : odds.terms)
  {
    sum += term.adds;
  }
  EXPECT_EQ(odds.terms.size(), 8u);
  EXPECT_LT(sum, 0.0);
  EXPECT_DOUBLE_EQ(odds.sum(), sum);
  EXPECT_NEAR((meam::PlaceOdds{ -2.0, { { "surface", "patches", 1.0, 14.0 } } }).sum(), 4.0 * std::log(4.0), 1e-9)
    << "much that speaks for it";
  EXPECT_LT(odds.before, 0.0);
  EXPECT_EQ(meam::placeOdds({}, {}, 0.0, Thick).terms.size(), 1u) << "edges alone: none of those that were expected";
}

TEST(PlaceOdds, WithoutSurfacesEdgesAreAll)
{
  EvidenceCounts counts;
  counts.edgesFound = 200.0;
  counts.edgesMissing = 100.0;
  const meam::PlaceOdds odds = meam::placeOddsOfEdges(counts);
  EXPECT_EQ(odds.terms.size(), 1u);
  EXPECT_NEAR(odds.terms[0].adds, 27.7 * (200.0 + 6.0 * 0.45) / 306.0 + 1.57 * std::log(301.0 / 200.0), 1e-9);
  EXPECT_GT(odds.sum(), 2.0);
  counts.inSight = 100.0;
  EXPECT_DOUBLE_EQ(odds.sum(), meam::placeOddsOfEdges(counts).sum());
  counts.edgesFound = 30.0;
  counts.edgesMissing = 270.0;
  EXPECT_LT(meam::placeOddsOfEdges(counts).sum(), 0.0);
}
