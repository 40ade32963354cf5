// SPDX-License-Identifier: BSD-3-Clause
// The same in a cell, with the model that was saved: cell part.meam scan.pcd
#include <meam/meam.h>

#include <iostream>

int main(int argc, char** argv)
try
{
  if (argc != 3)
  {
    std::cerr << "usage: cell MODEL SCAN\n";
    return 2;
  }
  meam::DetectSettings settings;
  settings.maximumPoses = 0; // all that are likely
  settings.minimumProbability = 0.5;
  for (const meam::DetectedPose& pose : meam::detect(meam::loadModel(argv[1]), meam::loadScan(argv[2]), settings).poses)
  {
    std::cout << "probability " << pose.placeProbability << '\n' << pose.T_scan_part.matrix() << '\n';
  }
}
catch (const meam::Error& error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
