// SPDX-License-Identifier: BSD-3-Clause
/// Where a gripper takes which of the parts that were found, and why not elsewhere.
///
///     const meam::Mesh part = meam::loadMesh("part.stl");            // in mm, as the model was trained with it
///     const meam::Picker picker(model, part, meam::loadGrasps("part.grasps.json"), gripper);   // once for each part
///     const meam::PickPlan plan = picker.plan(meam::detect(model, scan), scan);                // of each scan
///     if (!plan.picks.empty() && plan.picks.front().possible) ...
///
/// Of several types of part meam::Picker::planAll({ picker, another }, found, scan).
#pragma once

#include "meam.h"
#include "pick/PickTypes.h" // Grasp, Grasps, GripperLengths, Bin, PlanSettings, ProposeSettings

namespace meam
{
class PickPlanner;

// -------------------------------------------------------------------------------------------------------------- picks
// Library meam::pick; nothing under the GPL in it.

/// A gripper by its lengths, or any, as it stands open around the part, in the grasp's frame: its mesh, when it has
/// faces, takes the place of the jaws or the cup.
struct GripperModel : GripperLengths
{
  Mesh mesh; ///< mm
};

/// Where the bin and the robot are.
struct Workplace
{
  bool hasBin = true;     ///< false: down is the way the sensor looks, and walls are what was measured of them
  std::optional<Bin> bin; ///< none: it is found in the scan, by its rim
  std::optional<Eigen::Isometry3d> T_robot_camera; ///< mm; takes the scan's points to the robot's frame
};

/// One grasp of one copy.
struct PlannedPick
{
  bool possible = false;
  std::string reason; ///< what is against it, in words; empty: nothing
  /// mm; where the gripper stands when it holds the part: z the way in, along x the jaws close.
  Eigen::Isometry3d T_scan_grasp = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> T_robot_grasp; ///< the same in the robot's frame, with a Workplace::T_robot_camera
  int instance = -1;                              ///< index among the poses that were found
  int part = 0;                                   ///< index of its type, as DetectedPose has it
  int grasp = -1;                                 ///< index among the grasps of its type
  std::string graspName;
  double width = 0.0;     ///< mm, of the part between the jaws
  double clearance = 0.0; ///< mm from all but the part, on the way in; up to 10, or the safety margin
  double reach = 0.0;     ///< mm from the bin's rim, or from the highest point measured, down to the grasp
  double tilt = 0.0;      ///< degrees between the way in and straight down
  double covered = 0.0;   ///< [0, 1] of the part, from above
  double score = 0.0;     ///< [0, 1], by which possible picks are ordered
};

struct PickPlan
{
  std::vector<PlannedPick> picks; ///< of each copy and each grasp one: the possible ones first, best first
  std::string report;             ///< how many copies can be picked, and what is against the others, in a sentence
  std::string advice;             ///< what to change for the others; empty: all can be picked
  std::optional<Bin> bin;         ///< that was given or found
  double seconds = 0.0;
};

/// Plans picks of one part with one gripper.
class MEAM_EXPORT Picker
{
public:
  /// `part`: the mesh that the model was trained with, in mm; the model tells its symmetries, and an empty one none.
  /// Throws Error for an invalid mesh, gripper, grasp or setting, a mesh that is not as large as the model's part, and
  /// without a grasp.
  Picker(const Model& model, const Mesh& part, const Grasps& grasps, const GripperModel& gripper,
    const PlanSettings& settings = {});

  /// The scan may be without points when the bin is given, or when there is none: then only the other copies and the
  /// bin are in the way. One call at a time. Throws Error for a pose that is not finite, poses of several types of
  /// part, a bin that is not found, and a gripper that does not go into it.
  PickPlan plan(
    const Detections& found, const Scan& scan, const Workplace& place = {}, const Progress& progress = {}) const;

  /// The same of several types of part, with a picker of each, in the order of the models of detect(): copies of all
  /// types are in the way, and the picks of all are in one order. Throws Error for another number of pickers, too.
  static PickPlan planAll(const std::vector<Picker>& pickers, const Detections& found, const Scan& scan,
    const Workplace& place = {}, const Progress& progress = {});

private:
  std::shared_ptr<PickPlanner> Planner;
  std::vector<Grasp> Given;
};

/// The faces of a gripper as it stands open at a grasp, in the grasp's frame, mm, to look at. Throws Error, with its
/// name, for a length that is not positive, and for an invalid mesh.
MEAM_EXPORT Mesh gripperMesh(const GripperModel& gripper, const Grasp& grasp);

/// Finds an open rectangular bin in an organized scan from above, by its rim; for cells whose bin stays where it is.
MEAM_EXPORT Bin detectBin(const Scan& scan, const Progress& progress = {});

/// A grasp by a point between the tips of the jaws or in the middle of the cup's rim, mm, the way in and, of jaws, the
/// direction in which they close; directions of any length, closing is made perpendicular to the way in.
MEAM_EXPORT Grasp graspAt(GraspKind kind, const Eigen::Vector3d& position, const Eigen::Vector3d& approach,
  const Eigen::Vector3d& closing = Eigen::Vector3d::Zero(), double width = 0.0);

/// Reads the grasps of a part, NAME.grasps.json by custom.
MEAM_EXPORT Grasps loadGrasps(const std::string& path);

/// Writes such a file, whole or not at all.
MEAM_EXPORT void saveGrasps(const std::string& path, const Grasps& grasps);

/// Reads T_robot_camera, mm, from a file of ppfmeam hand-eye, OpenCV or ROS.
MEAM_EXPORT Eigen::Isometry3d loadRobotFrame(const std::string& path);

// ---------------------------------------------------------------------------------------------------------- proposals
// Library meam::train, with CGAL, which is under the GPL.

/// Grasps from the part's faces, spread over it, best first, for the jaws or the cup that the gripper has. `part` in
/// mm, as the model was trained with it; of grasps that its symmetries make equal one comes out. An empty model has no
/// symmetries.
MEAM_EXPORT Grasps proposeGrasps(const Model& model, const Mesh& part, const GripperModel& gripper,
  const ProposeSettings& settings = {}, const Progress& progress = {});
}
