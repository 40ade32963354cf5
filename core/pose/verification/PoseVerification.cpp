// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseVerification.h"

#include "base/Parallel.h"
#include "baselines/EdgeCoverage.h"
#include "baselines/VoteScore.h"
#include "pose/verification/ProbabilityCalibration.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr double OfRotation = 0.5; // of what a pose is worth: the rest that a copy is there, however it is turned

}

PoseVerificationSettings candidateVerificationSettings()
{
  PoseVerificationSettings settings;
  settings.pointStride = 2;
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
  parallelForEach(static_cast<int>(candidates.size()), threads, {},
    [&](int i) { counts[i] = collector.collect(candidates[i].T_scene_model, stride).counts; });
  return evidenceRates(counts, collector.sheetThickness());
}

namespace
{
/// What comes back are the rates that counted.
EvidenceRates scoreByEvidence(Poses& poses, const Scene& scene, const TrainedModel& model,
  const EvidenceCollector& collector, const PoseVerificationSettings& settings, const Progress& progress,
  EvidenceMemory& memory)
{
  const std::vector<SeenAtPose> seen = memory.of(poses,
    [&](const Poses& unknown)
    {
      std::vector<SeenAtPose> result(unknown.size());
      parallelForEach(static_cast<int>(unknown.size()), settings.threads, progress,
        [&](int i)
        {
          Pose pose = unknown[i];
          const PoseEvidence evidence = collector.collect(pose.T_scene_model, settings.pointStride);
          setSeen(pose, evidence, scene, model);
          result[i] = { evidence.counts, pose.score, pose.visibleFraction, pose.viewId };
        });
      return result;
    });
  std::vector<EvidenceCounts> counts;
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    poses[i].score = seen[i].score;
    poses[i].visibleFraction = seen[i].visibleFraction;
    poses[i].viewId = seen[i].viewId;
    counts.push_back(seen[i].counts);
  }
  const EvidenceRates rates =
    settings.evidence.rates ? *settings.evidence.rates : evidenceRates(counts, collector.sheetThickness());
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    setEvidence(poses[i], collector.logOdds(counts[i], rates));
  }
  return rates;
}
}

Poses verifyPoses(const Poses& poses, const Scene& scene, const TrainedModel& model,
  const PoseVerificationSettings& settings, const Progress& progress, EvidenceRates* ofScan, EvidenceMemory* memory)
{
  if (settings.pointStride < 1)
  {
    throw Error("The stride of the verification points must be 1 or more.");
  }
  Poses scored = poses;
  const EvidenceCollector collector(scene, model, settings.evidence);
  switch (settings.method)
  {
    case VerificationMethod::EdgeCoverage:
      scoreByEdgeCoverage(scored, scene, model, collector.tolerance(), settings.threads, progress);
      break;
    case VerificationMethod::Votes:
      scoreByVotes(scored, scene, model, settings.threads);
      break;
    case VerificationMethod::VisibleEvidence:
    {
      EvidenceMemory ofThese;
      const EvidenceRates rates =
        scoreByEvidence(scored, scene, model, collector, settings, progress, memory ? *memory : ofThese);
      if (ofScan)
      {
        *ofScan = rates;
      }
      break;
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
