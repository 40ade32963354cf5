// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMHandEyeCalibration.h"

#include "calibration/HandEyeFile.h"
#include "calibration/RobotFrameFile.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkMEAMHandEyeCalibration);

namespace
{
void fromCalibration(
  const meam::HandEyeCalibration& calibration, meam::CameraMount mount, vtkPolyData* output, vtkTable* table)
{
  using namespace vtkMEAMConversion;
  setVertices({ calibration.T_robot_camera.translation() }, output);
  output->GetPointData()->AddArray(frameOf("Transform", calibration.T_robot_camera));
  setFieldValue(output, "ResidualShift", calibration.shift);
  setFieldValue(output, "ResidualTurn", calibration.turn);
  setFieldText(output, "Method", calibration.method);
  setFieldText(output, "CameraMount", mount == meam::CameraMount::Hand ? "hand" : "beside");
  setFieldText(output, "Report", meam::describe(calibration));
  table->AddColumn(columnOf<vtkIntArray>("Pair", calibration.shifts, [pair = 0](double) mutable { return ++pair; }));
  table->AddColumn(arrayOf<vtkDoubleArray>("Shift", calibration.shifts));
  table->AddColumn(arrayOf<vtkDoubleArray>("Turn", calibration.turns));
}
}

vtkMEAMHandEyeCalibration::vtkMEAMHandEyeCalibration()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
}

vtkMEAMHandEyeCalibration::~vtkMEAMHandEyeCalibration() { this->SetFileName(nullptr); }

int vtkMEAMHandEyeCalibration::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkMEAMHandEyeCalibration::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkPolyData::GetData(outputVector, 0);
  auto* table = vtkTable::GetData(outputVector, 1);
  return vtkMEAMRun(
    this,
    [&]
    {
      vtkMEAMConversion::requireFileName(this->FileName, "the name of a file with pairs of poses");
      const meam::HandEyeFile file = meam::readHandEye(this->FileName);
      const meam::CameraMount mount = this->Mount == Hand     ? meam::CameraMount::Hand
                                      : this->Mount == Beside ? meam::CameraMount::Beside
                                                              : file.mount.value_or(meam::CameraMount::Beside);
      fromCalibration(meam::calibrateHandEye(file.pairs, mount), mount, output, table);
    },
    output, table);
}

int vtkMEAMHandEyeCalibration::WriteRobotFrame(const char* fileName)
{
  this->Update();
  return vtkMEAMRun(this,
    [&]
    {
      const meam::Poses found = vtkMEAMConversion::toPoses(this->GetOutput());
      if (found.empty() || !fileName || !*fileName)
      {
        throw meam::Error("Nothing was written: there is no calibration, or no name of a file.");
      }
      meam::writeRobotFrame(fileName, found.front().T_scene_model);
    });
}

void vtkMEAMHandEyeCalibration::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Mount: " << this->Mount << "\n";
}
