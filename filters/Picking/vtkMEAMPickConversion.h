// SPDX-License-Identifier: BSD-3-Clause
/**
 * Picks as VTK's data objects. Not wrapped.
 */
#ifndef vtkMEAMPickConversion_h
#define vtkMEAMPickConversion_h

#include "pick/Bin.h"
#include "pick/PickPlanning.h"

#include <functional>
#include <optional>
#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace vtkMEAMConversion
{
/// Which picks a gripper is drawn at.
enum class ShownPicks
{
  BestOfEachCopy, ///< the best possible one; of a copy without one the first that is not, where the pose is shown
  Possible,
  All
};

/// Which grasp a pick is of.
using GraspOf = std::function<const meam::Grasp&(const meam::Pick&)>;

/// Whether each of the picks gets a gripper. A pose is not shown where its `Label` is empty.
std::vector<bool> drawnPicks(const meam::Picks& picks, ShownPicks shown, vtkPolyData* poses);

/// A vertex for each pick, with the arrays that vtkMEAMPickPlanning documents; `Label` is empty where no gripper is
/// drawn.
void fromPicks(const meam::Picks& picks, const GraspOf& graspOf, const std::vector<bool>& drawn, vtkPolyData* output);

/// Of several types of part the array `PartId`; `parts`: of each pose its type.
void addParts(const meam::Picks& picks, const std::vector<int>& parts, vtkPolyData* output);

/// The picks' frames in another frame, such as a robot's, in which the scene's lies at `frame`: as a point array of 16
/// components, row-major.
void addInFrame(const meam::Picks& picks, const meam::Pose& frame, const char* name, vtkPolyData* output);

/// The gripper at the picks that get one, with `Rank`, `Possible` and `Obstruction` for its cells: whole at the pick of
/// that rank, at all where it is 0, and as thin lines at the others.
void fromGrippers(const meam::Picks& picks, const GraspOf& graspOf, const meam::Gripper& gripper,
  const std::vector<bool>& drawn, int whole, vtkPolyData* output);

/// The floor and the walls, to look at.
void fromBin(const meam::Bin& bin, vtkPolyData* output);

/// What picks were planned with travels with them as field data: `Bin` (20: the frame, row-major, inner length, inner
/// width and height, wall) and `Gripper` (11, named: kind and lengths). None when it is not there.
void setBin(vtkDataObject* output, const meam::Bin& bin);
std::optional<meam::Bin> binOf(vtkDataObject* input);
void setGripper(vtkDataObject* output, const meam::Gripper& gripper);
std::optional<meam::Gripper> gripperOf(vtkDataObject* input);

/// Whether each of the picks, which toGrasps() reads as grasps in the scene, is possible; all where `Possible` is not
/// there.
std::vector<bool> possiblePicks(vtkPolyData* input);
}

#endif
