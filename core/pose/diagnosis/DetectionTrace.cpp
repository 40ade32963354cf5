// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/DetectionTrace.h"

#include "base/sequences/Sequences.h"

#include <algorithm>

namespace meam
{
namespace
{
PoseOffset offsetUpTo(
  const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const Symmetries& symmetries, const TrainedModel& model)
{
  return { translationError(a, b, model.visibility->middle().cast<double>()),
    rotationError(nearestEqual(a, b, symmetries), b) };
}
}

PoseOffset offsetBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const TrainedModel& model)
{
  return offsetUpTo(a, b, model.symmetries, model);
}

PoseOffset offsetUpToNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const TrainedModel& model)
{
  const Symmetries same = asIfRound(model.symmetries);
  PoseOffset least = offsetUpTo(a, b, same, model);
  for (const NearSymmetry& near : model.symmetries.near)
  {
    const PoseOffset turned = offsetUpTo(a * near.T, b, same, model);
    least = turned.angle < least.angle ? turned : least;
  }
  return least;
}

std::vector<int> posesAt(const Poses& poses, const Eigen::Isometry3d& T_scene_model, const PlaceTolerance& tolerance,
  const TrainedModel& model)
{
  return indicesWhere(
    poses.size(), [&](int i) { return offsetBetween(poses[i].T_scene_model, T_scene_model, model).within(tolerance); });
}

DetectionTrace::DetectionTrace(
  const Scene& scene, const TrainedModel& model, const DetectionSettings& settings, const Progress& progress)
  : InScene(scene)
  , Model(model)
  , Settings(settings)
{
  DetectionSettings all = settings;
  all.selection.maximumPoses = 0;
  all.selection.minimumProbability = 0.0;
  this->Unlimited = findPoses(scene, model, all, &this->Report, progress,
    [this](PoseStage stage, const Poses& poses) {
      this->Stages.push_back({ stage, poses });
    });
  this->Stages.back().poses = withinLimits(this->Unlimited, settings.selection);
}

const Poses& DetectionTrace::posesOf(PoseStage stage) const
{
  return std::find_if(
    this->Stages.begin(), this->Stages.end(), [stage](const Stage& one) { return one.stage == stage; })
    ->poses;
}

const Poses& DetectionTrace::allAlternatives()
{
  if (!this->AllAlternatives)
  {
    this->AllAlternatives =
      selectClusters(this->posesOf(PoseStage::CandidateVerification), this->Model, this->Settings.candidateSelection);
  }
  return *this->AllAlternatives;
}
}
