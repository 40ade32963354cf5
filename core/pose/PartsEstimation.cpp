// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PartsEstimation.h"

#include <algorithm>
#include <memory>

namespace meam
{
std::vector<PartPose> estimateParts(const std::vector<const TrainedModel*>& models, const SceneInput& input,
  const DetectionSettings& settings, DetectionReport* report, const Progress& progress)
{
  const int count = static_cast<int>(models.size());
  std::vector<PartPose> result;
  if (count == 1)
  {
    for (const Pose& pose : estimatePoses(*models[0], input, settings, report, progress))
    {
      result.push_back({ 0, static_cast<int>(result.size()), pose });
    }
    return result;
  }
  if (std::all_of(
        models.begin(), models.end(), [&](const TrainedModel* model) { return showsNothing(input, model->diameter); }))
  {
    return result;
  }
  constexpr double searches = 0.95; // of the progress
  DetectionSettings all = settings;
  all.selection.maximumPoses = 0; // conflicts decide which poses stay
  std::vector<std::unique_ptr<const Scene>> scenes;
  std::vector<Poses> found(models.size());
  std::vector<PartDetections> detections;
  bool isCutShort = false;
  for (int part = 0; part < count; ++part)
  {
    const double begin = searches * part / count, end = searches * (part + 1) / count;
    DetectionReport told;
    all.deadline = settings.deadline.after(1.0 / (count - part));
    scenes.emplace_back(new Scene(sceneOf(*models[part], input, all, nullptr, subProgress(progress, begin, begin))));
    found[part] = findPoses(*scenes.back(), *models[part], all, &told, subProgress(progress, begin, end));
    detections.push_back({ *scenes.back(), *models[part], found[part] });
    isCutShort = isCutShort || told.isCutShort;
    if (report)
    {
      *report = told;
      report->isCutShort = isCutShort;
    }
  }
  ConflictResolutionSettings conflicts;
  conflicts.maximumPoses = settings.selection.maximumPoses;
  conflicts.threads = settings.selection.threads;
  result = resolveConflicts(detections, conflicts, subProgress(progress, searches, 1.0));
  for (PartPose& one : result)
  {
    const Scene& scene = *scenes[one.part];
    one.pose = toSceneFrame({ one.pose }, scene.T_local_scene(), models[one.part]->symmetries).front();
  }
  return result;
}
}
