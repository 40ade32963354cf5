// SPDX-License-Identifier: BSD-3-Clause
// Finds the copies of a part in a scan: find_parts part.step scan.pcd part.meam
#include <meam/meam.h>

#include <iostream>

int main(int argc, char** argv)
try
{
  if (argc != 4)
  {
    std::cerr << "usage: find_parts CAD SCAN MODEL\n";
    return 2;
  }
  meam::train(meam::loadCAD(argv[1])).save(argv[3]); // once for each part
  const meam::Model model = meam::loadModel(argv[3]);
  for (const meam::DetectedPose& pose : meam::detect(model, meam::loadScan(argv[2])).poses)
  {
    std::cout << "probability " << pose.placeProbability << '\n' << pose.T_scan_part.matrix() << '\n';
  }
}
catch (const meam::Error& error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
