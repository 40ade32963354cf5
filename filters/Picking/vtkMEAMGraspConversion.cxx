// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMGraspConversion.h"

#include "base/Error.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMMeshConversion.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <string>

namespace vtkMEAMConversion
{
namespace
{
/// The value of an array that stands for one of `count` choices; the first where there is no array.
template <typename Choice>
Choice choiceIn(vtkDataArray* array, vtkIdType place, int count, const std::string& grasp)
{
  const double value = array ? array->GetComponent(place, 0) : 0.0;
  for (int choice = 0; choice < count; ++choice)
  {
    if (value == choice)
    {
      return static_cast<Choice>(choice);
    }
  }
  throw meam::Error("The grasp '" + grasp + "' has a value of " + quoted(array->GetName()) + " that is not 0 to " +
                    std::to_string(count - 1) + ".");
}

/// The gripper without its body: only what joins the fingers, or holds the cup.
meam::Gripper glyphOf(const meam::Gripper& gripper, const meam::Grasp& grasp)
{
  meam::Gripper glyph = gripper;
  glyph.mesh = {};
  glyph.kind = grasp.kind;
  glyph.bodyLength = gripper.fingerThickness;
  glyph.bodyWidth = grasp.kind == meam::GraspKind::Suction ? 0.5 * gripper.cupDiameter : gripper.fingerWidth;
  glyph.opening = grasp.width + 2.0 * gripper.jawClearance;
  return glyph;
}
}

meam::Grasps toGrasps(vtkPolyData* input)
{
  meam::Grasps grasps;
  const vtkIdType count = input->GetNumberOfPoints();
  if (count == 0)
  {
    return grasps;
  }
  vtkDataArray* transforms = pointArray(input, "Transform", 16);
  if (!transforms)
  {
    throw meam::Error(
      "The grasps have no point array 'Transform' of 16 components: use the output of GraspDefinition.");
  }
  vtkDataArray* kinds = pointArray(input, "Kind", 1);
  vtkDataArray* widths = pointArray(input, "Width", 1);
  vtkDataArray* turns = pointArray(input, "FreeTurn", 1);
  vtkDataArray* qualities = pointArray(input, "Quality", 1);
  auto* names = vtkStringArray::SafeDownCast(input->GetPointData()->GetAbstractArray("GraspName"));
  for (vtkIdType i = 0; i < count; ++i)
  {
    meam::Grasp grasp;
    grasp.name =
      names && i < names->GetNumberOfValues() ? std::string(names->GetValue(i)) : "grasp " + std::to_string(i + 1);
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix;
    transforms->GetTuple(i, matrix.data());
    grasp.T_model_grasp.matrix() = matrix;
    grasp.kind = choiceIn<meam::GraspKind>(kinds, i, 2, grasp.name);
    grasp.freeTurn = choiceIn<meam::FreeTurn>(turns, i, 3, grasp.name);
    grasp.width = widths ? widths->GetComponent(i, 0) : grasp.width;
    grasp.quality = qualities ? qualities->GetComponent(i, 0) : grasp.quality;
    meam::requireGrasp(grasp);
    grasps.push_back(grasp);
  }
  return grasps;
}

void fromGrasps(const meam::Grasps& grasps, vtkPolyData* output)
{
  using meam::Grasp;
  setFrames(grasps, &Grasp::T_model_grasp, output);
  vtkPointData* arrays = output->GetPointData();
  arrays->AddArray(columnOf<vtkIntArray>("Kind", grasps, &Grasp::kind));
  arrays->AddArray(columnOf<vtkDoubleArray>("Width", grasps, &Grasp::width));
  arrays->AddArray(columnOf<vtkIntArray>("FreeTurn", grasps, &Grasp::freeTurn));
  arrays->AddArray(columnOf<vtkDoubleArray>("Quality", grasps, &Grasp::quality));
  arrays->AddArray(columnOf<vtkStringArray>("GraspName", grasps, &Grasp::name));
  arrays->SetActiveScalars("Quality");
}

void fromGraspGlyphs(const meam::Grasps& grasps, const meam::Gripper& gripper, vtkPolyData* output)
{
  meam::TriangleMesh all;
  std::vector<int> graspOf; // of each triangle
  for (std::size_t k = 0; k < grasps.size(); ++k)
  {
    const meam::TriangleMesh glyph = meam::meshOf(glyphOf(gripper, grasps[k]), grasps[k]);
    const auto first = Eigen::Vector3i::Constant(static_cast<int>(all.vertices.size()));
    for (const auto& vertex : glyph.vertices)
    {
      all.vertices.push_back((grasps[k].T_model_grasp * vertex.cast<double>()).cast<float>());
    }
    for (const auto& triangle : glyph.triangles)
    {
      all.triangles.push_back(triangle + first);
      graspOf.push_back(static_cast<int>(k));
    }
  }
  fromMesh(all, output);
  vtkCellData* arrays = output->GetCellData();
  arrays->AddArray(columnOf<vtkIntArray>("Kind", graspOf, [&](int k) { return grasps[k].kind; }));
  arrays->AddArray(columnOf<vtkIntArray>("Grasp", graspOf, [](int k) { return k + 1; }));
  arrays->SetScalars(columnOf<vtkDoubleArray>("Quality", graspOf, [&](int k) { return grasps[k].quality; }));
}
}
