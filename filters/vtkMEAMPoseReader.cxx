// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseReader.h"

#include "io/PoseFile.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMPoseReader);

vtkMEAMPoseReader::vtkMEAMPoseReader() { this->SetNumberOfInputPorts(0); }

vtkMEAMPoseReader::~vtkMEAMPoseReader() { this->SetFileName(nullptr); }

int vtkMEAMPoseReader::CanReadFile(const char* fileName)
{
  try
  {
    meam::readMatrices(fileName ? fileName : "");
    return 1;
  }
  catch (const meam::Error&)
  {
    return 0;
  }
}

int vtkMEAMPoseReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkPolyData::GetData(outputVector);
  return vtkMEAMRun(
    this,
    [&]
    {
      if (!this->FileName || !*this->FileName)
      {
        throw meam::Error("No file is given: set the name of a pose file.");
      }
      meam::Poses poses;
      for (const Eigen::Isometry3d& T_scene_model : meam::readMatrices(this->FileName))
      {
        poses.emplace_back();
        poses.back().T_scene_model = T_scene_model;
      }
      vtkMEAMConversion::fromPoses(poses, output);
    },
    output);
}

void vtkMEAMPoseReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
