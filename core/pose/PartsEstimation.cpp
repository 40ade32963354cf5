// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PartsEstimation.h"

#include "pose/PoseTolerances.h"
#include "pose/Stopwatch.h"
#include "pose/refinement/PartSize.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

namespace meam
{
namespace
{
constexpr double Searches = 0.95; // of the progress

bool isSure(const Pose& pose) { return pose.placeProbability >= 1.0 / (1.0 + std::exp(-SureLogOdds)); }

/// The types of part in a scene, and what was found of each.
class PartsSearch
{
public:
  PartsSearch(
    const std::vector<const TrainedModel*>& models, const SceneInput& input, const DetectionSettings& settings)
    : Models(models)
    , Settings(settings)
    , Found(models.size())
  {
    for (const TrainedModel* model : models)
    {
      StageTimes times;
      Stopwatch watch;
      this->Scenes.emplace_back(new Scene(sceneOf(*model, input, settings, &times)));
      times.scene = watch.lap() - times.tangents;
      this->Told.times += times;
    }
  }

  /// Looks for each of these types, until so many copies of each are sure; 0: for all.
  void search(const std::vector<int>& parts, int most, const Progress& progress)
  {
    const double count = static_cast<double>(parts.size());
    DetectionSettings settings = this->Settings;
    settings.selection.maximumPoses = most;
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      const int part = parts[k];
      const double done = static_cast<double>(k);
      settings.deadline = this->Settings.deadline.after(1.0 / (count - done));
      DetectionReport told;
      this->Found[part] = findPoses(*this->Scenes[part], *this->Models[part], settings, &told,
        subProgress(progress, done / count, (done + 1.0) / count));
      this->Told.times += told.times;
      this->Told.work += told.work;
      this->Told.rates = told.rates;
      this->Told.isCutShort = this->Told.isCutShort || told.isCutShort;
    }
  }

  /// Of what claims the same surface the best supported, best first, in the scene's own coordinates.
  std::vector<PartPose> resolved(const Progress& progress)
  {
    Stopwatch watch;
    std::vector<PartDetections> detections;
    for (std::size_t part = 0; part < this->Models.size(); ++part)
    {
      detections.push_back({ *this->Scenes[part], *this->Models[part], this->Found[part] });
    }
    ConflictResolutionSettings conflicts;
    conflicts.maximumPoses = this->Settings.selection.maximumPoses;
    conflicts.threads = this->Settings.selection.threads;
    std::vector<PartPose> result = resolveConflicts(detections, conflicts, progress);
    for (PartPose& one : result)
    {
      const Scene& scene = *this->Scenes[one.part];
      one.pose = toSceneFrame({ one.pose }, scene.T_local_scene(), this->Models[one.part]->symmetries).front();
    }
    this->Told.times.selection += watch.lap();
    return result;
  }

  /// The types of which so many copies are sure: a search for these ends before it has found all.
  std::vector<int> withSure(int count) const
  {
    std::vector<int> parts;
    for (std::size_t part = 0; part < this->Found.size(); ++part)
    {
      if (std::count_if(this->Found[part].begin(), this->Found[part].end(), isSure) >= count)
      {
        parts.push_back(static_cast<int>(part));
      }
    }
    return parts;
  }

  const DetectionReport& told() const { return this->Told; }

private:
  const std::vector<const TrainedModel*>& Models;
  const DetectionSettings& Settings;
  std::vector<std::unique_ptr<const Scene>> Scenes;
  std::vector<Poses> Found;
  DetectionReport Told;
};
}

RankedPoses posesOfPart(const std::vector<PartPose>& poses, int part)
{
  RankedPoses result;
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    if (poses[k].part == part)
    {
      result.poses.push_back(poses[k].pose);
      result.ranks.push_back(static_cast<int>(k) + 1);
    }
  }
  return result;
}

double largestDiameter(const std::vector<const TrainedModel*>& models)
{
  double largest = 0.0;
  for (const TrainedModel* model : models)
  {
    largest = std::max(largest, model->diameter);
  }
  return largest;
}

std::string untoldLengths(const std::vector<PartPose>& poses)
{
  std::map<int, Eigen::Vector3d> lengths;
  for (const PartPose& one : poses)
  {
    lengths.emplace(one.part, one.pose.contradictions.lengths);
  }
  std::string sentences;
  for (const auto& [part, factors] : lengths)
  {
    const std::string untold = lengths.size() > 1
                                 ? untoldWords(factors, "the copies of part " + std::to_string(part + 1))
                                 : untoldWords(factors);
    sentences += (sentences.empty() || untold.empty() ? "" : " ") + untold;
  }
  return sentences;
}

std::vector<PartPose> estimateParts(const std::vector<const TrainedModel*>& models, const SceneInput& input,
  const DetectionSettings& settings, DetectionReport* report, const Progress& progress)
{
  std::vector<PartPose> result;
  if (models.size() == 1)
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
  const int asked = settings.selection.maximumPoses;
  PartsSearch search(models, input, settings);
  std::vector<int> all(models.size());
  std::iota(all.begin(), all.end(), 0);
  search.search(all, asked, subProgress(progress, 0.0, asked > 0 ? 0.5 * Searches : Searches));
  result = search.resolved(asked > 0 ? Progress() : subProgress(progress, Searches, 1.0));
  const auto sure = std::count_if(result.begin(), result.end(), [](const PartPose& one) { return isSure(one.pose); });
  // Of a type that has lost places to another more may be found.
  const std::vector<int> more = asked > 0 && sure < asked ? search.withSure(asked) : std::vector<int>();
  if (!more.empty() && !search.told().isCutShort)
  {
    search.search(more, 0, subProgress(progress, 0.5 * Searches, Searches));
    result = search.resolved(subProgress(progress, Searches, 1.0));
  }
  if (report)
  {
    *report = search.told();
  }
  return result;
}
}
