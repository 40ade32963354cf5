// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseScreening.h"

#include "pose/verification/PoseScreening.h"
#include "vtkMEAMPoseWork.h"
#include "vtkMEAMSettings.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMPoseScreening);

vtkMEAMPoseScreening::vtkMEAMPoseScreening()
  : Settings(new meam::PoseScreeningSettings)
{
}

vtkMEAMPoseScreening::~vtkMEAMPoseScreening() = default;

vtkMEAMClampedSettingMacro(vtkMEAMPoseScreening, LeastSurface, double, leastSurface, 0.0, 1.0)
vtkMEAMClampedSettingMacro(vtkMEAMPoseScreening, Enough, int, enough, 0, VTK_INT_MAX)
vtkMEAMSettingMacro(vtkMEAMPoseScreening, FreeSpace, bool, freeSpace)

void vtkMEAMPoseScreening::Process(Work& work)
{
  this->Settings->threads = this->NumberOfThreads;
  work.result = meam::screenPoses(work.poses, work.scene, work.model, *this->Settings, work.progress);
}

void vtkMEAMPoseScreening::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LeastSurface: " << this->GetLeastSurface() << "\n";
  os << indent << "Enough: " << this->GetEnough() << "\n";
  os << indent << "FreeSpace: " << this->GetFreeSpace() << "\n";
}
