// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/PartsDiagnosis.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace meam
{
namespace
{
constexpr double SearchShare = 0.6; // of the progress, where types are searched first

/// The nearest likely pose that has its surface at the point.
std::optional<FoundPose> foundAt(
  const Eigen::Vector3d& point, const std::vector<FoundPose>& found, const std::vector<const TrainedModel*>& models)
{
  std::optional<FoundPose> at;
  double nearest = std::numeric_limits<double>::infinity();
  for (const FoundPose& one : found)
  {
    const TrainedModel& model = *models.at(one.part);
    const double distance = distanceFrom(model, one.pose.T_scene_model, point);
    if (claimOf(one.pose, false) >= LikelyFound && distance < std::min(nearest, OnSurface * model.diameter))
    {
      at = one;
      nearest = distance;
    }
  }
  return at;
}

/// By which types are compared at a place: one that verification keeps comes before one that it drops.
std::tuple<bool, double, double> supportOf(const Diagnosis& diagnosis)
{
  const std::optional<Pose>& pose = diagnosis.found ? diagnosis.found : diagnosis.place;
  const bool isKept = diagnosis.found || diagnosis.placeRank > 0;
  return { isKept, isKept ? pose->evidence : 0.0, pose ? pose->score : -1.0 };
}
}

PartsDiagnosis::PartsDiagnosis(
  std::vector<const TrainedModel*> models, const SceneInput& scene, const DetectionSettings& detection, bool fit)
  : Models(std::move(models))
  , Input(scene)
  , Detection(detection)
  , Fit(fit)
  , Searches(this->Models.size())
{
}

PartDiagnosis PartsDiagnosis::atPose(const Eigen::Isometry3d& T_scene_model, int part, const Progress& progress)
{
  return this->ask(
    part, progress, [&](PoseDiagnosis& of, int, const Progress& share) { return of.atPose(T_scene_model, share); });
}

PartDiagnosis PartsDiagnosis::ofFound(const FoundPose& found, const Progress& progress)
{
  return this->ask(found.part, progress,
    [&](PoseDiagnosis& of, int, const Progress& share) { return of.ofFound(found.pose, found.rank, share); });
}

PartDiagnosis PartsDiagnosis::atPoint(
  const Eigen::Vector3d& point, const std::vector<FoundPose>& found, int part, const Progress& progress)
{
  const std::optional<FoundPose> there = foundAt(point, found, this->Models);
  PartDiagnosis result = this->ask(part == AnyPart && there ? there->part : part, progress,
    [&](PoseDiagnosis& of, int asked, const Progress& share)
    {
      Poses poses;
      std::vector<int> ranks;
      for (const FoundPose& one : found)
      {
        if (one.part == asked)
        {
          poses.push_back(one.pose);
          ranks.push_back(one.rank);
        }
      }
      return of.atPoint(point, share, poses, ranks);
    });
  if (there && there->part != result.part)
  {
    result.other = there;
  }
  return result;
}

PartDiagnosis PartsDiagnosis::ask(int part, const Progress& progress, const Question& question)
{
  const int count = static_cast<int>(this->Models.size());
  if (part >= count)
  {
    throw Error("There is no type of part " + std::to_string(part) + ": of " + std::to_string(count) +
                " the first is 0. Give all parts of the search, in its order.");
  }
  std::vector<int> asked{ part };
  const bool isChosen = part != AnyPart || count == 1;
  if (part == AnyPart)
  {
    asked.resize(count);
    std::iota(asked.begin(), asked.end(), 0);
  }
  const auto ofShare = [&](double from, double to, std::size_t k)
  {
    const double step = (to - from) / static_cast<double>(asked.size());
    return subProgress(progress, from + step * static_cast<double>(k), from + step * static_cast<double>(k + 1));
  };
  for (std::size_t k = 0; k < asked.size(); ++k)
  {
    this->searched(asked[k], ofShare(0.0, SearchShare, k));
  }
  std::optional<PartDiagnosis> most;
  for (std::size_t k = 0; k < asked.size(); ++k)
  {
    const Progress share = ofShare(SearchShare, 1.0, k);
    PartDiagnosis one{ asked[k], isChosen, {}, {} };
    if (PoseDiagnosis* search = this->searched(asked[k], {}))
    {
      one.diagnosis = question(*search, asked[k], share);
    }
    else
    {
      one.diagnosis.cause = LossCause::NothingShown;
      one.diagnosis.lostIn = PoseStage::Voting;
    }
    if (!most || supportOf(one.diagnosis) > supportOf(most->diagnosis))
    {
      most = std::move(one);
    }
  }
  return *most;
}

PoseDiagnosis* PartsDiagnosis::searched(int part, const Progress& progress)
{
  Search& search = this->Searches[part];
  const TrainedModel& model = *this->Models[part];
  if (!search.diagnosis && !showsNothing(this->Input, model.diameter))
  {
    search.scene.reset(new Scene(sceneOf(model, this->Input, this->Detection))); // which cannot be moved
    search.diagnosis = std::make_unique<PoseDiagnosis>(*search.scene, model, this->Detection, this->Fit, progress);
  }
  return search.diagnosis.get();
}

std::string aboutWords(const PartDiagnosis& diagnosis, const std::vector<std::string>& names)
{
  const std::string types = std::to_string(names.size()) + " types";
  const auto named = [&](int part) { return names.at(part) + " (PartId " + std::to_string(part) + ")"; };
  const std::string about = "About " + named(diagnosis.part);
  if (names.size() == 1)
  {
    return "";
  }
  if (diagnosis.other)
  {
    return about + "; rank " + std::to_string(diagnosis.other->rank) + ", " + named(diagnosis.other->part) +
           ", came out there.";
  }
  return diagnosis.isChosen          ? about + "."
         : diagnosis.diagnosis.place ? about + ", which of " + types + " has most evidence there."
                                     : "Of none of " + types + " a pose has its surface there.";
}
}
