// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseVerification.h"

#include "base/Parallel.h"
#include "pose/PoseTolerances.h"
#include "pose/verification/ProbabilityCalibration.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double OfRotation = 0.5; // of what a pose is worth: the rest that a copy is there, however it is turned

/// Section 5.2 of the paper: share of the view's edge points that have a scene edge point near.
void scoreByCoverage(Pose& pose, const Points& viewEdges, const EvidenceCollector& collector)
{
  const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
  const auto fitted =
    std::count_if(viewEdges.begin(), viewEdges.end(), [&](const auto& point) { return collector.nearEdge(T * point); });
  pose.score = viewEdges.empty() ? 0.0 : static_cast<double>(fitted) / viewEdges.size();
  pose.placeProbability = pose.probability = pose.score;
  pose.evidence = std::log(pose.score / (1.0 - pose.score)); // infinite when all or nothing fits
  pose.visibleFraction = pose.score;
}

/// Sums up the votes of the poses that agree with each.
void scoreByVotes(Poses& poses, const TrainedModel& model, int threads)
{
  const double distance = SamePoseDistance * model.diameter;
  Points middles;
  for (const Pose& pose : poses)
  {
    middles.emplace_back((pose.T_scene_model * model.visibility->middle().cast<double>()).cast<float>());
  }
  const PointGrid grid(middles, distance);
  std::vector<int> sums(poses.size(), 0);
  parallelFor(static_cast<int>(poses.size()), threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        grid.forEachWithin(middles[i], distance,
          [&](int other, float)
          {
            const bool agrees = rotationError(poses[i].T_scene_model, poses[other].T_scene_model) < SamePoseAngle;
            sums[i] += agrees ? poses[other].votes : 0;
          });
      }
    });
  const int most = sums.empty() ? 0 : *std::max_element(sums.begin(), sums.end());
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    poses[i].votes = sums[i];
    poses[i].score = most > 0 ? static_cast<double>(sums[i]) / most : 0.0;
    poses[i].evidence = sums[i]; // orders the poses of one scene; no odds
  }
}
}

PoseVerificationSettings votesVerificationSettings()
{
  PoseVerificationSettings settings;
  settings.method = VerificationMethod::Votes;
  return settings;
}

PoseVerificationSettings candidateVerificationSettings()
{
  PoseVerificationSettings settings;
  settings.pointStride = 2;
  return settings;
}

PoseVerificationSettings paperVerificationSettings()
{
  PoseVerificationSettings settings;
  settings.method = VerificationMethod::EdgeCoverage;
  // The text leaves these open: what comes closest to its figures (docs/evaluation.md, readings).
  settings.evidence.tolerance = 1.5;
  settings.posesPerView = 20;
  return settings;
}

int viewOf(const Pose& pose, const Scene& scene, const TrainedModel& model)
{
  const bool isNamed = pose.viewId >= 0 && pose.viewId < static_cast<int>(model.viewDirections.size());
  return isNamed ? pose.viewId : model.visibility->view(pose.T_scene_model, scene.sensor);
}

void setSeen(Pose& pose, const PoseEvidence& evidence, const Scene& scene, const TrainedModel& model)
{
  pose.viewId = model.visibility->view(pose.T_scene_model, scene.sensor);
  pose.visibleFraction = evidence.visibleFraction();
  pose.score = evidence.score();
}

void setEvidence(Pose& pose, double logOdds)
{
  pose.evidence = withCertainty(logOdds, 1.0 - OfRotation + OfRotation * pose.certainty);
  pose.placeProbability = probabilityOf(logOdds);
  pose.probability = pose.certainty * pose.placeProbability;
}

EvidenceRates evidenceRatesOf(const Poses& candidates, const EvidenceCollector& collector,
  const EvidenceSettings& settings, std::size_t stride, int threads)
{
  if (settings.rates)
  {
    return *settings.rates;
  }
  std::vector<EvidenceCounts> counts(candidates.size());
  parallelFor(static_cast<int>(candidates.size()), threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        counts[i] = collector.collect(candidates[i].T_scene_model, stride).counts;
      }
    });
  return evidenceRates(counts);
}

Poses verifyPoses(const Poses& poses, const Scene& scene, const TrainedModel& model,
  const PoseVerificationSettings& settings, const Progress& progress, EvidenceRates* ofScan)
{
  if (settings.pointStride < 1)
  {
    throw Error("The stride of the verification points must be 1 or more.");
  }
  const bool byEvidence = settings.method == VerificationMethod::VisibleEvidence;
  const bool byCoverage = settings.method == VerificationMethod::EdgeCoverage;
  const EvidenceCollector collector(scene, model, settings.evidence);
  std::vector<Points> viewEdges; // asked for by coverage alone
  for (std::size_t v = 0; byCoverage && v < model.viewDirections.size(); ++v)
  {
    viewEdges.push_back(model.edgesOfView(static_cast<int>(v)).points);
  }
  Poses scored = poses;
  std::vector<EvidenceCounts> counts(byEvidence ? poses.size() : 0);
  parallelFor(static_cast<int>(scored.size()), settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        if (byEvidence)
        {
          const PoseEvidence evidence = collector.collect(scored[i].T_scene_model, settings.pointStride);
          counts[i] = evidence.counts;
          setSeen(scored[i], evidence, scene, model);
        }
        else
        {
          scored[i].viewId = viewOf(scored[i], scene, model);
        }
        if (byCoverage)
        {
          scoreByCoverage(scored[i], viewEdges[scored[i].viewId], collector);
        }
      }
    });
  if (settings.method == VerificationMethod::Votes)
  {
    scoreByVotes(scored, model, settings.threads);
  }
  if (byEvidence)
  {
    const EvidenceRates rates = settings.evidence.rates ? *settings.evidence.rates : evidenceRates(counts);
    if (ofScan)
    {
      *ofScan = rates;
    }
    for (std::size_t i = 0; i < scored.size(); ++i)
    {
      setEvidence(scored[i], collector.logOdds(counts[i], rates));
    }
  }
  std::stable_sort(scored.begin(), scored.end(), isBetter);
  std::vector<int> ofView(TrainedModel::MaximumViews, 0);
  Poses kept;
  for (const Pose& pose : scored)
  {
    if (settings.posesPerView == 0 || ++ofView[pose.viewId] <= settings.posesPerView)
    {
      kept.push_back(pose);
    }
  }
  report(progress, 1.0);
  return kept;
}
}
