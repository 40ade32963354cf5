// SPDX-License-Identifier: BSD-3-Clause
// Grasps of a part from its faces, once, to be looked at and kept: propose_grasps part.meam part.stl part.grasps.json
#include <meam/picks.h>

#include <iostream>

int main(int argc, char** argv)
try
{
  if (argc != 4)
  {
    std::cerr << "usage: propose_grasps MODEL CAD GRASPS\n";
    return 2;
  }
  meam::GripperModel gripper; // that of pick.cpp
  gripper.opening = 60.0;
  gripper.fingerWidth = 8.0;
  gripper.fingerThickness = 5.0;
  meam::ProposeSettings settings;
  settings.maximumGrasps = 100; // among other parts few can be reached
  const meam::Grasps grasps = meam::proposeGrasps(meam::loadModel(argv[1]), meam::loadCAD(argv[2]), gripper, settings);
  meam::saveGrasps(argv[3], grasps);
  std::cout << grasps.size() << " grasps\n";
}
catch (const meam::Error& error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
