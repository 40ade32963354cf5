// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMVisibilityExtraction.h"

#include "model/VisibilityExtraction.h"
#include "vtkMEAMConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMVisibilityExtraction);

vtkMEAMVisibilityExtraction::vtkMEAMVisibilityExtraction()
{
  const meam::VisibilityExtractionSettings settings;
  this->NumberOfViewpoints = settings.viewpoints;
  this->RadiusFactor = settings.radiusFactor;
  this->ViewpointDistance = settings.viewpointDistance;
}

int vtkMEAMVisibilityExtraction::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkMEAMVisibilityExtraction::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  auto* output = vtkPartitionedDataSetCollection::GetData(outputVector);
  const auto work = [&]
  {
    meam::VisibilityExtractionSettings settings;
    settings.viewpoints = this->NumberOfViewpoints;
    settings.radiusFactor = this->RadiusFactor;
    settings.viewpointDistance = this->ViewpointDistance;
    const meam::PointCloud surface = toCloud(input);
    meam::requirePoints(surface.points, "The part's surface");
    fromAppearanceModels(meam::extractVisibility(meam::finitePoints(surface), settings, progressOf(this)), output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMVisibilityExtraction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfViewpoints: " << this->NumberOfViewpoints << "\n";
  os << indent << "RadiusFactor: " << this->RadiusFactor << "\n";
  os << indent << "ViewpointDistance: " << this->ViewpointDistance << "\n";
}
