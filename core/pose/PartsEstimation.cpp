// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PartsEstimation.h"

#include "pose/Stopwatch.h"

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
  DetectionReport ofAll;
  for (int part = 0; part < count; ++part)
  {
    const double begin = searches * part / count, end = searches * (part + 1) / count;
    DetectionReport told;
    StageTimes prepared;
    Stopwatch watch;
    all.deadline = settings.deadline.after(1.0 / (count - part));
    scenes.emplace_back(new Scene(sceneOf(*models[part], input, all, &prepared, subProgress(progress, begin, begin))));
    prepared.scene = watch.lap() - prepared.tangents;
    found[part] = findPoses(*scenes.back(), *models[part], all, &told, subProgress(progress, begin, end));
    detections.push_back({ *scenes.back(), *models[part], found[part] });
    told.isCutShort = told.isCutShort || ofAll.isCutShort;
    told.times += prepared;
    told.times += ofAll.times;
    ofAll = told;
  }
  Stopwatch watch;
  ConflictResolutionSettings conflicts;
  conflicts.maximumPoses = settings.selection.maximumPoses;
  conflicts.threads = settings.selection.threads;
  result = resolveConflicts(detections, conflicts, subProgress(progress, searches, 1.0));
  for (PartPose& one : result)
  {
    const Scene& scene = *scenes[one.part];
    one.pose = toSceneFrame({ one.pose }, scene.T_local_scene(), models[one.part]->symmetries).front();
  }
  ofAll.times.selection += watch.lap();
  if (report)
  {
    *report = ofAll;
  }
  return result;
}
}
