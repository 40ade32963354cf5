// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickPlanning.h"

#include "base/Bounds.h"
#include "pick/planning/GraspSearch.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace meam
{
namespace
{
void check(const Poses& poses)
{
  for (const Pose& pose : poses)
  {
    if (!pose.T_scene_model.matrix().allFinite())
    {
      throw Error("A pose to pick at is not finite.");
    }
  }
}

void check(const Bin& bin, const Gripper& gripper, double margin)
{
  requireBin(bin);
  const double room = std::min(bin.size.x(), bin.size.y());
  double width = gripper.kind == GraspKind::Suction ? gripper.cupDiameter : gripper.fingerWidth;
  if (!gripper.mesh.triangles.empty())
  {
    width = bounds(gripper.mesh.vertices).cast<double>().sizes().head<2>().minCoeff();
  }
  if (width + 2.0 * margin > room)
  {
    throw Error("The gripper, " + std::to_string(std::lround(width)) + " mm wide, does not go into the bin of " +
                std::to_string(std::lround(room)) + " mm: check their units.");
  }
}

/// Adds the picks of one pose by all grasps; `copy`: its index among those that are likely, -1: it is none of them.
void addPicks(
  const GraspSearch& search, const Pose& pose, int index, int copy, const PickSurroundings& around, Picks& picks)
{
  const PlanSettings& settings = search.settings();
  const double covered = copy >= 0 ? coveredShare(pose, copy, search.surface(), around) : 0.0;
  const bool free = copy >= 0 && 100.0 * covered <= settings.maximumCovered;
  for (std::size_t g = 0; g < search.grasps().size(); ++g)
  {
    Pick pick;
    pick.T_scene_grasp = pose.T_scene_model * search.grasps()[g].T_model_grasp;
    pick.obstruction = copy >= 0 ? PickObstruction::Covered : PickObstruction::Uncertain;
    pick.tilt = tiltOf(pick.T_scene_grasp, around.up);
    const double probability = confidence(pose, search.needsRotation(g));
    if (free && probability < settings.minimumProbability)
    {
      pick.obstruction = PickObstruction::Uncertain;
    }
    else if (free)
    {
      pick = search.pickAt(pose, copy, static_cast<int>(g), around);
    }
    pick.pose = index;
    pick.grasp = static_cast<int>(g);
    pick.covered = covered;
    pick.reach = around.top - around.up.dot(pick.T_scene_grasp.translation());
    if (pick.possible())
    {
      pick.score = probability * search.grasps()[g].quality * (1.0 - covered) *
                   std::min(1.0, pick.clearance / ComfortableClearance);
    }
    picks.push_back(pick);
  }
}
}

PickPlanner::PickPlanner(const TriangleMesh& part, const Symmetries& symmetries, const Grasps& grasps,
  const Gripper& gripper, const PlanSettings& settings)
{
  requireSettings(settings);
  this->Search = std::make_unique<GraspSearch>(part, symmetries, grasps, gripper, settings);
}

PickPlanner::~PickPlanner() = default;

Picks PickPlanner::plan(
  const Poses& poses, const OrganizedCloud& cloud, const std::optional<Bin>& bin, const Progress& progress)
{
  return planAll({ this }, poses, std::vector<int>(poses.size(), 0), cloud, bin, progress);
}

Picks PickPlanner::planAll(const std::vector<PickPlanner*>& planners, const Poses& poses, const std::vector<int>& parts,
  const OrganizedCloud& cloud, const std::optional<Bin>& bin, const Progress& progress)
{
  check(poses);
  std::vector<const GraspSearch*> searches;
  std::vector<const PartSurface*> surfaces;
  for (const int part : parts)
  {
    searches.push_back(planners.at(part)->Search.get());
    surfaces.push_back(&searches.back()->surface());
  }
  const GridScale scale = cloud.points.empty() ? GridScale{} : gridScale(cloud);
  Picks picks;
  for (std::size_t part = 0; part < planners.size(); ++part)
  {
    GraspSearch& search = *planners[part]->Search;
    const double step = 1.0 / static_cast<double>(planners.size());
    const Progress ofPart = subProgress(progress, step * static_cast<double>(part), step * (part + 1.0));
    if (bin)
    {
      check(*bin, search.gripper(), search.settings().safetyMargin);
    }
    report(ofPart, 0.0);
    const PickSurroundings around =
      surroundingsOf(poses, surfaces, cloud, scale, bin, search.partSize(), search.settings());
    search.setObstacles(poses, searches, bin, around);
    int copies = 0;
    for (int k = 0; k < static_cast<int>(poses.size()); ++k)
    {
      report(ofPart, 0.3 + 0.7 * k / static_cast<double>(poses.size()));
      const bool likely = copies < static_cast<int>(around.copies.size()) && around.copies[copies] == k;
      if (parts[k] == static_cast<int>(part))
      {
        addPicks(search, poses[k], k, likely ? copies : -1, around, picks);
      }
      copies += likely;
    }
  }
  const auto order = [](const Pick& pick)
  { return std::make_tuple(-pick.score, -static_cast<int>(pick.obstruction), pick.tilt); };
  std::stable_sort(picks.begin(), picks.end(),
    [&](const Pick& a, const Pick& b) { return a.possible() != b.possible() ? a.possible() : order(a) < order(b); });
  report(progress, 1.0);
  return picks;
}
}
