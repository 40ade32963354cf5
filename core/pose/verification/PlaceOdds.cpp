// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PlaceOdds.h"

#include "base/sequences/Sequences.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace meam
{
namespace
{
// By logistic regression over all poses that came out of the Tohoku dataset (scenes 0 to 8, without noise and with 0.5
// and 1 % of the diameter), of bins of nine parts and three sensors with the part in them or another, of flat parts of
// 1 to 2.5 % of their diameter, of bins with images that show next to nothing, and of six scans of pipes; and, with
// little weight, of bins of parts that look alike.
// testing/evaluation/calibration.py tells how they hold for other scenes.
constexpr double MuchFor = 4.0; // log odds: more that speaks for a pose grows by its logarithm, for all is of one pose
constexpr double OfNothing = -14.6; // without any of the following
// The more of a part is in sight, the more could contradict a pose. What agrees tells less than what is in sight, by a
// tenth of the log loss.
constexpr double OfSurface = 5.9; // of the logarithm of the patches in sight,
constexpr double OfTurned = -1.0; // of one that faces elsewhere,
constexpr double OfPast = -4.3;   // and of one that the sensor looked past
// Set, for these worlds have too little of both:
constexpr double OfUnmeasured = -0.35; // of a patch where nothing was measured,
constexpr double OfEnclosed = -3.0;    // and of one of the body behind the bin's floor or a wall, seen or not
// The surface of a sheet is like what it lies on:
constexpr double OfThin = -6.6;        // of one without thickness, nothing of a thick one
constexpr double OfOutlineShare = 6.2; // of all of the outline, that the measured surface ends there,
constexpr double HalfEnds = 0.5;       // which says nothing where so much of it ends,
constexpr double FewSides = 4.0;       // and little where it is shorter (sides of patches)
// Times the share of a part's edge points that find an edge in this scan, for where few are found they tell little:
constexpr double OfEdgeShare = 34.0; // of all edge points, that they find an edge,
constexpr double MiddleShare = 0.7;  // which says nothing at so much of that share,
constexpr double FoundOfFew = 0.6;   // towards which few points are taken,
constexpr double FewEdges = 6.0;     // as if so many more were seen
// Shares of edges tell all in a scan that shows so much of a part's, and nothing in one that shows so little: there a
// pose is as likely as it was searched by, which counts each point by itself.
constexpr double TellingRate = 0.5, UntellingRate = 0.3;

// Edges alone
constexpr double OfNoEdges = -9.0;    // without any of the following
constexpr double OfShareAlone = 27.7; // of all edge points, that they find an edge,
constexpr double FoundAlone = 0.45;   // few of them taken towards so much,
constexpr double OfEdgeCount = 1.57;  // and of the logarithm of how many there are,
constexpr double UsualCount = 200.0;  // in so many

/// Of the points that are not hidden, `few` of them taken as found.
double edgeShare(const EvidenceCounts& counts, double few)
{
  return (counts.edgesFound + FewEdges * few) / (counts.edgesFound + counts.edgesMissing + FewEdges);
}

double ofEdges(const EvidenceCounts& counts, double rate)
{
  const double share = edgeShare(counts, FoundOfFew * rate);
  return OfEdgeShare * rate * (share - MiddleShare * rate);
}

double ofOutline(const EvidenceCounts& counts)
{
  return OfOutlineShare * (counts.ends - HalfEnds * (counts.ends + counts.goesOn)) /
         (counts.ends + counts.goesOn + FewSides);
}

EvidenceTerm ofFoundEdges(const EvidenceCounts& counts, double adds)
{
  return { "edges", "points found", counts.edgesFound, adds };
}
}

double PlaceOdds::sum() const
{
  const double sum = std::accumulate(this->terms.begin(), this->terms.end(), this->before,
    [](double all, const EvidenceTerm& term) { return all + term.adds; });
  return (1.0 - this->shareOfSearch) * (sum > 0.0 ? logSaturated(sum, MuchFor) : sum) +
         this->shareOfSearch * this->searched;
}

PlaceOdds placeOdds(const EvidenceCounts& counts, const EvidenceRates& rates, double searched, double thickness)
{
  const double rate = rates.edges.found;
  const double past = counts.past + counts.farPast;
  const double measured = std::max(counts.inSight - counts.unmeasured, 0.0);
  std::vector<EvidenceTerm> terms{ { "visible surface", "patches", measured, OfSurface * std::log1p(measured) },
    { "surface that faces elsewhere", "patches", counts.turned, OfTurned * counts.turned },
    { "surface that the sensor saw past", "patches", past, OfPast * past },
    { "surface that was not measured", "patches", counts.unmeasured, OfUnmeasured * counts.unmeasured },
    { "body behind the bin's floor or a wall", "patches", counts.enclosed, OfEnclosed * counts.enclosed },
    { "thickness of a sheet", "% of its diameter", 100.0 * thickness,
      OfThin * std::max(1.0 - thickness / ThickSheet, 0.0) },
    ofFoundEdges(counts, ofEdges(counts, rate)),
    { "outline", "patches long where surface ends", counts.ends, ofOutline(counts) } };
  eraseIf(terms, [](const EvidenceTerm& term) { return term.adds == 0.0; });
  const double share = std::clamp((TellingRate - rate) / (TellingRate - UntellingRate), 0.0, 1.0);
  return { OfNothing, std::move(terms), searched, share };
}

PlaceOdds placeOddsOfEdges(const EvidenceCounts& counts)
{
  const double points = counts.edgesFound + counts.edgesMissing;
  return { OfNoEdges, { ofFoundEdges(counts, OfShareAlone * edgeShare(counts, FoundAlone) +
                                               OfEdgeCount * std::log((points + 1.0) / UsualCount)) } };
}
}
