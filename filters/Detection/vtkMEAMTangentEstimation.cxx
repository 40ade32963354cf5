// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMTangentEstimation.h"

#include "features/TangentEstimation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSettings.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMTangentEstimation);

vtkMEAMTangentEstimation::vtkMEAMTangentEstimation()
  : Settings(new meam::TangentEstimationSettings)
{
  this->SetNumberOfInputPorts(2);
}

vtkMEAMTangentEstimation::~vtkMEAMTangentEstimation() = default;

vtkMEAMClampedSettingMacro(vtkMEAMTangentEstimation, Method, int, method, Tiles, LineSegments)
vtkMEAMSettingMacro(vtkMEAMTangentEstimation, LeafSize, double, leafSize)
vtkMEAMClampedSettingMacro(vtkMEAMTangentEstimation, Radius, double, radius, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMTangentEstimation, InlierDistance, double, inlierDistance, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMTangentEstimation, SegmentLength, double, segmentLength, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMTangentEstimation, TilePixels, int, tilePixels, 1, 100000)
vtkMEAMClampedSettingMacro(vtkMEAMTangentEstimation, PixelSize, double, pixelSize, 1e-9, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMTangentEstimation, LineDistance, double, lineDistance, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMTangentEstimation, LineSupport, double, lineSupport, 0.0, 1.0)
vtkMEAMClampedSettingMacro(vtkMEAMTangentEstimation, NumberOfThreads, int, threads, 0, VTK_INT_MAX)

void vtkMEAMTangentEstimation::SetParametersToPaper() { this->SetParameters(meam::paperTangentSettings()); }

void vtkMEAMTangentEstimation::SetParametersToRecommended() { this->SetParameters({}); }

void vtkMEAMTangentEstimation::SetParameters(const meam::TangentEstimationSettings& settings)
{
  const int threads = this->Settings->threads;
  *this->Settings = settings;
  this->Settings->threads = threads;
  this->Modified();
}

int vtkMEAMTangentEstimation::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  return port == 0 ? fillInputPort(info, { "vtkPolyData", "vtkPartitionedDataSetCollection" }, Connections::One)
                   : fillInputPort(info, { "vtkDataObject" }, Connections::OneOrNone);
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
    const meam::TangentEstimationSettings& settings = *this->Settings;
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
        toLocalCloud(scene, this->GetNumberOfThreads()), diameter, sensor.direction, settings, progress);
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
  os << indent << "Method: " << methods[this->GetMethod()] << "\n";
  os << indent << "LeafSize: " << this->GetLeafSize() << "\n";
  os << indent << "Radius: " << this->GetRadius() << "\n";
  os << indent << "InlierDistance: " << this->GetInlierDistance() << "\n";
  os << indent << "SegmentLength: " << this->GetSegmentLength() << "\n";
  os << indent << "TilePixels: " << this->GetTilePixels() << "\n";
  os << indent << "PixelSize: " << this->GetPixelSize() << "\n";
  os << indent << "LineDistance: " << this->GetLineDistance() << "\n";
  os << indent << "LineSupport: " << this->GetLineSupport() << "\n";
  os << indent << "ViewDirection: " << this->ViewDirection[0] << " " << this->ViewDirection[1] << " "
     << this->ViewDirection[2] << "\n";
  os << indent << "NumberOfThreads: " << this->GetNumberOfThreads() << "\n";
}
