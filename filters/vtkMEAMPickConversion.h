// SPDX-License-Identifier: BSD-3-Clause
/**
 * Picks as VTK's data objects. Not wrapped.
 */
#ifndef vtkMEAMPickConversion_h
#define vtkMEAMPickConversion_h

#include "pick/Bin.h"
#include "pick/PickPlanning.h"

class vtkPolyData;

namespace vtkMEAMConversion
{
/// Which picks a gripper is drawn at.
enum class ShownPicks
{
  BestOfEachCopy, ///< the best possible one; of a copy without one the first that is not
  Possible,
  All
};

/// A vertex for each pick, with the arrays that vtkMEAMPickPlanning documents.
void fromPicks(const meam::Picks& picks, const meam::Grasps& grasps, vtkPolyData* output);

/// The gripper at picks, with `Rank`, `Possible` and `Obstruction` for its cells.
void fromGrippers(const meam::Picks& picks, const meam::Grasps& grasps, const meam::Gripper& gripper, ShownPicks shown,
  vtkPolyData* output);

/// The floor and the walls.
void fromBin(const meam::Bin& bin, vtkPolyData* output);
}

#endif
