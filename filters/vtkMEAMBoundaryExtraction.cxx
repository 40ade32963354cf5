// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMBoundaryExtraction.h"

#include "model/BoundaryExtraction.h"
#include "vtkMEAMConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"

vtkStandardNewMacro(vtkMEAMBoundaryExtraction);

vtkMEAMBoundaryExtraction::vtkMEAMBoundaryExtraction()
{
  const meam::BoundaryExtractionSettings settings;
  this->Radius = settings.radius;
  this->Angle = settings.angle;
}

int vtkMEAMBoundaryExtraction::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkMEAMBoundaryExtraction::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* input = vtkPartitionedDataSetCollection::GetData(inputVector[0]);
  auto* output = vtkPartitionedDataSetCollection::GetData(outputVector);
  const auto work = [&]
  {
    meam::BoundaryExtractionSettings settings;
    settings.radius = this->Radius;
    settings.angle = this->Angle;
    fromAppearanceModels(meam::extractBoundary(toAppearanceModels(input), settings, progressOf(this)), output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMBoundaryExtraction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Angle: " << this->Angle << "\n";
}
