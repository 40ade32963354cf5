// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseSelection.h"

#include "baselines/BaselineSettings.h"
#include "pose/selection/PoseSelection.h"
#include "vtkMEAMPoseWork.h"
#include "vtkMEAMSettings.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMPoseSelection);

vtkMEAMPoseSelection::vtkMEAMPoseSelection()
  : Settings(new meam::PoseSelectionSettings)
{
}

vtkMEAMPoseSelection::~vtkMEAMPoseSelection() = default;

vtkMEAMClampedSettingMacro(vtkMEAMPoseSelection, Method, int, method, Clusters, Instances)
vtkMEAMClampedSettingMacro(vtkMEAMPoseSelection, ClusterDistance, double, clusterDistance, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMPoseSelection, PosesPerInstance, int, alternatives, 1, VTK_INT_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMPoseSelection, MaximumNumberOfPoses, int, maximumPoses, 0, VTK_INT_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMPoseSelection, MinimumProbability, double, minimumProbability, 0.0, 1.0)
vtkMEAMSettingMacro(vtkMEAMPoseSelection, RotationCounts, bool, rotationCounts)
vtkMEAMSettingMacro(vtkMEAMPoseSelection, SameVisibility, bool, comparison.sameVisibility)

void vtkMEAMPoseSelection::SetFreeSpace(bool value)
{
  if (this->Settings->evidence.freeSpace != value)
  {
    this->Settings->evidence.freeSpace = value;
    this->Settings->comparison.freeSpace = value;
    this->Modified();
  }
}

bool vtkMEAMPoseSelection::GetFreeSpace() { return this->Settings->evidence.freeSpace; }

vtkMEAMParametersMacro(vtkMEAMPoseSelection, Paper, meam::paperSelectionSettings());
vtkMEAMParametersMacro(vtkMEAMPoseSelection, Recommended, {});
vtkMEAMParametersMacro(vtkMEAMPoseSelection, Candidates, meam::candidateSelectionSettings());
vtkMEAMParametersMacro(vtkMEAMPoseSelection, Votes, meam::votesSelectionSettings());

void vtkMEAMPoseSelection::Process(Work& work)
{
  this->Settings->threads = this->NumberOfThreads;
  meam::PoseSelectionSettings settings = *this->Settings;
  settings.evidence.rates = work.rates;
  work.result = meam::selectPoses(work.poses, work.scene, work.model, settings, work.progress);
}

void vtkMEAMPoseSelection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethod() << "\n";
  os << indent << "ClusterDistance: " << this->GetClusterDistance() << "\n";
  os << indent << "PosesPerInstance: " << this->GetPosesPerInstance() << "\n";
  os << indent << "MaximumNumberOfPoses: " << this->GetMaximumNumberOfPoses() << "\n";
  os << indent << "MinimumProbability: " << this->GetMinimumProbability() << "\n";
  os << indent << "RotationCounts: " << this->GetRotationCounts() << "\n";
  os << indent << "FreeSpace: " << this->GetFreeSpace() << "\n";
  os << indent << "SameVisibility: " << this->GetSameVisibility() << "\n";
}
