// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PartsEstimation.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"
#include "pose/PoseSearch.h"
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
constexpr double Voted = 0.75; // of the progress: up to refined poses

bool isSure(const Pose& pose) { return pose.placeProbability >= 1.0 / (1.0 + std::exp(-SureLogOdds)); }

/// The types of part in a scene, and what was found of each.
class PartsSearch
{
public:
  PartsSearch(
    const std::vector<const TrainedModel*>& models, const SceneInput& input, const DetectionSettings& settings)
    : Models(models)
    , Settings(settings)
    , Wanted(models.size(), 0)
    , Sure(models.size(), 0)
    , Telling(models.size())
    , Found(models.size())
  {
    for (const TrainedModel* model : models)
    {
      StageTimes times;
      Stopwatch watch;
      this->Scenes.emplace_back(new Scene(sceneOf(*model, input, settings, &times)));
      times.scene = watch.lap() - times.tangents;
      this->Told.times += times;
      this->Types.emplace_back(new PoseSearch(*this->Scenes.back(), *model, settings, this->Told));
    }
  }

  /// All types in turn by more and more of their reference points, until together as many copies as are asked for are
  /// sure.
  std::vector<PartPose> search(const Progress& callback)
  {
    double most = 0.0; // what is searched further does not take it back
    const auto onward = [&](double share)
    {
      most = std::max(most, share);
      return callback(most);
    };
    const Progress progress = callback ? Progress(onward) : Progress();
    std::vector<int> parts(this->Models.size());
    std::iota(parts.begin(), parts.end(), 0);
    std::vector<PartPose> stay;
    Deadline votes;
    searchByShares(this->Settings, subProgress(progress, 0.0, Voted),
      [&](double share, int wanted, const Deadline& ofVotes, const Progress& ofShare)
      {
        votes = ofVotes;
        this->upTo(share, parts, wanted, votes, ofShare);
        const bool isLast = this->Told.isCutShort || share == 1.0;
        if (isLast || (wanted > 0 && std::accumulate(this->Sure.begin(), this->Sure.end(), 0) >= wanted))
        {
          stay = this->selected(parts, subProgress(progress, Voted, 1.0));
          return isLast || this->areEnough(stay);
        }
        return false;
      });
    if (!this->Told.isCutShort && !this->areEnough(stay))
    {
      const std::vector<int> more = this->withMore();
      this->upTo(1.0, more, 0, votes, progress);
      stay = this->selected(more, progress);
    }
    return stay;
  }

  const DetectionReport& told() const { return this->Told; }

private:
  static double shareOf(std::size_t k, std::size_t count) { return static_cast<double>(k) / count; }

  bool isWanted(const PartPose& one) const { return this->Types[one.part]->isWanted(one.pose); }

  /// Of the type's copies that are wanted, those that are sure.
  int sureOf(int part) const
  {
    const Poses& found = this->Found[part];
    return static_cast<int>(std::count_if(
      found.begin(), found.end(), [&](const Pose& pose) { return isSure(pose) && this->Types[part]->isWanted(pose); }));
  }

