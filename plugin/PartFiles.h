// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

/// What the page New Part asks for. File names that are empty: there is none.
struct PartFiles
{
  enum Gripper
  {
    NoGripper,
    Jaws,
    Cup
  };

  QString cad, scan;
  int solid = 0;                                   ///< of a CAD file with several, from 1; 0: all together
  double cadScale = 1.0;                           ///< brings the lengths of a mesh to mm
  double scanScale = 1.0;                          ///< brings the scan's lengths to mm
  QString calibration;                             ///< of the sensor
  QString image;                                   ///< with a pixel for each of the scan's
  Gripper gripper = NoGripper;                     // what follows is of a gripper alone
  double gripperSize = 0.0;                        ///< mm, the opening of jaws or the diameter of a cup
  double fingerWidth = 0.0, fingerThickness = 0.0; ///< mm, of jaws
  bool hasBin = true;
  QString robotFrame;
  QString folder; ///< that is written to

  QString name() const;      ///< of the part, as programs may be called
  bool hasSolids() const;    ///< the CAD file: STEP or IGES
  bool isDepthImage() const; ///< the scan
  const char* reader() const; ///< of the scan, the source's name; null for a file that is none
  QString modelFile() const;
  QString graspFile() const;
};
