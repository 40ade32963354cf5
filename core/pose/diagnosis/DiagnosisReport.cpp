// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/DiagnosisReport.h"

#include "pose/ScanAdvice.h"
#include "pose/objective/FloorContact.h"
#include "pose/refinement/PartSize.h"
#include "pose/search/Suppression.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace meam
{
namespace
{
constexpr double Likely = 0.9;      // of a rotation, or a place, that needs no word
constexpr double LeastLess = 1.0;   // log odds: more than places lose that nothing contradicts
constexpr double LeastTold = 0.1;   // of log odds, or patches: less changes nothing
constexpr double LeastShare = 0.01; // of the odds that a pose was searched for by: less is not told

std::string percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

/// With one decimal.
std::string decimal(double number)
{
  const long tenths = std::lround(10.0 * number);
  return (tenths < 0 ? "-" : "") + std::to_string(std::abs(tenths) / 10) + "." + std::to_string(std::abs(tenths) % 10);
}

std::string counted(int count, const std::string& one, const std::string& many)
{
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string offsetWords(const PoseOffset& offset)
{
  return decimal(offset.distance) + " mm and " + decimal(offset.angle) + " degrees";
}

/// What became of the points on the part in voting.
struct VoteCounts
{
  int points = 0;
  int references = 0;
  int electing = 0;      ///< reference points whose best peak leads to the place
  int otherElecting = 0; ///< points whose best peak does, but that are no reference points
  PointVotes best{ Eigen::Vector3f::Zero(), true, true, 0, 0, 0 }; ///< the reference point with most votes for it
};

VoteCounts countsOf(const std::vector<PointVotes>& votes)
{
  VoteCounts counts;
  for (const PointVotes& point : votes)
  {
    ++counts.points;
    counts.otherElecting += !point.isReference && point.rank == 1 ? 1 : 0;
    if (point.isReference)
    {
      ++counts.references;
      counts.electing += point.rank == 1 ? 1 : 0;
      counts.best = point.votes > counts.best.votes ? point : counts.best;
    }
  }
  return counts;
}

const StageCount* stageOf(const Diagnosis& diagnosis, PoseStage stage)
{
  const auto found = std::find_if(
    diagnosis.stages.begin(), diagnosis.stages.end(), [stage](const StageCount& one) { return one.stage == stage; });
  return found == diagnosis.stages.end() ? nullptr : &*found;
}

/// "its 3 candidates", of the stage before the one that lost it.
int candidatesBefore(const Diagnosis& diagnosis)
{
  int here = 0;
  for (const StageCount& stage : diagnosis.stages)
  {
    if (diagnosis.lostIn && stage.stage == *diagnosis.lostIn)
    {
      break;
    }
    here = stage.here;
  }
  return here;
}

std::string takerWords(const Diagnosis& diagnosis)
{
  return "pose " + std::to_string(diagnosis.takenBy) + ", which has " + percent(diagnosis.takenShare) +
         " of the points that match here";
}

bool isBeyondMaximum(const Diagnosis& diagnosis, const PoseSelectionSettings& selection)
{
  return selection.maximumPoses > 0 && diagnosis.rankWithoutLimits > selection.maximumPoses;
}

bool isUnlikely(const Diagnosis& diagnosis, const PoseSelectionSettings& selection)
{
  return diagnosis.probability < selection.minimumProbability;
}

/// The limits that keep a pose back.
std::string wantedWords(const Diagnosis& diagnosis, const PoseSelectionSettings& selection)
{
  return (isBeyondMaximum(diagnosis, selection) ? "the best " + std::to_string(selection.maximumPoses)
                                                : std::string("poses")) +
         (isUnlikely(diagnosis, selection) ? " of at least " + percent(selection.minimumProbability) : "");
}

std::string lostIn(const Diagnosis& diagnosis) { return "Lost in " + nameOf(*diagnosis.lostIn) + ": "; }

std::string votingVerdict(const Diagnosis& diagnosis)
{
  const VoteCounts counts = countsOf(diagnosis.votes);
  const std::string lost = lostIn(diagnosis);
  if (counts.points == 0)
  {
    return lost + "no scene point that could vote lies on the part.";
  }
  if (counts.references == 0)
  {
    return lost + "none of the " + counted(counts.points, "scene point", "scene points") +
           " on the part is a reference point.";
  }
  const std::string references = counted(counts.references, "reference point", "reference points");
  if (diagnosis.cause == LossCause::NoReference)
  {
    return lost + counted(counts.otherElecting, "point", "points") + " of " + std::to_string(counts.points) +
           " on the part would elect it, but none of its " + references + " does.";
  }
  return lost + "none of the " + references + " on the part elects it; the best gives it " +
         counted(counts.best.votes, "vote", "votes") + ", and another pose " + std::to_string(counts.best.most) + ".";
}
}

namespace
{
/// Whether what the scan holds beside it made the place unsure.
bool isDoubted(const Diagnosis& diagnosis)
{
  return diagnosis.lessByOthers >= LeastLess && diagnosis.probability < Likely;
}

/// Whether a look-alike may be there.
bool mayBeOther(const Diagnosis& diagnosis) { return isDoubted(diagnosis) && diagnosis.cutsInto == 0; }

/// What of a pose contradicts that it is the part.
std::string contradictionWords(const Contradictions& contradictions)
{
  const double continuing = contradictions.continuing, misfit = contradictions.misfit;
  if (contradictions.mirrored > Likely)
  {
    return "its mirror image fits better";
  }
  if (contradictions.resized > Likely)
  {
    return "what lies there is " + sizeWords(contradictions.lengths);
  }
  if (contradictions.surplus > contradictions.missing)
  {
    return "on most copies in the scan there is surface that the part does not have, over " +
           std::to_string(contradictions.surplus) + " patches";
  }
  if (contradictions.missing > 0)
  {
    return std::to_string(contradictions.missing) + " patches of its surface are missing on most copies in the scan";
  }
  const std::string beside =
    continuing >= LeastTold ? "surface goes on beside it over " + decimal(continuing) + " patches" : "";
  const std::string off =
    misfit > 1.0 ? "surface lies off the part by " + decimal(misfit) + " times what the scan explains" : "";
  return beside + (beside.empty() || off.empty() ? "" : ", and ") + off;
}

/// What to change where the pose is wrong.
std::string adviceOnFound(const Diagnosis& diagnosis)
{
  if (mayBeOther(diagnosis))
  {
    return "If it is wrong: where parts that look alike lie, search for all of them together.";
  }
  if (diagnosis.found->certainty < Likely)
  {
    return "If it is turned wrongly: light or scan the part so that what tells its rotation shows; "
           "RotationCounts keeps back what is unsure.";
  }
  if (!diagnosis.isOfFound)
  {
    return "";
  }
  return diagnosis.probability < Likely
           ? "If it is wrong: a MinimumProbability above " + percent(diagnosis.probability) + " keeps it back."
           : "If it is wrong: search for what lies there, too, by its own CAD, or calibrate the model by judged poses.";
}
}

std::string nameOf(PoseStage stage)
{
  switch (stage)
  {
    case PoseStage::Voting:
      return "voting";
    case PoseStage::Screening:
      return "screening";
    case PoseStage::CandidateVerification:
      return "verification of candidates";
    case PoseStage::CandidateSelection:
      return "selection of candidates";
    case PoseStage::Refinement:
      return "refinement";
    case PoseStage::Verification:
      return "verification";
    case PoseStage::Selection:
      break;
  }
  return "selection";
}

std::string verdictOf(const Diagnosis& diagnosis, const DetectionSettings& detection)
{
  const PlaceEvidence& evidence = diagnosis.evidence;
  const std::string rank = std::to_string(std::max(diagnosis.rank, diagnosis.rankWithoutLimits));
  const std::string off = offsetWords(diagnosis.offset) + " off";
  const std::string found = "Found as rank " + rank + ", " + percent(diagnosis.probability);
  const auto afterwards = [&] { return "; lost in " + nameOf(*diagnosis.lostIn) + "."; };
  switch (diagnosis.cause)
  {
    case LossCause::None:
      return found + (diagnosis.isOfFound ? "." : ", " + off + " the place asked about.");
    case LossCause::Inaccurate:
      return found + ", but " + off + " the place asked about.";
    case LossCause::NotWanted:
      return found + ", " + off + ", but only " + wantedWords(diagnosis, detection.selection) + " are wanted.";
    case LossCause::Outside:
      return "Not looked for: it lies outside of the region.";
    case LossCause::NothingShown:
      return "Nothing was found: the scan shows no part.";
    case LossCause::NoPose:
      return "No part there: however closely it is looked for, no pose of the part has its surface at this point.";
    case LossCause::NotThere:
      return "No part there: the sensor saw past " + percent(evidence.surfaceShare(PointState::Violated)) +
             " of the surface" + afterwards();
    case LossCause::NotMeasured:
      return "Not measured: at " + percent(evidence.surfaceShare(PointState::Unknown)) +
             " of the surface there is no point of the scan" + afterwards();
    case LossCause::Enclosed:
      return "No part can be there: " + percent(evidence.behind) +
             " of its surface would lie behind the bin's floor or a wall" + afterwards();
    case LossCause::Hidden:
      return "Hidden: something lies in front of " + percent(1.0 - diagnosis.place->visibleFraction) +
             " of the part's side towards the sensor" + afterwards();
    case LossCause::FewEdges:
      return "Lost at the edges: " + std::to_string(evidence.edgesMatched) + " of " +
             counted(evidence.edges, "predicted edge point has", "predicted edge points have") +
             " an edge of the scan, no more than anywhere.";
    case LossCause::NoReference:
    case LossCause::Outvoted:
      return votingVerdict(diagnosis);
    case LossCause::SurfaceMissing:
      return lostIn(diagnosis) + "at the best of " + counted(candidatesBefore(diagnosis), "candidate", "candidates") +
             " here " + percent(diagnosis.candidateShare) + " of the surface is there, less than " +
             percent(detection.screening ? detection.screening->leastSurface : 0.0) + ".";
    case LossCause::Duplicate:
      return lostIn(diagnosis) + "the " + counted(candidatesBefore(diagnosis), "candidate", "candidates") +
             " here went as duplicates of better ones.";
    case LossCause::LowScore:
      return lostIn(diagnosis) + "the score, " + percent(diagnosis.place->score) + ", is too low.";
    case LossCause::OtherRotation:
      return lostIn(diagnosis) + "the part was taken to be turned by one of its approximate symmetries.";
    case LossCause::Taken:
      return diagnosis.takenShare > SharedByOne
               ? lostIn(diagnosis) + takerWords(diagnosis) + ", was preferred."
               : lostIn(diagnosis) + "other poses of the same instance were preferred.";
    case LossCause::NotRefined:
    {
      const StageCount* stage = stageOf(diagnosis, PoseStage::CandidateVerification);
      return lostIn(diagnosis) + "rank " + std::to_string(stage ? stage->bestRank : 0) + " of " +
             counted(stage ? stage->poses : 0, "candidate", "candidates") + ", too unlikely to be refined.";
    }
    case LossCause::MovedAway:
      break;
  }
  return lostIn(diagnosis) + "the best candidate here came to a place that is " + off + ".";
}

std::string adviceOf(const Diagnosis& diagnosis, const DetectionSettings& detection)
{
  const PoseSelectionSettings& selection = detection.selection;
  const bool canVoteMore = detection.detection.features != Features::Both;
  switch (diagnosis.cause)
  {
    case LossCause::NotWanted:
      return (isBeyondMaximum(diagnosis, selection)
                 ? "Raise MaximumNumberOfPoses to " + std::to_string(diagnosis.rankWithoutLimits) +
                     " or more, or set it to 0." + (isUnlikely(diagnosis, selection) ? " " : "")
                 : "") +
             (isUnlikely(diagnosis, selection) ? "Lower MinimumProbability." : "");
    case LossCause::None:
    case LossCause::Inaccurate:
      return diagnosis.found ? adviceOnFound(diagnosis) : "";
    case LossCause::NotMeasured:
      return "Measure the part from another side or with another exposure.";
    case LossCause::Hidden:
      return "Take out what lies on it, and scan again.";
    case LossCause::Enclosed:
      return "When there is a part, it is the floor that is wrong: a plane behind which nothing was measured. "
             "Scan what is below, too.";
    case LossCause::Outside:
      return "Enlarge the region (Region), or search everywhere.";
    case LossCause::NothingShown:
      return adviceOnNothing({});
    case LossCause::NoPose:
      return "Take a point of the scan that lies on the part.";
    case LossCause::NotThere:
      return "If there is a part, compare a length of it in the scan and in the CAD file.";
    default:
      break;
  }
  if (diagnosis.isFoundByAllPoints)
  {
    return "Raise ReferenceShare: with all points on the part voting it is found.";
  }
  switch (diagnosis.cause)
  {
    case LossCause::FewEdges:
      return std::string("Light the bin from another side, with DepthEdges and Creases on") +
             (canVoteMore ? ", or let the surface vote, too (Features: Both)." : ".");
    case LossCause::NoReference:
      return "Raise ReferenceShare: more points vote.";
    case LossCause::Outvoted:
      return canVoteMore ? "Let edges and surface vote (Features: Both)."
                         : "Give the sensor's image, or scan with more points on the part: its edges are few here.";
    case LossCause::SurfaceMissing:
      return "Scan the part with fewer holes: from another side or with another exposure. "
             "If it has none, compare the part with the CAD file.";
    case LossCause::Duplicate:
    case LossCause::OtherRotation:
      return "Scan the part from where the detail shows that tells its rotation, or with more points on it.";
    case LossCause::LowScore:
      return "Look at the points that are missing: measure there, or compare the part with the CAD file.";
    case LossCause::Taken:
      return "If that pose is wrong, ask about it. "
             "Where several types of part lie in the bin, search for all of them together.";
    case LossCause::NotRefined:
      return "Search in a smaller region (Region), or for all types of part in the bin together.";
    default: // MovedAway
      return "Raise ReferenceShare: more candidates start near it. If that does not help, compare a length of the part "
             "in the scan and in the CAD file.";
  }
}

std::string mainReasonOf(const Diagnosis& diagnosis)
{
  if (diagnosis.cause == LossCause::NotWanted && diagnosis.probability >= LikelyFound)
  {
    return ""; // the limit is the reason
  }
  const std::vector<EvidenceTerm>& terms = diagnosis.odds.terms;
  const auto strongest = [&](double sign)
  {
    const auto adds = [sign](const EvidenceTerm& term) { return sign * term.adds; };
    const auto most = std::max_element(
      terms.begin(), terms.end(), [&](const EvidenceTerm& a, const EvidenceTerm& b) { return adds(a) < adds(b); });
    return most != terms.end() && adds(*most) >= LeastTold ? std::string(most->what) : "";
  };
  const std::string speaksFor = strongest(1.0);
  const std::string words = diagnosis.found ? contradictionWords(diagnosis.found->contradictions) : "";
  const std::string against = !isDoubted(diagnosis) ? strongest(-1.0)
                              : diagnosis.cutsInto > 0
                                ? "its body cuts into that of rank " + std::to_string(diagnosis.cutsInto)
                              : words.empty() ? "a part of just this shape may not be in the scan"
                                              : words;
  return (speaksFor.empty() ? "" : "Most for it: " + speaksFor + ".") +
         (speaksFor.empty() || against.empty() ? "" : " ") +
         (against.empty() ? "" : "Most against it: " + against + ".");
}

std::vector<std::string> reasonsOf(const Diagnosis& diagnosis)
{
  std::vector<std::string> sentences;
  const auto add = [&sentences](const std::string& sentence) { sentences.push_back(sentence); };
  const auto listed = [&](bool speaksFor)
  {
    std::vector<EvidenceTerm> terms;
    std::copy_if(diagnosis.odds.terms.begin(), diagnosis.odds.terms.end(), std::back_inserter(terms),
      [&](const EvidenceTerm& term) { return (term.adds > 0.0) == speaksFor && std::abs(term.adds) >= LeastTold; });
    std::stable_sort(terms.begin(), terms.end(),
      [](const EvidenceTerm& a, const EvidenceTerm& b) { return std::abs(a.adds) > std::abs(b.adds); });
    std::string words;
    for (const EvidenceTerm& term : terms)
    {
      words += (words.empty() ? "" : "; ") + std::string(term.what) + ", " + decimal(term.amount) + " " + term.unit +
               " (" + (speaksFor ? "+" : "") + decimal(term.adds) + ")";
    }
    return words.empty() ? "nothing" : words;
  };
  if (!diagnosis.odds.terms.empty())
  {
    add("For it, in the logarithm of the odds: " + listed(true) + ".");
    const double before = diagnosis.odds.before;
    add("Against it: " + listed(false) +
        (before < 0.0 ? "; to begin with, that most candidates are wrong (" + decimal(before) + ")." : "."));
    const PlaceOdds& odds = diagnosis.odds;
    const double together = std::accumulate(odds.terms.begin(), odds.terms.end(), before,
      [](double sum, const EvidenceTerm& term) { return sum + term.adds; });
    const double counted = (odds.sum() - odds.shareOfSearch * odds.searched) / (1.0 - odds.shareOfSearch);
    if (together - counted >= LeastTold)
    {
      add("Together that makes " + decimal(together) + ". So large a sum is damped, to " + decimal(counted) + ".");
    }
    if (odds.shareOfSearch >= LeastShare)
    {
      add("This scan shows few edges of a part: " + percent(odds.shareOfSearch) +
          " of the weight has the sum that it was searched by (" + decimal(odds.searched + diagnosis.penalty) + ")." +
          (diagnosis.penalty > 0.0
              ? " That sum has " + decimal(diagnosis.penalty) + " less, for the pose was moved to where it is largest."
              : ""));
    }
  }
  const std::string words = diagnosis.found ? contradictionWords(diagnosis.found->contradictions) : "";
  if (diagnosis.continuing >= LeastTold && !(isDoubted(diagnosis) && words.find("goes on") != std::string::npos))
  {
    add("Against it, too: measured surface goes on beside it over " + decimal(diagnosis.continuing) +
        " patches, unexplained.");
  }
  if (diagnosis.lessByOthers >= LeastTold)
  {
    add("The rest of the scan makes it less likely, by " + decimal(diagnosis.lessByOthers) +
        (!isDoubted(diagnosis)     ? "."
          : !mayBeOther(diagnosis) ? ": its body cuts into that of rank " + std::to_string(diagnosis.cutsInto) + "."
          : words.empty()          ? ": the part, or one of just this shape, may not be in it."
                                   : ": it may be another part that looks alike, for " + words + "."));
  }
  if (std::abs(diagnosis.moreByCalibration) >= LeastTold)
  {
    add(std::string("The model's calibration makes it ") + (diagnosis.moreByCalibration > 0.0 ? "more" : "less") +
        " likely, by " + decimal(std::abs(diagnosis.moreByCalibration)) + ".");
  }
  if (diagnosis.found)
  {
    const std::vector<RotationAlternative>& others = diagnosis.found->alternatives;
    if (!others.empty())
    {
      add("Its rotation is " + percent(diagnosis.found->certainty) + " sure; turned by " +
          decimal(rotationError(others.front().T_scene_model, diagnosis.found->T_scene_model)) + " degrees it is " +
          percent(others.front().share) + ".");
    }
    const std::string sizes = sizesWords(diagnosis.found->contradictions.lengths);
    if (!sizes.empty())
    {
      add("Of the lengths in the CAD file the parts in this scan measure " + sizes + ".");
    }
    if (diagnosis.found->contradictions.thickness != 1.0)
    {
      add(thicknessWords(diagnosis.found->contradictions.thickness));
    }
  }
  if (diagnosis.otherRank > 0)
  {
    add("The nearest other pose is rank " + std::to_string(diagnosis.otherRank) + ", " +
        percent(diagnosis.otherProbability) + ", " + offsetWords(diagnosis.otherOffset) + " off.");
  }
  return sentences;
}

std::vector<DiagnosisNumber> numbersOf(const Diagnosis& diagnosis)
{
  const double alone = std::numeric_limits<double>::quiet_NaN();
  std::vector<DiagnosisNumber> numbers;
  const auto add = [&](const std::string& step, const std::string& what, double value, double of) {
    numbers.push_back({ step, what, value, of });
  };
  if (!diagnosis.place)
  {
    return numbers;
  }
  const PlaceEvidence& evidence = diagnosis.evidence;
  add("edges", "predicted edge points with a scene edge near", evidence.edgesNear, evidence.edges);
  add("edges", "of these that run the same way", evidence.edgesMatched, evidence.edges);
  add("edges", "of these with a tangent that agrees", evidence.edgesAligned, evidence.edges);
  add("edges", "of these on lines longer than the part, as the bin's rim: they do not count",
    evidence.points.counts.edgesOfBin, evidence.edgesMatched);
  const double points = static_cast<double>(evidence.points.surface.size());
  const std::pair<PointState, const char*> states[] = { { PointState::Matched, "explained" },
    { PointState::Turned, "turned: a surface that faces elsewhere" },
    { PointState::Hidden, "hidden: something lies in front" },
    { PointState::Violated, "seen past: the sensor saw something behind" }, { PointState::Unknown, "not measured" } };
  for (const auto& [state, name] : states)
  {
    add("surface", name, evidence.surface(state), points);
  }
  add("surface", "share of the whole part behind the bin's floor or a wall", evidence.behind, alone);
  add("surface", "patches of the scan that go on beside it, unexplained", diagnosis.continuing, alone);
  const VoteCounts counts = countsOf(diagnosis.votes);
  add("voting", "points on the part that are reference points", counts.references, counts.points);
  add("voting", "reference points that elect the pose", counts.electing, counts.references);
  add("voting", "other points that would elect it", counts.otherElecting, counts.points - counts.references);
  add("voting", "votes for it of its best reference point, of that point's most", counts.best.votes, counts.best.most);
  add("screening", "share of the surface that is there", diagnosis.surfaceShare, alone);
  for (const StageCount& stage : diagnosis.stages)
  {
    add(nameOf(stage.stage), "poses here", stage.here, stage.poses);
    add(nameOf(stage.stage), "best rank here (0: none)", stage.bestRank, stage.poses);
  }
  add("score", "score at the place", diagnosis.place->score, alone);
  add("score", "probability at the place", diagnosis.place->probability, alone);
  add("score", "evidence, of the best pose's", diagnosis.place->evidence, diagnosis.bestEvidence);
  add("score", "rank among all refined poses (0: dropped)", diagnosis.placeRank, alone);
  add("selection", "rank of what came out here (0: nothing)", diagnosis.rank, alone);
  add("selection", "rank without limits on number and probability (0: nothing)", diagnosis.rankWithoutLimits, alone);
  add("selection", "probability of what came out, or would without limits", diagnosis.probability, alone);
  if (diagnosis.takenBy > 0)
  {
    add("selection", "pose that has most of the matched points", diagnosis.takenBy, alone);
    add("selection", "share of the matched points that it has", diagnosis.takenShare, alone);
    add("selection", "its evidence, against that of the place", diagnosis.takenEvidence, diagnosis.place->evidence);
  }
  return numbers;
}
}
