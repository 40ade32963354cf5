// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseVerification.h"

#include "base/Parallel.h"

#include <algorithm>
#include <numeric>

namespace meam
{
namespace
{
/// Section 5.2 of the paper: share of the view's edge points that have a scene edge point near.
void scoreByCoverage(Pose& pose, const Points& viewEdges, const EvidenceCollector& collector)
{
  const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
  const auto fitted =
    std::count_if(viewEdges.begin(), viewEdges.end(), [&](const auto& point) { return collector.nearEdge(T * point); });
  pose.score = viewEdges.empty() ? 0.0 : static_cast<double>(fitted) / viewEdges.size();
  pose.probability = pose.score;
  pose.visibleFraction = pose.score;
}
}

PoseVerificationSettings paperVerificationSettings()
{
  PoseVerificationSettings settings;
  settings.method = VerificationMethod::EdgeCoverage;
  settings.evidence.tolerance = 1.0;
  settings.posesPerView = 5;
  return settings;
}

int viewOf(const Pose& pose, const Scene& scene, const TrainedModel& model)
{
  const bool isNamed = pose.viewId >= 0 && pose.viewId < static_cast<int>(model.viewDirections.size());
  return isNamed ? pose.viewId : model.visibility->view(pose.T_scene_model, scene.sensor);
}

void scoreByEvidence(Pose& pose, const PoseEvidence& evidence, const EvidenceSettings& settings, const Scene& scene,
  const TrainedModel& model)
{
  pose.viewId = model.visibility->view(pose.T_scene_model, scene.sensor);
  pose.visibleFraction = evidence.visibleFraction();
  pose.score = evidence.score(settings);
  const ProbabilityCalibration& calibration = settings.calibration;
  pose.probability = (haveSurfaces(scene, model) ? calibration.withSurface : calibration.edgesAlone)
                       .probability(pose.score, pose.certainty);
}

Poses verifyPoses(const Poses& poses, const Scene& scene, const TrainedModel& model,
  const PoseVerificationSettings& settings, const Progress& progress)
{
  if (settings.pointStride < 1)
  {
    throw Error("The stride of the verification points must be 1 or more.");
  }
  const bool byEvidence = settings.method == VerificationMethod::VisibleEvidence;
  const EvidenceCollector collector(scene, model, settings.evidence);
  std::vector<Points> viewEdges; // asked for by coverage alone
  for (std::size_t v = 0; !byEvidence && v < model.viewDirections.size(); ++v)
  {
    viewEdges.push_back(model.edgesOfView(static_cast<int>(v)).points);
  }
  Poses scored = poses;
  parallelFor(static_cast<int>(scored.size()), settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        if (byEvidence)
        {
          const PoseEvidence evidence = collector.collect(scored[i].T_scene_model, settings.pointStride);
          scoreByEvidence(scored[i], evidence, settings.evidence, scene, model);
        }
        else
        {
          scored[i].viewId = viewOf(scored[i], scene, model);
          scoreByCoverage(scored[i], viewEdges[scored[i].viewId], collector);
        }
      }
    });
  std::stable_sort(
    scored.begin(), scored.end(), [](const Pose& a, const Pose& b) { return rankingValue(a) > rankingValue(b); });
  std::vector<int> ofView(TrainedModel::MaximumViews, 0);
  Poses kept;
  for (const Pose& pose : scored)
  {
    if (pose.score >= settings.minimumScore &&
        (settings.posesPerView == 0 || ++ofView[pose.viewId] <= settings.posesPerView))
    {
      kept.push_back(pose);
    }
  }
  report(progress, 1.0);
  return kept;
}
}
