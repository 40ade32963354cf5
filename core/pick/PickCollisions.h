// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "pick/Bin.h"
#include "pick/Gripper.h"

#include <memory>
#include <vector>

namespace meam
{
/// What a gripper comes near to.
enum class Obstacle
{
  None,
  Bin,
  Instance, ///< a copy of the part
  Measured  ///< what the sensor measured and neither the bin nor a copy explains
};

struct Clearance
{
  double distance = 0.0; ///< mm to the nearest obstacle; 0: they collide
  Obstacle obstacle = Obstacle::None;
  int instance = -1; ///< of the copy
};

/// Distances of a gripper from a bin, copies of a part and measured points (FCL; the points as an octree).
class PickCollisions
{
public:
  /// Throws Error for a mesh without faces, an invalid vertex or index, and for a gripper that is none.
  PickCollisions(const TriangleMesh& part, const Gripper& gripper);
  ~PickCollisions();

  /// What lies around, scene coordinates, mm. Each replaces what was there.
  void setBin(const Bin* bin);
  void setInstances(const std::vector<Eigen::Isometry3d>& poses);
  /// Copies of several parts: of each pose the collisions that were made of its part.
  void setInstances(const std::vector<Eigen::Isometry3d>& poses, const std::vector<const PickCollisions*>& parts);
  /// A cube of side `voxelSize` (mm) about every place where at least `fewest` of the points lie.
  void setMeasured(const Points& points, double voxelSize, int fewest);

  /// The gripper on its way in, `wayIn` mm long, to a grasp at T_scene_grasp, and what comes between its jaws. The copy
  /// `held` is no obstacle. Distances over `most` mm are not told apart: it is what comes back then. Of a gripper by
  /// its lengths the way is all the room that it takes; a mesh is looked at every `step` mm.
  Clearance clearance(
    const Grasp& grasp, const Eigen::Isometry3d& T_scene_grasp, int held, double wayIn, double most, double step) const;

  /// Whether the open gripper touches the part that it holds, on its way in.
  bool touchesHeld(const Grasp& grasp, double wayIn, double step) const;

  /// The copies that are between the jaws, or within `slack` mm of the cup's rim, at a grasp at T_scene_grasp.
  std::vector<int> heldBy(const Grasp& grasp, const Eigen::Isometry3d& T_scene_grasp, double slack) const;

private:
  struct World;
  std::unique_ptr<World> Objects;
};
}
