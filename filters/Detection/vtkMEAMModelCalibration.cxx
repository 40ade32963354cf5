// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMModelCalibration.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkMEAMModelCalibration);

namespace
{
vtkDataArray* judgedArray(vtkPolyData* poses, const char* name)
{
  vtkDataArray* array = vtkMEAMConversion::pointArray(poses, name, 1);
  if (!array && poses->GetNumberOfPoints() > 0)
  {
    throw meam::Error("The judged poses have no point array '" + std::string(name) +
                      "': connect the judged poses of Pose Evaluation, its third output.");
  }
  return array;
}

std::vector<meam::JudgedPose> toJudgedPoses(vtkPolyData* input)
{
  using vtkMEAMConversion::wholeIn;
  vtkDataArray* place = judgedArray(input, "PlaceProbability");
  vtkDataArray* certainty = judgedArray(input, "Certainty");
  vtkDataArray* scene = judgedArray(input, "Scene");
  vtkDataArray* isThere = judgedArray(input, "CopyIsThere");
  vtkDataArray* outcome = judgedArray(input, "PoseOutcome");
  return meam::ofIndices<meam::JudgedPose>(input->GetNumberOfPoints(),
    [&](int k)
    {
      return meam::JudgedPose{ place->GetComponent(k, 0), certainty->GetComponent(k, 0), wholeIn(isThere, k) != 0,
        wholeIn(outcome, k) == 0, wholeIn(scene, k) };
    });
}

void fromReport(const meam::CalibrationReport& report, vtkTable* output)
{
  using namespace vtkMEAMConversion;
  using meam::ClaimClass;
  const auto claimOf = [](const ClaimClass& one) { return one.withRotation ? "pose" : "place"; };
  output->AddColumn(columnOf<vtkStringArray>("Claim", report.classes, claimOf));
  output->AddColumn(columnOf<vtkDoubleArray>("Least", report.classes, &ClaimClass::least));
  output->AddColumn(columnOf<vtkDoubleArray>("Most", report.classes, &ClaimClass::most));
  output->AddColumn(columnOf<vtkIntArray>("Poses", report.classes, &ClaimClass::poses));
  output->AddColumn(columnOf<vtkDoubleArray>("Right", report.classes, &ClaimClass::right));
  output->AddColumn(columnOf<vtkDoubleArray>("Before", report.classes, &ClaimClass::before));
  output->AddColumn(columnOf<vtkDoubleArray>("After", report.classes, &ClaimClass::after));
  setFieldValue(output, "LossBefore", report.lossBefore);
  setFieldValue(output, "LossAfter", report.lossAfter);
  setFieldText(output, "Warning", report.warning);
  setCalibration(output, report.calibration);
}
}

vtkMEAMModelCalibration::vtkMEAMModelCalibration()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

int vtkMEAMModelCalibration::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* type = port == 0 ? "vtkPartitionedDataSetCollection" : "vtkPolyData";
  return vtkMEAMConversion::fillInputPort(info, { type }, vtkMEAMConversion::Connections::OneOrNone);
}

int vtkMEAMModelCalibration::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPartitionedDataSetCollection" : "vtkTable");
  return 1;
}

int vtkMEAMModelCalibration::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkPartitionedDataSetCollection::GetData(inputVector[0]);
  auto* judged = vtkPolyData::GetData(inputVector[1]);
  auto* output = vtkPartitionedDataSetCollection::GetData(outputVector, 0);
  auto* table = vtkTable::GetData(outputVector, 1);
  return vtkMEAMRun(
    this,
    [&]
    {
      vtkMEAMConversion::requireInputs(this, { "Model", "Judged Poses" });
      const meam::TrainedModel model = vtkMEAMConversion::toTrainedModel(input);
      const meam::CalibrationReport report = meam::fitModelCalibration(toJudgedPoses(judged), model.calibration);
      output->ShallowCopy(input);
      vtkMEAMConversion::setCalibration(output, report.calibration);
      fromReport(report, table);
    },
    output, table);
}
