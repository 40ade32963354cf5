// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/InstanceOdds.h"

#include "pose/objective/BodyOverlap.h"
#include "pose/objective/SurfaceContinuation.h"
#include "pose/verification/PoseVerification.h"
#include "pose/verification/ProbabilityCalibration.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double Likely = 0.5;          // place of a pose that explains what it lies on
constexpr std::size_t MostShowing = 20; // poses that tell in what they differ
constexpr double MayLieBeside = 0.1;    // place of a pose that what goes on beside another may belong to
constexpr double PriorOfSame = 3.0; // log odds that it is the part: another lies there by mistake, one time in twenty
constexpr double OfDifferentPatch = -5.0; // beyond chance
}

bool tells(const FinishedInstance& finished)
{
  return !finished.isLeft && !finished.isOnOther && finished.pose.placeProbability >= Likely;
}

void allowFor(FinishedInstance& finished, double certainty)
{
  finished.logOdds = withCertainty(finished.logOdds, certainty);
  setEvidence(finished.pose, finished.logOdds);
}

Poses likelyOf(const FinishedInstances& found, std::size_t most)
{
  Poses likely;
  for (const FinishedInstance& finished : found)
  {
    if (tells(finished) && likely.size() < most)
    {
      likely.push_back(finished.pose);
    }
  }
  return likely;
}

void sortBest(FinishedInstances& found)
{
  std::stable_sort(found.begin(), found.end(),
    [](const FinishedInstance& a, const FinishedInstance& b)
    { return a.isLeft != b.isLeft ? b.isLeft : isBetter(a.pose, b.pose); });
}

void excludeOverlaps(FinishedInstances& found, const TrainedModel& model)
{
  const auto count = std::count_if(found.begin(), found.end(),
    [](const FinishedInstance& finished) { return finished.pose.placeProbability > WorthExplaining; });
  std::vector<std::vector<char>> cuts(count, std::vector<char>(count, 0));
  std::vector<double> odds;
  for (int k = 0; k < count; ++k)
  {
    odds.push_back(std::exp(found[k].logOdds));
    for (int other = 0; other < k; ++other)
    {
      cuts[k][other] = cuts[other][k] =
        bodiesOverlap(model, found[k].pose.T_scene_model, found[other].pose.T_scene_model);
    }
  }
  // The odds of a pose beside another one are less where others exclude it that may be right together with that one.
  const auto oddsBeside = [&](int one, int beside)
  {
    double excluding = 0.0;
    for (int third = 0; third < count; ++third)
    {
      excluding += third != beside && cuts[one][third] && !cuts[beside][third] ? odds[third] : 0.0;
    }
    return odds[one] / (1.0 + excluding);
  };
  for (int k = 0; k < count; ++k)
  {
    double others = 0.0;
    for (int other = 0; other < count; ++other)
    {
      others += cuts[k][other] ? oddsBeside(other, k) : 0.0;
    }
    found[k].logOdds -= std::log1p(others);
    setEvidence(found[k].pose, found[k].logOdds);
  }
}

void allowForLookalikes(
  FinishedInstances& found, const TrainedModel& model, const SurfaceContinuation& continuation, double excused)
{
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  std::vector<Contradictions> contradictions;
  std::vector<double> places;
  for (FinishedInstance& finished : found)
  {
    Pose& pose = finished.pose;
    std::vector<Eigen::Isometry3f> beside;
    for (const FinishedInstance& other : found)
    {
      const bool isNear = translationError(other.pose.T_scene_model, pose.T_scene_model, middle) < 1.5 * model.diameter;
      if (&other != &finished && isNear && other.pose.placeProbability >= Likely)
      {
        beside.push_back(other.pose.T_scene_model.inverse().cast<float>());
      }
    }
    pose.contradictions.continuing = continuation.unexplained(finished.beyond, beside);
    contradictions.push_back(pose.contradictions);
    places.push_back(tells(finished) ? pose.placeProbability : 0.0);
  }
  const std::vector<double> shares = sharesOfPart(contradictions, places, excused);
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    allowFor(found[k], shares[k]);
  }
}

CommonDifferences differencesOfLikely(
  const FinishedInstances& found, const Scene& scene, const TrainedModel& model, int threads)
{
  Poses beside;
  for (const FinishedInstance& finished : found)
  {
    if (finished.pose.placeProbability >= MayLieBeside)
    {
      beside.push_back(finished.pose);
    }
  }
  return commonDifferences(likelyOf(found, MostShowing), beside, scene, model, threads);
}

void allowForDifferences(FinishedInstances& found, const CommonDifferences& differences, double excused)
{
  const int surplus = static_cast<int>(std::lround((1.0 - excused) * differences.surplus));
  const int patches = differences.missing + surplus;
  for (FinishedInstance& finished : found)
  {
    finished.pose.contradictions.missing = differences.missing;
    finished.pose.contradictions.surplus = surplus;
    if (patches > 0)
    {
      allowFor(finished, probabilityOf(PriorOfSame + OfDifferentPatch * patches));
    }
  }
}

void calibrate(FinishedInstances& found, const ModelCalibration& calibration)
{
  for (FinishedInstance& finished : found)
  {
    Pose& pose = finished.pose;
    const double certainty = calibration.certaintyOf(pose.certainty);
    for (RotationAlternative& other : pose.alternatives) // with the pose's own they sum to 1
    {
      other.share *= pose.certainty < 1.0 ? (1.0 - certainty) / (1.0 - pose.certainty) : 1.0;
    }
    pose.certainty = certainty;
    finished.logOdds = calibration.place.logOdds(finished.logOdds);
    setEvidence(pose, finished.logOdds);
  }
}
}
