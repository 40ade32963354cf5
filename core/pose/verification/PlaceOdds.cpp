// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PlaceOdds.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace meam
{
namespace
{
// By logistic regression over all poses that came out of the Tohoku dataset (scenes 0 to 9, without noise and with 0.5
// and 1 % of the diameter), of bins of nine parts and three sensors with the part in them or another, of bins with
// images that show next to nothing, and of six scans of pipes.
// testing/evaluation/calibration.py tells how they hold for other scenes.
constexpr double MuchFor = 4.0; // log odds: more that speaks for a pose grows by its logarithm, for all is of one pose
constexpr double OfNothing = -8.7;
constexpr double OfSurface = 0.68;      // of a patch where it should be
constexpr double OfTurned = -0.17;      // of one where it should be, that faces elsewhere
constexpr double OfPast = -1.8;         // of one that the sensor looked past, at something near behind it,
constexpr double OfFarPast = -9.5;      // and at something far behind it
constexpr double OfHidden = -0.73;      // of one with something before it: beyond so many patches
constexpr double HiddenBeyond = 5.0;    // by its logarithm, for one thing hides many
constexpr double OfUnmeasured = -0.35;  // of one where nothing was measured
constexpr double OfEnclosed = -5.7;     // of one of the body behind the bin's floor or a wall, seen or not
constexpr double OfOutlineShare = 16.3; // of all of the outline, that the measured surface ends there,
constexpr double HalfEnds = 0.5;        // which says nothing where so much of it ends,
constexpr double FewSides = 4.0;        // and little where it is shorter (sides of patches)
// Times the share of a part's edge points that find an edge in this scan, for where few are found they tell little:
constexpr double OfEdgeShare = 42.4; // of all edge points, that they find an edge,
constexpr double MiddleShare = 0.45; // which says nothing at so much of that share,
constexpr double FoundOfFew = 0.6;   // towards which few points are taken,
constexpr double FewEdges = 6.0;     // as if so many more were seen;
constexpr double OfEdgeCount = 2.4;  // of the logarithm of how many there are,
constexpr double UsualCount = 200.0; // in so many
// Edges alone
constexpr double OfEdgesAlone = 0.37;
constexpr double OfEdgesBeside = 0.87; // of what edges say beside the surface

double ofEdges(const EvidenceCounts& counts, double rate)
{
  const double points = counts.edgesFound + counts.edgesMissing;
  const double share = (counts.edgesFound + FewEdges * FoundOfFew * rate) / (points + FewEdges);
  return rate * (OfEdgeShare * (share - MiddleShare * rate) + OfEdgeCount * std::log((points + 1.0) / UsualCount));
}

double ofOutline(const EvidenceCounts& counts)
{
  return OfOutlineShare * (counts.ends - HalfEnds * (counts.ends + counts.goesOn)) /
         (counts.ends + counts.goesOn + FewSides);
}
}

double PlaceOdds::sum() const
{
  const double sum = std::accumulate(this->terms.begin(), this->terms.end(), this->before,
    [](double all, const EvidenceTerm& term) { return all + term.adds; });
  return sum > 0.0 ? logSaturated(sum, MuchFor) : sum;
}

PlaceOdds placeOdds(const EvidenceCounts& counts, const EvidenceRates& rates, bool haveSurfaces)
{
  const auto edges = [&](double adds) { return EvidenceTerm{ "edges", "points found", counts.edgesFound, adds }; };
  if (!haveSurfaces)
  {
    return { OfEdgesAlone, { edges(OfEdgesBeside * ofEdges(counts, EvidenceRates().edges.found)) } };
  }
  const double there = counts.there + counts.unclear;
  std::vector<EvidenceTerm> terms{ { "surface where it should be", "patches", there, OfSurface * there },
    { "surface that faces elsewhere", "patches", counts.turned, OfTurned * counts.turned },
    { "surface that the sensor saw just past", "patches", counts.past, OfPast * counts.past },
    { "surface that the sensor saw far past", "patches", counts.farPast, OfFarPast * counts.farPast },
    { "surface that is hidden", "patches", counts.hidden, OfHidden * logSaturated(counts.hidden, HiddenBeyond) },
    { "body behind the bin's floor or a wall", "patches", counts.enclosed, OfEnclosed * counts.enclosed },
    { "surface that was not measured", "patches", counts.unmeasured, OfUnmeasured * counts.unmeasured },
    edges(ofEdges(counts, rates.edges.found)),
    { "outline", "patches long where surface ends", counts.ends, ofOutline(counts) } };
  terms.erase(
    std::remove_if(terms.begin(), terms.end(), [](const EvidenceTerm& term) { return term.adds == 0.0; }), terms.end());
  return { OfNothing, std::move(terms) };
}
}
