// SPDX-License-Identifier: BSD-3-Clause
// Where a gripper takes the parts that are found: pick part.meam part.stl part.grasps.json scan.pcd [robot.json]
#include <meam/picks.h>

#include <iostream>

int main(int argc, char** argv)
try
{
  if (argc != 5 && argc != 6)
  {
    std::cerr << "usage: pick MODEL CAD GRASPS SCAN [ROBOT_FRAME]\n";
    return 2;
  }
  const meam::Model model = meam::loadModel(argv[1]);
  meam::GripperModel gripper; // two jaws; lengths in mm
  gripper.opening = 60.0;
  gripper.fingerWidth = 8.0;
  gripper.fingerThickness = 5.0;
  const meam::Picker picker(model, meam::loadMesh(argv[2]), meam::loadGrasps(argv[3]), gripper); // once for each part

  meam::Workplace place; // the bin is found in the scan, by its rim
  if (argc == 6)
  {
    place.T_robot_camera = meam::loadRobotFrame(argv[5]);
  }
  const meam::Scan scan = meam::loadScan(argv[4]);
  meam::DetectSettings settings;
  settings.maximumPoses = 0; // what is not picked stands in the way
  settings.minimumProbability = 0.5;
  const meam::PickPlan plan = picker.plan(meam::detect(model, scan, settings), scan, place);
  std::cerr << plan.report << ' ' << plan.advice << '\n';
  for (const meam::PlannedPick& pick : plan.picks)
  {
    if (pick.possible)
    {
      std::cout << "copy " << pick.instance << ", " << pick.graspName << ", clearance " << pick.clearance << " mm\n"
                << (pick.T_robot_grasp ? *pick.T_robot_grasp : pick.T_scan_grasp).matrix() << '\n';
    }
  }
}
catch (const meam::Error& error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
