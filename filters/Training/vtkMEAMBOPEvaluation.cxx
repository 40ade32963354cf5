// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMBOPEvaluation.h"

#include "evaluation/BOPEvaluation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSceneRequests.h"
#include "vtkMEAMSymmetryConversion.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"

#include <cmath>
#include <numeric>

vtkStandardNewMacro(vtkMEAMBOPEvaluation);

namespace
{
constexpr int AtATenth = 1; // the threshold of 10 %

double meanOf(const meam::BOPRecall::Counts& counts)
{
  return std::accumulate(counts.begin(), counts.end(), 0.0) / counts.size();
}
}

vtkMEAMBOPEvaluation::vtkMEAMBOPEvaluation() { this->SetNumberOfInputPorts(5); }

int vtkMEAMBOPEvaluation::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* type = port < 3 ? "vtkPolyData" : port == 3 ? "vtkStructuredGrid" : "vtkDataObject";
  return vtkMEAMConversion::fillInputPort(info, { type }, vtkMEAMConversion::Connections::OneOrNone);
}

int vtkMEAMBOPEvaluation::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneRequests::announceTime(inputVector, { 3, 1, 0 }, outputVector);
  return 1;
}

int vtkMEAMBOPEvaluation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* output = vtkTable::GetData(outputVector);
  return vtkMEAMRun(
    this,
    [&]
    {
      requireInputs(this, { "Poses", "True Poses", "Mesh", "Scan" });
      auto* part = vtkDataObject::GetData(inputVector[4]);
      const meam::BOPEvaluation evaluation(
        toMesh(vtkPolyData::GetData(inputVector[2])), symmetriesOf(part), part ? diameterOf(part) : 0.0);
      const meam::BOPRecall recall =
        evaluation.recall(toPoses(vtkPolyData::GetData(inputVector[0])), toPoses(vtkPolyData::GetData(inputVector[1])),
          toOrganizedCloud(vtkStructuredGrid::GetData(inputVector[3])), progressOf(this));
      meam::BOPRecall::Counts thresholds;
      for (int k = 0; k < meam::BOPThresholds; ++k)
      {
        thresholds[k] = meam::bopThreshold(k);
      }
      output->AddColumn(arrayOf<vtkDoubleArray>("Threshold", thresholds));
      output->AddColumn(arrayOf<vtkDoubleArray>("ADD", recall.add));
      output->AddColumn(arrayOf<vtkDoubleArray>("ADI", recall.adi));
      output->AddColumn(arrayOf<vtkDoubleArray>("MSSD", recall.mssd));
      output->AddColumn(arrayOf<vtkDoubleArray>("MSPD", recall.mspd));
      output->AddColumn(arrayOf<vtkDoubleArray>("VSD", recall.vsd));
      const double share = 100.0 / recall.targets * (recall.targets > 0 ? 1.0 : std::nan(""));
      setFieldValue(output, "Targets", recall.targets);
      setFieldValue(output, "ADDRecall", share * recall.add[AtATenth]);
      setFieldValue(output, "ADIRecall", share * recall.adi[AtATenth]);
      setFieldValue(output, "MSSDRecall", share * meanOf(recall.mssd));
      setFieldValue(output, "MSPDRecall", share * meanOf(recall.mspd));
      setFieldValue(output, "VSDRecall", share * meanOf(recall.vsd));
      setFieldValue(
        output, "AverageRecall", share * (meanOf(recall.mssd) + meanOf(recall.mspd) + meanOf(recall.vsd)) / 3.0);
    },
    output);
}
