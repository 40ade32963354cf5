// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMGraspDefinition.h"

#include "base/Bounds.h"
#include "base/Range.h"
#include "pick/GraspProposal.h"
#include "pick/io/GraspFile.h"
#include "pick/proposal/GraspFitting.h"
#include "vtkMEAMGraspConversion.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSettings.h"
#include "vtkMEAMSymmetryConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <set>
#include <string>

vtkStandardNewMacro(vtkMEAMGraspDefinition);

namespace
{
constexpr const char* HandName = "by hand";

/// Names of their own, as files need them: a second one gets a number.
void makeNamesUnique(meam::Grasps& grasps)
{
  std::set<std::string> taken;
  for (meam::Grasp& grasp : grasps)
  {
    const std::string name = grasp.name;
    for (int k = 2; !taken.insert(grasp.name).second; ++k)
    {
      grasp.name = name + " (" + std::to_string(k) + ")";
    }
  }
}
}

vtkMEAMGraspDefinition::vtkMEAMGraspDefinition()
  : Settings(std::make_unique<meam::ProposeSettings>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
}

vtkMEAMGraspDefinition::~vtkMEAMGraspDefinition() { this->SetFileName(nullptr); }

int vtkMEAMGraspDefinition::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* type = port == 1 ? "vtkDataObject" : "vtkPolyData";
  return vtkMEAMConversion::fillInputPort(info, { type }, vtkMEAMConversion::Connections::OneOrNone);
}

int vtkMEAMGraspDefinition::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

vtkMEAMSettingMacro(vtkMEAMGraspDefinition, MaximumNumberOfGrasps, int, maximumGrasps);
vtkMEAMSettingMacro(vtkMEAMGraspDefinition, FrictionAngle, double, frictionAngle);
vtkMEAMSettingMacro(vtkMEAMGraspDefinition, Spread, double, spread);

meam::Grasp vtkMEAMGraspDefinition::LaidByHand() const
{
  meam::Grasp grasp;
  grasp.name = HandName;
  grasp.kind = this->HandGrasp == HandCup ? meam::GraspKind::Suction : meam::GraspKind::Parallel;
  grasp.freeTurn = this->HandGrasp == HandCup ? meam::FreeTurn::Approach : meam::FreeTurn::None;
  grasp.width = this->HandGrasp == HandCup ? 0.0 : this->HandWidth;
  grasp.T_model_grasp = vtkMEAMConversion::placedAt(this->HandPosition, this->HandRotation).T_scene_model;
  return grasp;
}

int vtkMEAMGraspDefinition::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* part = vtkPolyData::GetData(inputVector[0]);
  vtkDataObject* symmetric = vtkDataObject::GetData(inputVector[1]);
  auto* gripperMesh = vtkPolyData::GetData(inputVector[2]);
  auto* output = vtkPolyData::GetData(outputVector, 0);
  auto* glyphs = vtkPolyData::GetData(outputVector, 1);
  return vtkMEAMRun(
    this,
    [&]
    {
      requireInputs(this, { "Part", nullptr, nullptr });
      const meam::TriangleMesh mesh = toMesh(part);
      meam::requireMesh(mesh);
      const meam::Symmetries symmetries = symmetriesOf(symmetric ? symmetric : part);
      meam::Gripper gripper = *this->Lengths;
      gripper.mesh = gripperMesh ? toMesh(gripperMesh) : meam::TriangleMesh();
      meam::Grasps grasps;
      if (this->FileName && *this->FileName)
      {
        grasps = meam::readGrasps(this->FileName);
      }
      if (this->HandGrasp != NoHandGrasp)
      {
        const double start = meam::bounds(mesh.vertices).diagonal().norm();
        const meam::Grasp grasp = this->LaidByHand();
        meam::requireWithin("hand width", grasp.width, 0.0, meam::Unbounded, " mm");
        grasps.push_back(grasp.width > 0.0 ? grasp : meam::fitGrasp(meam::MeshRays(mesh), grasp, gripper, start));
      }
      const meam::Progress progress = progressOf(this);
      const auto propose = [&](meam::GraspKind kind, double from, double to)
      {
        gripper.kind = kind;
        const meam::Grasps found =
          meam::proposeGrasps(mesh, symmetries, gripper, *this->Settings, meam::subProgress(progress, from, to));
        grasps.insert(grasps.end(), found.begin(), found.end());
      };
      const bool both = this->Propose == Both;
      if (both || this->Propose == ParallelJaws)
      {
        propose(meam::GraspKind::Parallel, 0.0, both ? 0.8 : 1.0);
      }
      if (both || this->Propose == Suction)
      {
        propose(meam::GraspKind::Suction, both ? 0.8 : 0.0, 1.0);
      }
      makeNamesUnique(grasps);
      fromGrasps(grasps, output);
      setSymmetries(output, symmetries);
      fromGraspGlyphs(grasps, gripper, glyphs);
    },
    output, glyphs);
}

void vtkMEAMGraspDefinition::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Propose: " << this->Propose << "\n";
  os << indent << "MaximumNumberOfGrasps: " << this->Settings->maximumGrasps << "\n";
  os << indent << "FrictionAngle: " << this->Settings->frictionAngle << "\n";
  os << indent << "Spread: " << this->Settings->spread << "\n";
  os << indent << "HandGrasp: " << this->HandGrasp << "\n";
  const auto print = [&](const char* name, const double vector[3])
  { os << indent << name << ": " << vector[0] << " " << vector[1] << " " << vector[2] << "\n"; };
  print("HandPosition", this->HandPosition);
  print("HandRotation", this->HandRotation);
  os << indent << "HandWidth: " << this->HandWidth << "\n";
}
