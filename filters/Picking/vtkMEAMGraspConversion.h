// SPDX-License-Identifier: BSD-3-Clause
/**
 * Grasps between VTK's data objects and the core. Not wrapped.
 */
#ifndef vtkMEAMGraspConversion_h
#define vtkMEAMGraspConversion_h

#include "pick/Grasp.h"
#include "pick/Gripper.h"

class vtkPolyData;

namespace vtkMEAMConversion
{
/// One vertex for each grasp at its origin, with the point arrays `Transform` (16, row-major T_model_grasp), `Kind` (0
/// jaws, 1 a cup), `Width` (mm), `FreeTurn` (0 none, 1 about the approach, 2 about the closing direction), `Quality`
/// ([0, 1]) and `GraspName` (text). Where one but the first is not there, its values are the defaults of a Grasp, names
/// "grasp 1" and so on; no points are no grasps. Throws Error, naming the grasp, for one that requireGrasp refuses, and
/// for points without `Transform`.
meam::Grasps toGrasps(vtkPolyData* input);
void fromGrasps(const meam::Grasps& grasps, vtkPolyData* output);

/// Jaws or a cup at each grasp, to look at, without the gripper's body; `Quality`, `Kind` and `Grasp` (from 1) for
/// their cells.
void fromGraspGlyphs(const meam::Grasps& grasps, const meam::Gripper& gripper, vtkPolyData* output);
}

#endif
