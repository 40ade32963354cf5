// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseRefinement.h"

#include "baselines/BaselineSettings.h"
#include "pose/refinement/PoseRefinement.h"
#include "vtkMEAMPoseWork.h"
#include "vtkMEAMSettings.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMPoseRefinement);

vtkMEAMPoseRefinement::vtkMEAMPoseRefinement()
  : Settings(new meam::PoseRefinementSettings)
{
}

vtkMEAMPoseRefinement::~vtkMEAMPoseRefinement() = default;

vtkMEAMClampedSettingMacro(vtkMEAMPoseRefinement, Method, int, method, PointToPoint, EdgesAndSurface)
vtkMEAMClampedSettingMacro(vtkMEAMPoseRefinement, NumberOfIterations, int, iterations, 1, 10000)
vtkMEAMClampedSettingMacro(vtkMEAMPoseRefinement, MaximumDistance, double, maximumDistance, 0.0, VTK_DOUBLE_MAX)
vtkMEAMParametersMacro(vtkMEAMPoseRefinement, Paper, meam::paperRefinementSettings());
vtkMEAMParametersMacro(vtkMEAMPoseRefinement, Recommended, {});

void vtkMEAMPoseRefinement::Process(Work& work)
{
  this->Settings->threads = this->NumberOfThreads;
  work.result = meam::refinePoses(work.poses, work.scene, work.model, *this->Settings, work.progress);
}

void vtkMEAMPoseRefinement::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethod() << "\n";
  os << indent << "NumberOfIterations: " << this->GetNumberOfIterations() << "\n";
  os << indent << "MaximumDistance: " << this->GetMaximumDistance() << "\n";
}
