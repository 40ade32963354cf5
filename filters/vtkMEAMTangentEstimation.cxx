// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMTangentEstimation.h"

#include "features/TangentEstimation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneConversion.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMTangentEstimation);

vtkMEAMTangentEstimation::vtkMEAMTangentEstimation()
{
  this->SetNumberOfInputPorts(2);
  this->SetParametersToRecommended();
}

void vtkMEAMTangentEstimation::SetParametersToPaper() { this->SetParameters(meam::paperTangentSettings()); }

void vtkMEAMTangentEstimation::SetParametersToRecommended() { this->SetParameters({}); }

void vtkMEAMTangentEstimation::SetParameters(const meam::TangentEstimationSettings& settings)
{
  this->Method = static_cast<int>(settings.method);
  this->LeafSize = settings.leafSize;
  this->Radius = settings.radius;
  this->InlierDistance = settings.inlierDistance;
  this->SegmentLength = settings.segmentLength;
  this->TilePixels = settings.tilePixels;
  this->PixelSize = settings.pixelSize;
  this->LineDistance = settings.lineDistance;
  this->LineSupport = settings.lineSupport;
  this->Modified();
}

int vtkMEAMTangentEstimation::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkMEAMTangentEstimation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* model = vtkDataObject::GetData(inputVector[1]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  const auto work = [&]
  {
    meam::TangentEstimationSettings settings;
    settings.method = static_cast<meam::TangentMethod>(this->Method);
    settings.leafSize = this->LeafSize;
    settings.radius = this->Radius;
    settings.inlierDistance = this->InlierDistance;
    settings.segmentLength = this->SegmentLength;
    settings.tilePixels = this->TilePixels;
    settings.pixelSize = this->PixelSize;
    settings.lineDistance = this->LineDistance;
    settings.lineSupport = this->LineSupport;
    settings.threads = this->NumberOfThreads;
    const double diameter = model ? diameterOf(model) : diameterOf(input);
    if (model && !(diameter > 0.0))
    {
      throw meam::Error("The model has no field data 'Diameter': connect the trained model or the sampled surface.");
    }
    const meam::Progress progress = progressOf(this);
    if (auto* scene = vtkPolyData::SafeDownCast(input))
    {
      if (model)
      {
        setDiameter(output, diameter);
      }
      const meam::Sensor sensor = sensorOf(OrthographicProjection, this->ViewDirection, this->ViewDirection, nullptr);
      const meam::ThinnedEdges edges = meam::estimateTangents(
        toLocalCloud(scene, this->NumberOfThreads), diameter, sensor.direction, settings, progress);
      fromThinnedEdges(edges, scene, vtkPolyData::SafeDownCast(output));
      return;
    }
    const auto views = toAppearanceModels(vtkPartitionedDataSetCollection::SafeDownCast(input));
    fromAppearanceModels(meam::estimateTangents(views, diameter, settings, progress),
      vtkPartitionedDataSetCollection::SafeDownCast(output));
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMTangentEstimation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* methods[] = { "Tiles", "RobustLine", "LineSegments" };
  os << indent << "Method: " << methods[this->Method] << "\n";
  os << indent << "LeafSize: " << this->LeafSize << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "InlierDistance: " << this->InlierDistance << "\n";
  os << indent << "SegmentLength: " << this->SegmentLength << "\n";
  os << indent << "TilePixels: " << this->TilePixels << "\n";
  os << indent << "PixelSize: " << this->PixelSize << "\n";
  os << indent << "LineDistance: " << this->LineDistance << "\n";
  os << indent << "LineSupport: " << this->LineSupport << "\n";
  os << indent << "ViewDirection: " << this->ViewDirection[0] << " " << this->ViewDirection[1] << " "
     << this->ViewDirection[2] << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}
