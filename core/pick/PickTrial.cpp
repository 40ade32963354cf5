// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickTrial.h"

#include "base/Range.h"
#include "pick/PickCollisions.h"

namespace meam
{
namespace
{
constexpr double Step = 1.0; // mm between the places at which a gripper that is a mesh is looked at

PickTrial tryPick(const PickCollisions& world, const Grasp& pick, const std::vector<Eigen::Isometry3d>& truths,
  const PickTrialSettings& settings)
{
  const Eigen::Isometry3d& T_scene_grasp = pick.T_model_grasp;
  const std::vector<int> held = world.heldBy(pick, T_scene_grasp, settings.cupSlack);
  PickTrial trial;
  if (held.size() > 1)
  {
    trial.outcome = TrialOutcome::HitsOther;
    return trial;
  }
  trial.instance = held.empty() ? -1 : held.front();
  // A cup gives way as it comes down on the part.
  const double back = pick.kind == GraspKind::Suction ? settings.cupSlack : 0.0;
  const Eigen::Isometry3d stop = T_scene_grasp * Eigen::Translation3d(0.0, 0.0, -back);
  const Clearance clearance = world.clearance(pick, stop, trial.instance, settings.wayIn, Step, Step);
  if (clearance.distance <= 0.0)
  {
    trial.outcome = clearance.obstacle == Obstacle::Bin ? TrialOutcome::HitsBin
                    : held.empty()                      ? TrialOutcome::HitsPart
                                                        : TrialOutcome::HitsOther;
  }
  else if (!held.empty())
  {
    Grasp actual = pick;
    actual.T_model_grasp = truths[trial.instance].inverse() * stop;
    trial.outcome = world.touchesHeld(actual, settings.wayIn, Step) ? TrialOutcome::HitsPart : TrialOutcome::Success;
  }
  return trial;
}
}

std::vector<PickTrial> tryPicks(const TriangleMesh& part, const Gripper& gripper, const Grasps& picks,
  const std::vector<Eigen::Isometry3d>& truths, const Bin* bin, const PickTrialSettings& settings,
  const Progress& progress)
{
  requireWithin("way in", settings.wayIn, 0.0, Unbounded, " mm");
  requireWithin("cup's slack", settings.cupSlack, 0.0, Unbounded, " mm");
  PickCollisions world(part, gripper);
  world.setBin(bin);
  world.setInstances(truths);
  std::vector<PickTrial> trials;
  for (const Grasp& pick : picks)
  {
    report(progress, static_cast<double>(trials.size()) / static_cast<double>(picks.size()));
    trials.push_back(tryPick(world, pick, truths, settings));
  }
  return trials;
}

std::string describe(TrialOutcome outcome)
{
  switch (outcome)
  {
    case TrialOutcome::Success:
      return "success";
    case TrialOutcome::HitsBin:
      return "hits the bin";
    case TrialOutcome::HitsOther:
      return "hits another part";
    case TrialOutcome::HitsPart:
      return "hits the part itself";
    case TrialOutcome::HoldsNothing:
      return "holds nothing";
  }
  return {};
}
}
