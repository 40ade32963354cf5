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
constexpr double PatchSide = 0.06;     // of the diameter: about ten samples of the surface
constexpr double OnPart = 0.02;        // of the diameter: surface so near to the part is the part's,
constexpr double OnPartNoises = 2.0;   // or so near in standard deviations of the scan's noise
constexpr double LeastFacing = 0.35;   // cosine towards the sensor: flatter surface is measured badly
constexpr int PointsOfPatch = 2;       // and no fewer show it on a copy
constexpr int CopiesOfPatch = 4;       // show it: fewer may be wrong at the same place
constexpr double MostOfCopies = 0.5;   // of them, on which a missing patch was seen past
constexpr int MissingByChance = 1;     // and one more of so many that are told of:
constexpr int ToldOfEachMissing = 100; // of right parts two of four hundred were, at most

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
bool isClearAbout(const Eigen::Vector3f& point, const Eigen::Vector3f& towards, float behind, const FineDepth& depth)
{
  const std::array<int, 4> cells = depth.neighboursOf(depth.cellAt(point));
  return std::all_of(cells.begin(), cells.end(),
    [&](int cell)
    {
      const Eigen::Vector3f* mean = cell < 0 ? nullptr : depth.meanIn(cell);
      return !mean || (point - *mean).dot(towards) > behind;
    });
}

std::map<Patch, PatchPoints> patchesOf(const Pose& pose, const Scene& scene, const TrainedModel& model)
{
  const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
  const Eigen::Vector3f towards = model.visibility->towards(pose.T_scene_model, scene.sensor);
  const Eigen::Vector3f inScene = T.linear() * towards;
  const float onPart = static_cast<float>(std::max(OnPart * model.diameter, OnPartNoises * scene.quality.noise));
  std::map<Patch, PatchPoints> patches;
  for (const int i : model.visibility->samplesInSight(pose.T_scene_model, scene.sensor, LeastFacing))
  {
    const Eigen::Vector3f& point = model.surface.points[i];
    PatchPoints& patch = patches[patchOf(point, model.symmetries, PatchSide * model.diameter)];
    const float behind = onPart / model.surface.normals[i].dot(towards);
    switch (scene.fineDepth.relation(T * point, behind))
    {
      case DepthGrid::Relation::OnSurface:
        ++patch.there;
        break;
      case DepthGrid::Relation::InFront:
        ++(isClearAbout(T * point, inScene, behind, scene.fineDepth) ? patch.past : patch.there);
        break;
      case DepthGrid::Relation::Hidden:
        ++patch.hidden;
        break;
      case DepthGrid::Relation::NoSurface:
        break;
    }
  }
  return patches;
}
}

int missingPatches(const Poses& poses, const Scene& scene, const TrainedModel& model, int threads)
{
  if (poses.size() < CopiesOfPatch)
  {
    return 0;
  }
  std::vector<std::map<Patch, PatchPoints>> ofPoses(poses.size());
  parallelForEach(
    static_cast<int>(poses.size()), threads, {}, [&](int i) { ofPoses[i] = patchesOf(poses[i], scene, model); });
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
  int told = 0, missing = 0;
  for (const auto& [place, copies] : patches)
  {
    const bool isTold = copies.showing >= CopiesOfPatch;
    told += isTold;
    missing += isTold && copies.past > MostOfCopies * copies.showing;
  }
  return std::max(missing - MissingByChance - (told + ToldOfEachMissing / 2) / ToldOfEachMissing, 0);
}
}
