// SPDX-License-Identifier: BSD-3-Clause
#include "pose/ScanAdvice.h"

#include "base/Error.h"
#include "pose/objective/FloorContact.h"
#include "pose/refinement/PartSize.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace meam
{
namespace
{
// From where on parts are lost (docs/evaluation.md, resolution and noise).
constexpr double FewestPixels = 90.0; // along the part: with half of that one of three is not found
constexpr double MostNoise = 0.01;    // of the diameter: up to that recall stays above 95 %
constexpr double TrustedEdges = 1.5;  // times more of a part's edges are found than anywhere, or they tell little
constexpr double FewestEdges = 0.3;   // of a part's: as many as chance finds in a scan full of edges
constexpr double LeastCoverage = 0.6; // of the grid: bins of matt parts have more
constexpr double LikelyThere = 0.5;
constexpr double SureRotation = 0.9;
constexpr std::size_t MostSentences = 2;

bool isThere(const Pose& pose) { return claimOf(pose, false) >= LikelyThere; }

std::string percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }
}

std::string adviceOnNothing(const WorkCounts& work)
{
  const std::string first = "look first at the scan's unit, which has to be the part's (mm), at the region, and at the "
                            "image, without which edges are those of the depth.";
  if (work.references == 0)
  {
    return "The scan shows no edges as far apart as the part's: " + first;
  }
  const std::string of = std::to_string(work.screened) + " candidates";
  return work.screened == 0   ? "Voting found no candidate: " + first
         : work.verified == 0 ? "Screening left none of " + of + ", for there is no surface of the part there: " + first
         : work.refined == 0
           ? "Verification left none of " + of + ": " + first
           : "Selection left none of " + std::to_string(work.selected) + " refined poses: lower MinimumProbability.";
}

std::string scanAdvice(const ScanQuality& quality, const DetectionReport& report, const Poses& poses,
  double partDiameter, bool isViewpointGuessed)
{
  std::vector<std::string> sentences;
  const auto there = std::count_if(poses.begin(), poses.end(), isThere);
  if (isViewpointGuessed && there == 0)
  {
    sentences.push_back("Where the sensor stood was guessed: give the scan's viewpoint.");
  }
  if (!poses.empty() && poses.front().contradictions.mirrored > LikelyThere)
  {
    sentences.push_back("The part's mirror image fits better: look for the other hand's part, or turn the scan's axes "
                        "if they are left-handed.");
  }
  else if (!poses.empty() && poses.front().contradictions.resized > LikelyThere)
  {
    sentences.push_back("The parts in the scan are " + sizeWords(poses.front().contradictions.lengths) +
                        ": another part lies there, or the CAD file is of another version.");
  }
  else if (!poses.empty() && poses.front().contradictions.surplus > poses.front().contradictions.missing)
  {
    sentences.push_back(
      "On most copies in the scan there is surface that the part does not have: another part lies there, "
      "or the CAD file is of another version.");
  }
  else if (!poses.empty() && poses.front().contradictions.missing > 0)
  {
    sentences.push_back(
      "Some surface of the part is missing on most copies in the scan: another part lies there, or the "
      "CAD file is of another version.");
  }
  else if (!poses.empty() && poses.front().contradictions.thickness != 1.0)
  {
    sentences.push_back(thicknessWords(poses.front().contradictions.thickness));
  }
  if (quality.isKnown())
  {
    const double pixels = partDiameter / quality.pointDistance;
    if (pixels < FewestPixels)
    {
      sentences.push_back(
        "The part is " + std::to_string(std::lround(pixels)) +
        " pixels long in the scan: below 100 parts are missed; scan from nearer, or with more pixels." +
        (there == 0 ? " If it should be longer, the scan or the CAD file has another unit." : ""));
    }
    if (quality.coverage < LeastCoverage && !quality.isCutOut() && !isViewpointGuessed)
    {
      sentences.push_back(
        "Only " + percent(quality.coverage) + " of the scan's pixels have depth: expose longer, or scan twice.");
    }
    if (quality.noise > MostNoise * partDiameter)
    {
      sentences.push_back("The depth's noise is " + percent(quality.noise / partDiameter) +
                          " of the part's length: average several scans.");
    }
  }
  if (report.rates)
  {
    const EvidenceRate& edges = report.rates->edges;
    if (edges.found < FewestEdges || edges.found < TrustedEdges * edges.chance)
    {
      sentences.push_back("Of a part's edges " + percent(edges.found) + " are found, anywhere " +
                          percent(edges.chance) + ": they tell little; light the parts from another side.");
    }
  }
  const auto isTurnable = [&](const Pose& pose) { return isThere(pose) && pose.certainty < SureRotation; };
  const auto turnable = std::count_if(poses.begin(), poses.end(), isTurnable);
  if (2 * turnable > there)
  {
    sentences.push_back("The rotation of " + std::to_string(turnable) + " of " + std::to_string(there) +
                        " parts is unsure: what tells it does not show; RotationCounts keeps these back.");
  }
  if (poses.empty() && !report.isCutShort)
  {
    sentences.push_back(adviceOnNothing(report.work));
  }
  if (report.maximumPoses > 0 && there == report.maximumPoses)
  {
    sentences.push_back(
      "No more than " + std::to_string(there) + " were asked for: there may be more (MaximumNumberOfPoses, 0: all).");
  }
  sentences.resize(std::min(sentences.size(), MostSentences));
  std::string advice;
  for (const std::string& sentence : sentences)
  {
    appendSentence(advice, sentence);
  }
  return advice;
}

std::string scanSummary(
  const ScanQuality& quality, const DetectionReport& report, const Poses& poses, double partDiameter)
{
  std::string summary;
  if (quality.isKnown())
  {
    char noise[16];
    std::snprintf(noise, sizeof noise, "%.1f", 100.0 * quality.noise / partDiameter);
    summary = "The part is " + std::to_string(std::lround(partDiameter / quality.pointDistance)) +
              " pixels long, the noise " + noise + " % of that.";
  }
  if (report.rates)
  {
    appendSentence(summary, percent(report.rates->edges.found) + " of its edges are found, " +
                              percent(report.rates->edges.chance) + " anywhere.");
  }
  const auto there = std::count_if(poses.begin(), poses.end(), isThere);
  const WorkCounts& work = report.work;
  appendSentence(summary, "Of " + std::to_string(work.screened) + " candidates " + std::to_string(work.verified) +
                            " had surface, " + std::to_string(work.refined) + " were refined; " +
                            std::to_string(there) + " of " + std::to_string(poses.size()) + " poses are likely.");
  return summary;
}
}
