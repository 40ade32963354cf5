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
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkMEAMHandEyeCalibration);

namespace
{
void fromCalibration(
  const meam::HandEyeCalibration& calibration, meam::CameraMount mount, vtkPolyData* output, vtkTable* table)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(calibration.T_robot_camera.translation().data());
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = calibration.T_robot_camera.matrix();
  vtkNew<vtkDoubleArray> transform;
  transform->SetName("Transform");
  transform->SetNumberOfComponents(16);
  transform->InsertNextTuple(matrix.data());
  output->SetPoints(points);
  vtkMEAMConversion::addVertices(output);
  output->GetPointData()->AddArray(transform);
  vtkMEAMConversion::setFieldValue(output, "ResidualShift", calibration.shift);
  vtkMEAMConversion::setFieldValue(output, "ResidualTurn", calibration.turn);
  vtkMEAMConversion::setFieldText(output, "Method", calibration.method);
  vtkMEAMConversion::setFieldText(output, "CameraMount", mount == meam::CameraMount::Hand ? "hand" : "beside");
  vtkMEAMConversion::setFieldText(output, "Report", meam::describe(calibration));
  vtkNew<vtkIntArray> pairs;
  vtkNew<vtkDoubleArray> shifts, turns;
  pairs->SetName("Pair");
  shifts->SetName("Shift");
  turns->SetName("Turn");
  for (std::size_t k = 0; k < calibration.shifts.size(); ++k)
  {
    pairs->InsertNextValue(static_cast<int>(k) + 1);
    shifts->InsertNextValue(calibration.shifts[k]);
    turns->InsertNextValue(calibration.turns[k]);
  }
  table->AddColumn(pairs);
  table->AddColumn(shifts);
  table->AddColumn(turns);
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
      if (!this->FileName || !*this->FileName)
      {
        throw meam::Error("No file is given: set FileName to the name of a file with pairs of poses.");
      }
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
