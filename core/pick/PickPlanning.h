// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "mesh/Symmetries.h"
#include "pick/Bin.h"
#include "pick/Grasp.h"
#include "pick/Gripper.h"
#include "pose/Pose.h"
#include "scene/OrganizedCloud.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meam
{
struct PickSettings
{
  double safetyMargin = 2.0;          ///< mm that the gripper keeps from all but the part that it holds
  double wayIn = 80.0;                ///< mm, straight along the grasp's z, that have to be free
  double leastProbability = 0.5;      ///< of a pose that is picked; less likely ones do not stand in
                                      ///< the way either; one of unknown probability and score (0) is certain
  double mostTilt = 60.0;             ///< degrees between the way in and straight down
  double mostCovered = 20.0;          ///< % of the part, from above, that may lie under something
  double comfortableClearance = 10.0; ///< mm; more is no better
  double turnStep = 30.0;             ///< degrees between the turns that a free one is tried at
  double cupSlack = 2.0;              ///< mm that a cup gives way when it comes down on the part
  double partMargin = 1.0; ///< mm that the open gripper keeps from the part that it takes, but between its pads
  double tolerance = 0.0;  ///< mm: measured points so near to a copy or the bin are of it; 0: 3 times the noise and
                           ///< 1 % of the part's size, its box from corner to corner; at most 6 %
  double voxelSize = 0.0;  ///< mm, of what is measured besides; 0: 4 point distances, at least 1 % of the diameter

  // Shares of the part's size, the diagonal of its box.
  double toleranceOfPart = 0.01; ///< the tolerance without noise, and the smallest voxel
  double mostTolerance = 0.06;   ///< however noisy: farther away lies something else
  double surfaceSpacing = 0.03;  ///< of the points on the part that tell what lies at it and on it
  double mostOutside = 0.5;      ///< a grasp so far from the part is one of another part, or in another unit
  double noiseInTolerance = 3.0; ///< standard deviations: all but 3 of 1,000 points
  double pointsInVoxel = 4.0;    ///< point distances in the side of a voxel, so that a slanted surface has no holes
  double thinnedInVoxel = 2.0;   ///< of the points along that side so many are taken: more say no more
  int fewestInVoxel = 2;         ///< a point alone is none of a surface
};

/// Why a pick is not possible, in the order in which it is looked at.
enum class PickObstruction
{
  None,
  Uncertain,  ///< the pose is not likely enough
  Covered,    ///< something lies on the part
  WrongKind,  ///< the grasp is one of another kind of gripper
  TooWide,    ///< the part does not fit between the jaws
  Tilted,     ///< the gripper would come too slantwise, or from below
  PartItself, ///< the gripper collides with the part that it shall hold
  Bin,
  Instance, ///< another copy
  Measured  ///< something that was measured and is no known copy
};

/// One grasp of one copy.
struct Pick
{
  Eigen::Isometry3d T_scene_grasp = Eigen::Isometry3d::Identity(); ///< mm
  int pose = -1;                                                   ///< index of the copy among the poses
  int grasp = -1;                                                  ///< index among the grasps
  PickObstruction obstruction = PickObstruction::None;
  int obstacle = -1;      ///< index of the copy that is in the way, or -1
  double clearance = 0.0; ///< mm from all but the part, on the way in, up to what is comfortable
  double tilt = 0.0;      ///< degrees between the way in and straight down
  double reach = 0.0;     ///< mm from the bin's rim, or from the highest point measured, down to the grasp
  double covered = 0.0;   ///< [0, 1] of the part, from above
  double score = 0.0; ///< [0, 1]: probability, quality, share uncovered, share of the comfortable clearance, multiplied

  bool possible() const { return this->obstruction == PickObstruction::None; }
};

using Picks = std::vector<Pick>;

/// Why it is not possible, in words, poses counted from 1: "collides with instance 3".
std::string describe(const Pick& pick);
/// The same in a word or two, to stand in a picture: "pick 1" of one that is possible, by its rank.
std::string labelOf(const Pick& pick, int rank);

/// How many are possible, of how many copies, and what the others come to, in a sentence.
std::string describe(const Picks& picks);

/// Plans picks of one part with one gripper. A grasp is tried at all turns that are as good, those of the part's exact
/// symmetries and free ones, and comes back once: where it is possible and the clearance is largest.
class PickPlanner
{
public:
  /// Throws Error for an invalid mesh, gripper, grasp (among them one outside the part) or setting, and without a
  /// grasp.
  PickPlanner(const TriangleMesh& part, const Symmetries& symmetries, const Grasps& grasps, const Gripper& gripper,
    const PickSettings& settings = {});
  ~PickPlanner();

  /// A pick for each pose and each grasp, in mm of the scan's frame: those that are possible first, best first, then
  /// those first that come farthest in the order of reasons. Without a bin down is the way the sensor looks, z, and
  /// nothing is known of walls but what was measured. The scan may be without points: then only the copies and the bin
  /// are in the way. Throws Error for a pose that is not finite and a gripper that is wider than the bin.
  Picks plan(
    const Poses& poses, const OrganizedCloud& cloud, const std::optional<Bin>& bin = {}, const Progress& progress = {});

private:
  class Part;
  struct Surroundings;

  Surroundings surroundings(const Poses& poses, const OrganizedCloud& cloud, const std::optional<Bin>& bin);
  double coveredShare(const Pose& pose, int copy, const Surroundings& around) const;

  std::unique_ptr<Part> Known;
};
}
