// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPickConversion.h"

#include "vtkMEAMArrays.h"
#include "vtkMEAMMeshConversion.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <array>
#include <set>
#include <utility>

namespace vtkMEAMConversion
{
namespace
{
using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr int BinNumbers = 20; // 16 of the frame, 3 of the size, the wall

struct GripperLength
{
  const char* name;
  double meam::Gripper::*length;
};
constexpr std::array<GripperLength, 10> GripperLengths{ { { "Opening", &meam::Gripper::opening },
  { "JawClearance", &meam::Gripper::jawClearance }, { "FingerWidth", &meam::Gripper::fingerWidth },
  { "FingerThickness", &meam::Gripper::fingerThickness }, { "FingerLength", &meam::Gripper::fingerLength },
  { "TipLength", &meam::Gripper::tipLength }, { "BodyLength", &meam::Gripper::bodyLength },
  { "BodyWidth", &meam::Gripper::bodyWidth }, { "CupDiameter", &meam::Gripper::cupDiameter },
  { "CupLength", &meam::Gripper::cupLength } } };

/// A gripper that leaves the parts in sight: jaws and what joins them, or the rim of a cup and what holds it.
meam::Gripper linesOf(const meam::Gripper& gripper, const meam::Grasp& grasp)
{
  constexpr double Thickness = 0.03; // of the length of a finger or a cup
  const bool isCup = grasp.kind == meam::GraspKind::Suction;
  const double thin = Thickness * (isCup ? gripper.cupLength : gripper.fingerLength);
  meam::Gripper lines = gripper;
  lines.mesh = {};
  lines.kind = grasp.kind;
  lines.opening = grasp.width + 2.0 * gripper.jawClearance;
  lines.fingerWidth = lines.fingerThickness = lines.bodyWidth = lines.cupLength = thin;
  lines.bodyLength = isCup ? gripper.cupLength : thin;
  return lines;
}

/// Faces one after the other, with a value of each array for all cells of a piece.
class Pieces
{
public:
  explicit Pieces(std::vector<const char*> names)
    : Names(std::move(names))
    , Values(this->Names.size())
  {
  }

  void add(const meam::TriangleMesh& piece, const Eigen::Isometry3d& place, const std::vector<int>& values)
  {
    const int first = static_cast<int>(this->Mesh.vertices.size());
    for (const auto& vertex : piece.vertices)
    {
      this->Mesh.vertices.push_back((place * vertex.cast<double>()).cast<float>());
    }
    for (const auto& triangle : piece.triangles)
    {
      this->Mesh.triangles.push_back(triangle + Eigen::Vector3i::Constant(first));
      for (std::size_t k = 0; k < values.size(); ++k)
      {
        this->Values[k].push_back(values[k]);
      }
    }
  }

