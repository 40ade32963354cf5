// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseVerification.h"

#include "baselines/BaselineSettings.h"
#include "pose/verification/PoseVerification.h"
#include "vtkMEAMPoseWork.h"
#include "vtkMEAMSettings.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMPoseVerification);

vtkMEAMPoseVerification::vtkMEAMPoseVerification()
  : Settings(new meam::PoseVerificationSettings)
{
}

vtkMEAMPoseVerification::~vtkMEAMPoseVerification() = default;

vtkMEAMClampedSettingMacro(vtkMEAMPoseVerification, Method, int, method, EdgeCoverage, Votes)
vtkMEAMClampedSettingMacro(vtkMEAMPoseVerification, Tolerance, double, evidence.tolerance, 0.0, VTK_DOUBLE_MAX)
vtkMEAMSettingMacro(vtkMEAMPoseVerification, FreeSpace, bool, evidence.freeSpace)
vtkMEAMClampedSettingMacro(vtkMEAMPoseVerification, PointStride, int, pointStride, 1, VTK_INT_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMPoseVerification, PosesPerView, int, posesPerView, 0, VTK_INT_MAX)
vtkMEAMParametersMacro(vtkMEAMPoseVerification, Paper, meam::paperVerificationSettings());
vtkMEAMParametersMacro(vtkMEAMPoseVerification, Recommended, {});
vtkMEAMParametersMacro(vtkMEAMPoseVerification, Candidates, meam::candidateVerificationSettings());
vtkMEAMParametersMacro(vtkMEAMPoseVerification, Votes, meam::votesVerificationSettings());

void vtkMEAMPoseVerification::Process(Work& work)
{
  this->Settings->threads = this->NumberOfThreads;
  meam::PoseVerificationSettings settings = *this->Settings;
  settings.evidence.rates = work.rates;
  meam::EvidenceRates rates;
  work.result = meam::verifyPoses(work.poses, work.scene, work.model, settings, work.progress, &rates);
  if (settings.method == meam::VerificationMethod::VisibleEvidence)
  {
    work.rates = rates;
  }
}

void vtkMEAMPoseVerification::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethod() << "\n";
  os << indent << "Tolerance: " << this->GetTolerance() << "\n";
  os << indent << "FreeSpace: " << this->GetFreeSpace() << "\n";
  os << indent << "PointStride: " << this->GetPointStride() << "\n";
  os << indent << "PosesPerView: " << this->GetPosesPerView() << "\n";
}
