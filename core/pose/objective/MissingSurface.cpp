// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/MissingSurface.h"

#include "base/Parallel.h"

#include <algorithm>
#include <array>
#include <map>

namespace meam
{
namespace
{
constexpr double PatchSide = 0.07;   // of the diameter: several verification points
constexpr double OnPart = 0.02;      // of the diameter: surface so near to the part is the part's,
constexpr double OnPartNoises = 2.0; // or so near in standard deviations of the scan's noise
constexpr float LeastFacing = 0.35f; // cosine towards the sensor: flatter surface is measured badly
constexpr int PointsOfPatch = 2;     // and no fewer show it on a copy
constexpr int CopiesOfPatch = 4;     // show it, and half of all: a side that only few poses show tells of wrong ones
constexpr double MostOfCopies = 0.5; // of them, on which a missing patch was seen past

using Patch = std::array<int, 3>;

/// The patch of a point: of a round part a ring, for its copies are turned by any angle.
Patch patchOf(const Eigen::Vector3f& point, const Symmetries& symmetries, double side)
{
  Eigen::Vector3d place = point.cast<double>();
  if (!symmetries.continuous.empty())
  {
    const auto& [axis, foot] = symmetries.continuous.front();
    const double along = (place - foot).dot(axis);
    place = Eigen::Vector3d(along, (place - foot - along * axis).norm(), 0.0);
  }
  const Eigen::Array3i cell = (place.array() / side).floor().cast<int>();
  return { cell.x(), cell.y(), cell.z() };
}

/// Points of a patch on one copy.
struct PatchPoints
{
  int there = 0; ///< or seen past at a rim
  int past = 0, hidden = 0;
};

/// Whether the sensor saw past a point in all cells about its own, too. `behind`: mm along the line of sight.
bool isClearAbout(const Eigen::Vector3f& point, const Eigen::Vector3f& towards, float behind, const DepthMap& depth)
{
  bool isMeasured = false;
  for (const int cell : depth.neighboursOf(depth.cellAt(point)))
  {
    if (cell >= 0 && depth.isMeasured(cell))
    {
      isMeasured = true;
      if ((point - depth.meanIn(cell)).dot(towards) <= behind)
      {
        return false;
      }
    }
  }
  return isMeasured;
}

std::map<Patch, PatchPoints> patchesOf(const Pose& pose, const Scene& scene, const TrainedModel& model)
{
  const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
  const DepthMap& depth = scene.depth;
  const auto visible = model.visibility->visible(pose.T_scene_model, scene.sensor, depth.pitch());
  const Eigen::Vector3f towards = T.linear() * model.visibility->towards(pose.T_scene_model, scene.sensor);
  const float onPart = static_cast<float>(std::max(OnPart * model.diameter, OnPartNoises * scene.quality.noise));
  std::map<Patch, PatchPoints> patches;
  for (const int i : visible->surface)
  {
    const float cosine = (T.linear() * model.surface.normals[i]).dot(towards);
    if (cosine < LeastFacing)
    {
      continue;
    }
    const Eigen::Vector3f point = T * model.surface.points[i];
    PatchPoints& patch = patches[patchOf(model.surface.points[i], model.symmetries, PatchSide * model.diameter)];
    const DepthMap::Relation relation = depth.relationToMean(point, onPart / cosine);
    const bool isPast = relation == DepthMap::Relation::InFront && isClearAbout(point, towards, onPart / cosine, depth);
    patch.past += isPast;
    patch.hidden += relation == DepthMap::Relation::Hidden;
    patch.there += !isPast && relation != DepthMap::Relation::Hidden && relation != DepthMap::Relation::NoSurface;
  }
  return patches;
}
}

int missingPatches(const Poses& poses, const Scene& scene, const TrainedModel& model, int threads)
{
  std::vector<std::map<Patch, PatchPoints>> ofPoses(poses.size());
  parallelFor(static_cast<int>(poses.size()), threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        ofPoses[i] = patchesOf(poses[i], scene, model);
      }
    });
  struct Copies
  {
    int showing = 0;
    double past = 0.0;
  };
  std::map<Patch, Copies> patches;
  for (const auto& ofPose : ofPoses)
  {
    for (const auto& [place, points] : ofPose)
    {
      const int seen = points.there + points.past;
      if (seen >= PointsOfPatch && seen > points.hidden)
      {
        Copies& copies = patches[place];
        ++copies.showing;
        copies.past += static_cast<double>(points.past) / seen;
      }
    }
  }
  const int least = std::max(CopiesOfPatch, static_cast<int>(poses.size() + 1) / 2);
  return static_cast<int>(std::count_if(patches.begin(), patches.end(),
    [least](const auto& of)
    { return of.second.showing >= least && of.second.past > MostOfCopies * of.second.showing; }));
}
}