  /// Types in turn by so many of their reference points, until together enough copies are as good as found; 0: all.
  void upTo(double share, const std::vector<int>& parts, int wanted, const Deadline& deadline, const Progress& progress)
  {
    const std::size_t count = parts.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      const int part = parts[k];
      const Deadline ofPart = deadline.after(shareOf(1, count - k));
      const Progress inTurn = ofPart.within(subProgress(progress, shareOf(k, count), shareOf(k + 1, count)));
      this->Wanted[part] = this->wantedOf(part, wanted);
      const bool isDone = isDoneBy(ofPart, [&] { this->Types[part]->upTo(share, this->Wanted[part], inTurn); });
      this->Told.isCutShort = this->Told.isCutShort || !isDone;
      this->Sure[part] = this->Types[part]->sure();
    }
  }

  /// Of so many copies that are wanted in all: what the other types do not have, and no less than the type's share.
  int wantedOf(int part, int wanted) const
  {
    const int count = static_cast<int>(this->Sure.size());
    const int others = std::accumulate(this->Sure.begin(), this->Sure.end(), -this->Sure[part]);
    return wanted > 0 ? std::max(wanted - others, (wanted + count - 1) / count) : 0;
  }

  /// The types of which more may be sure than were found, for these were enough.
  std::vector<int> withMore() const
  {
    std::vector<int> parts;
    for (int part = 0; part < static_cast<int>(this->Found.size()); ++part)
    {
      const int enough = std::min(this->Wanted[part], this->Settings.selection.maximumPoses);
      if (enough > 0 && this->sureOf(part) >= enough)
      {
        parts.push_back(part);
      }
    }
    return parts;
  }

  /// Whether as many of the copies that stay are sure as are asked for, or no more are to be had.
  bool areEnough(const std::vector<PartPose>& stay) const
  {
    const auto sure = std::count_if(stay.begin(), stay.end(), [](const PartPose& one) { return isSure(one.pose); });
    return sure >= this->Settings.selection.maximumPoses || this->withMore().empty();
  }

  /// Selects anew of these types. Of what claims the same surface the best supported, best first, in the scene's own
  /// coordinates.
  std::vector<PartPose> selected(const std::vector<int>& parts, const Progress& progress)
  {
    const std::size_t count = parts.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      const int part = parts[k];
      PoseSelectionSettings selection = this->Settings.selection;
      selection.sureCopies = this->Wanted[part];
      selection.maximumPoses = this->Wanted[part] > 0 ? selection.maximumPoses : 0;
      selection.deadline = this->Settings.deadline.after(shareOf(1, count - k));
      this->Telling[part] =
        this->Types[part]->finish(selection, subProgress(progress, shareOf(k, count + 1), shareOf(k + 1, count + 1)));
    }
    ConflictResolutionSettings conflicts;
    conflicts.threads = this->Settings.selection.threads;
    const std::vector<std::vector<bool>> onOthers = onOtherParts(this->detectionsOf(this->Telling), conflicts);
    for (const int part : parts)
    {
      this->Found[part] = this->Types[part]->ranked(onOthers[part]);
      this->Sure[part] = this->sureOf(part);
    }
    this->Told.isCutShort = this->Told.isCutShort || this->Settings.deadline.hasStruck();
    Stopwatch watch;
    std::vector<PartPose> stay = resolveConflicts(
      this->detectionsOf(this->Found), conflicts, subProgress(progress, shareOf(count, count + 1), 1.0));
    eraseIf(stay, [this](const PartPose& one) { return !this->isWanted(one); });
    const int asked = this->Told.maximumPoses = this->Settings.selection.maximumPoses;
    stay.resize(asked > 0 ? std::min<std::size_t>(stay.size(), asked) : stay.size());
    for (PartPose& one : stay)
    {
      const Scene& scene = *this->Scenes[one.part];
      one.pose = toSceneFrame({ one.pose }, scene.T_local_scene(), this->Models[one.part]->symmetries).front();
    }
    this->Told.times.selection += watch.lap();
    return stay;
  }

  std::vector<PartDetections> detectionsOf(const std::vector<Poses>& poses) const
  {
    return ofIndices<PartDetections>(this->Models.size(),
      [&](int part) {
        return PartDetections{ *this->Scenes[part], *this->Models[part], poses[part] };
      });
  }

  const std::vector<const TrainedModel*>& Models;
  const DetectionSettings& Settings;
  std::vector<std::unique_ptr<const Scene>> Scenes;
  std::vector<std::unique_ptr<PoseSearch>> Types;
  std::vector<int> Wanted;    ///< copies of each type that are to be sure
  std::vector<int> Sure;      ///< that are
  std::vector<Poses> Telling; ///< of each type, by themselves
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

std::string untoldLengths(const std::vector<PartPose>& poses, std::string told, const std::vector<std::string>& names)
{
  std::map<int, Eigen::Vector3d> lengths;
  for (const PartPose& one : poses)
  {
    lengths.emplace(one.part, one.pose.contradictions.lengths);
  }
  for (const auto& [part, factors] : lengths)
  {
    const std::string name = names.empty() ? "part " + std::to_string(part + 1) : names.at(part);
    appendSentence(told, lengths.size() > 1 ? untoldWords(factors, "the copies of " + name) : untoldWords(factors));
  }
  return told;
}

std::vector<PartPose> estimateParts(const std::vector<const TrainedModel*>& models, const SceneInput& input,
  const DetectionSettings& settings, DetectionReport* report, const Progress& progress)
{
  std::vector<PartPose> result;
  std::vector<const TrainedModel*> shown;
  std::vector<int> partOf;
  for (std::size_t part = 0; part < models.size(); ++part)
  {
    if (!showsNothing(input, models[part]->diameter))
    {
      shown.push_back(models[part]);
      partOf.push_back(static_cast<int>(part));
    }
  }
  if (shown.size() < models.size())
  {
    result = shown.empty() ? result : estimateParts(shown, input, settings, report, progress);
    for (PartPose& one : result)
    {
      one.part = partOf[one.part];
    }
    return result;
  }
  if (models.size() == 1)
  {
    for (const Pose& pose : estimatePoses(*models[0], input, settings, report, progress))
    {
      result.push_back({ 0, static_cast<int>(result.size()), pose });
    }
    return result;
  }
  PartsSearch search(models, input, settings);
  result = search.search(progress);
  if (report)
  {
    *report = search.told();
  }
  return result;
}
}
