// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "mesh/Symmetries.h"
#include "mesh/TriangleMesh.h"
#include "pick/Bin.h"
#include "pick/Grasp.h"
#include "pick/Gripper.h"
#include "pick/Pick.h"
#include "pick/PickSettings.h"
#include "pose/Pose.h"
#include "scene/OrganizedCloud.h"

#include <memory>
#include <optional>
#include <vector>

namespace meam
{
class GraspSearch;

/// Plans picks of one part with one gripper. A grasp is tried at all turns that are as good, those of the part's exact
/// symmetries and free ones, and comes back once: where it is possible and the clearance is largest.
class PickPlanner
{
public:
  /// Throws Error for an invalid mesh, gripper, grasp (among them one outside the part) or setting, and without a
  /// grasp.
  PickPlanner(const TriangleMesh& part, const Symmetries& symmetries, const Grasps& grasps, const Gripper& gripper,
    const PlanSettings& settings = {});
  ~PickPlanner();

  /// A pick for each pose and each grasp, in mm of the scan's frame: those that are possible first, best first, then
  /// those first that come farthest in the order of reasons. Without a bin down is the way the sensor looks, z, and
  /// nothing is known of walls but what was measured. The scan may be without points: then only the copies and the bin
  /// are in the way. Throws Error for a pose that is not finite and a gripper that is wider than the bin.
  Picks plan(
    const Poses& poses, const OrganizedCloud& cloud, const std::optional<Bin>& bin = {}, const Progress& progress = {});

  /// The same of several types of part, each with its grasps and one gripper; `parts`: of each pose the index of its
  /// planner. A pick's `pose` is the index among all, its `grasp` that among those of its type.
  static Picks planAll(const std::vector<PickPlanner*>& planners, const Poses& poses, const std::vector<int>& parts,
    const OrganizedCloud& cloud, const std::optional<Bin>& bin = {}, const Progress& progress = {});

private:
  std::unique_ptr<GraspSearch> Search;
};
}