  void write(vtkPolyData* output) const
  {
    fromMesh(this->Mesh, output);
    for (std::size_t k = 0; k < this->Names.size(); ++k)
    {
      output->GetCellData()->AddArray(arrayOf<vtkIntArray>(this->Names[k], this->Values[k]));
    }
    if (!this->Names.empty())
    {
      output->GetCellData()->SetActiveScalars(this->Names.front());
    }
  }

private:
  std::vector<const char*> Names;
  std::vector<std::vector<int>> Values;
  meam::TriangleMesh Mesh;
};
}

std::vector<bool> drawnPicks(const meam::Picks& picks, ShownPicks shown, vtkPolyData* poses)
{
  auto* labels = vtkStringArray::SafeDownCast(poses->GetPointData()->GetAbstractArray("Label"));
  const auto isShown = [&](int pose) { return !labels || !labels->GetValue(pose).empty(); };
  std::vector<bool> drawn;
  std::set<int> done; // copies that have one
  for (const meam::Pick& pick : picks)
  {
    drawn.push_back(shown == ShownPicks::All || (shown == ShownPicks::Possible && pick.possible()) ||
                    (shown == ShownPicks::BestOfEachCopy && (pick.possible() || isShown(pick.pose)) &&
                      done.insert(pick.pose).second));
  }
  return drawn;
}

void fromPicks(const meam::Picks& picks, const GraspOf& graspOf, const std::vector<bool>& drawn, vtkPolyData* output)
{
  using meam::Pick;
  setFrames(picks, &Pick::T_scene_grasp, output);
  vtkPointData* arrays = output->GetPointData();
  std::vector<double> quaternions;
  std::vector<std::string> labels; // of those that get a gripper the rank, or in a word why the pick is not possible
  for (std::size_t k = 0; k < picks.size(); ++k)
  {
    const Eigen::Quaterniond turn(picks[k].T_scene_grasp.linear());
    quaternions.insert(quaternions.end(), turn.coeffs().data(), turn.coeffs().data() + 4);
    labels.push_back(drawn[k] ? meam::labelOf(picks[k], static_cast<int>(k) + 1) : "");
  }
  const auto integers = [&](const char* name, auto&& valueOf)
  { arrays->AddArray(columnOf<vtkIntArray>(name, picks, valueOf)); };
  const auto numbers = [&](const char* name, auto&& valueOf)
  { arrays->AddArray(columnOf<vtkDoubleArray>(name, picks, valueOf)); };
  const auto texts = [&](const char* name, auto&& valueOf)
  { arrays->AddArray(columnOf<vtkStringArray>(name, picks, valueOf)); };
  arrays->AddArray(arrayOf<vtkDoubleArray>("Quaternion", quaternions, 4));
  integers("Rank", [rank = 0](const Pick&) mutable { return ++rank; });
  integers("Possible", &Pick::possible);
  integers("Obstruction", &Pick::obstruction);
  texts("Reason", [](const Pick& pick) { return meam::describe(pick); });
  arrays->AddArray(arrayOf<vtkStringArray>("Label", labels));
  integers("Instance", [](const Pick& pick) { return pick.pose + 1; });
  integers("Grasp", [](const Pick& pick) { return pick.grasp + 1; });
  texts("GraspName", [&](const Pick& pick) { return graspOf(pick).name; });
  integers("Kind", [&](const Pick& pick) { return graspOf(pick).kind; });
  numbers("Width", [&](const Pick& pick) { return graspOf(pick).width; });
  integers("Obstacle", [](const Pick& pick) { return pick.obstacle + 1; });
  numbers("Clearance", &Pick::clearance);
  numbers("Reach", &Pick::reach);
  numbers("Tilt", &Pick::tilt);
  numbers("Covered", &Pick::covered);
  numbers("Score", &Pick::score);
  arrays->SetActiveScalars("Possible");
}

void addParts(const meam::Picks& picks, const std::vector<int>& parts, vtkPolyData* output)
{
  output->GetPointData()->AddArray(
    columnOf<vtkIntArray>("PartId", picks, [&](const meam::Pick& pick) { return parts[pick.pose]; }));
}

void addInFrame(const meam::Picks& picks, const meam::Pose& frame, const char* name, vtkPolyData* output)
{
  output->GetPointData()->AddArray(
    framesOf(name, picks, [&](const meam::Pick& pick) { return frame.T_scene_model * pick.T_scene_grasp; }));
}

void fromGrippers(const meam::Picks& picks, const GraspOf& graspOf, const meam::Gripper& gripper,
  const std::vector<bool>& drawn, int whole, vtkPolyData* output)
{
  Pieces pieces({ "Possible", "Rank", "Obstruction" });
  for (std::size_t k = 0; k < picks.size(); ++k)
  {
    const meam::Pick& pick = picks[k];
    const int rank = static_cast<int>(k) + 1;
    if (drawn[k])
    {
      const meam::Grasp& grasp = graspOf(pick);
      const bool isWhole = whole == 0 || whole == rank;
      pieces.add(meam::meshOf(isWhole ? gripper : linesOf(gripper, grasp), grasp), pick.T_scene_grasp,
        { pick.possible() ? 1 : 0, rank, static_cast<int>(pick.obstruction) });
    }
  }
  pieces.write(output);
}

void fromBin(const meam::Bin& bin, vtkPolyData* output)
{
  Pieces pieces({});
  for (const meam::PlacedBox& box : meam::boxesOf(bin))
  {
    pieces.add(meam::meshOf(meam::GripperPiece{ false, Eigen::Vector3d::Zero(), box.size }), box.T_scene_box, {});
  }
  pieces.write(output);
}

void setBin(vtkDataObject* output, const meam::Bin& bin)
{
  double values[BinNumbers];
  Eigen::Map<RowMajor>{ values } = bin.T_scene_bin.matrix();
  Eigen::Map<Eigen::Vector3d>{ values + 16 } = bin.size;
  values[19] = bin.wall;
  output->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>("Bin", values, BinNumbers));
}

std::optional<meam::Bin> binOf(vtkDataObject* input)
{
  vtkDataArray* array = input->GetFieldData()->GetArray("Bin");
  if (!array || array->GetNumberOfComponents() != BinNumbers || array->GetNumberOfTuples() < 1)
  {
    return {};
  }
  double values[BinNumbers];
  array->GetTuple(0, values);
  meam::Bin bin;
  bin.T_scene_bin.matrix() = Eigen::Map<const RowMajor>(values);
  bin.size = Eigen::Map<const Eigen::Vector3d>(values + 16);
  bin.wall = values[19];
  meam::requireBin(bin);
  return bin;
}

void setGripper(vtkDataObject* output, const meam::Gripper& gripper)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Gripper");
  array->SetNumberOfComponents(1 + static_cast<int>(GripperLengths.size()));
  array->SetNumberOfTuples(1);
  array->SetComponentName(0, "Kind");
  array->SetComponent(0, 0, static_cast<int>(gripper.kind));
  for (std::size_t k = 0; k < GripperLengths.size(); ++k)
  {
    const int component = static_cast<int>(k) + 1;
    array->SetComponentName(component, GripperLengths[k].name);
    array->SetComponent(0, component, gripper.*GripperLengths[k].length);
  }
  output->GetFieldData()->AddArray(array);
}

std::optional<meam::Gripper> gripperOf(vtkDataObject* input)
{
  vtkDataArray* array = input->GetFieldData()->GetArray("Gripper");
  if (!array || array->GetNumberOfComponents() != 1 + static_cast<int>(GripperLengths.size()) ||
      array->GetNumberOfTuples() < 1)
  {
    return {};
  }
  meam::Gripper gripper;
  gripper.kind = array->GetComponent(0, 0) > 0.5 ? meam::GraspKind::Suction : meam::GraspKind::Parallel;
  for (std::size_t k = 0; k < GripperLengths.size(); ++k)
  {
    gripper.*GripperLengths[k].length = array->GetComponent(0, static_cast<int>(k) + 1);
  }
  return gripper;
}

std::vector<bool> possiblePicks(vtkPolyData* input)
{
  std::vector<bool> possible;
  vtkDataArray* array = pointArray(input, "Possible", 1);
  for (vtkIdType k = 0; k < input->GetNumberOfPoints(); ++k)
  {
    possible.push_back(!array || wholeIn(array, k) != 0);
  }
  return possible;
}
}
