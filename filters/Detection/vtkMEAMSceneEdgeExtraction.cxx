// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSceneEdgeExtraction.h"

#include "scene/edges/SceneEdgeExtraction.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSceneEdgeConversion.h"
#include "vtkMEAMSceneRequests.h"
#include "vtkMEAMSettings.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"

vtkStandardNewMacro(vtkMEAMSceneEdgeExtraction);

vtkMEAMSceneEdgeExtraction::vtkMEAMSceneEdgeExtraction()
  : Settings(new meam::SceneEdgeExtractionSettings(meam::sceneEdgeSettings(meam::Preset::Recommended)))
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkMEAMSceneEdgeExtraction::~vtkMEAMSceneEdgeExtraction() { this->SetCameraFile(nullptr); }

vtkMEAMSettingMacro(vtkMEAMSceneEdgeExtraction, ImageEdges, bool, imageEdges)
vtkMEAMSettingMacro(vtkMEAMSceneEdgeExtraction, DepthEdges, bool, depthEdges)
vtkMEAMSettingMacro(vtkMEAMSceneEdgeExtraction, Creases, bool, creases)
vtkMEAMClampedSettingMacro(vtkMEAMSceneEdgeExtraction, CreaseAngle, double, creaseAngle, 1.0, 179.0)
vtkMEAMSettingMacro(vtkMEAMSceneEdgeExtraction, ImageTangents, bool, tangents)
vtkMEAMClampedSettingMacro(vtkMEAMSceneEdgeExtraction, Smoothing, double, image.smoothing, 0.0, 50.0)
vtkMEAMClampedSettingMacro(vtkMEAMSceneEdgeExtraction, LowThreshold, double, image.lowThreshold, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMSceneEdgeExtraction, HighThreshold, double, image.highThreshold, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMSceneEdgeExtraction, SearchRadius, int, searchRadius, 0, 50)
vtkMEAMClampedSettingMacro(vtkMEAMSceneEdgeExtraction, DepthJump, double, depthJump, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMSceneEdgeExtraction, NumberOfThreads, int, threads, 0, VTK_INT_MAX)

void vtkMEAMSceneEdgeExtraction::SetParametersToPaper()
{
  this->SetParameters(meam::sceneEdgeSettings(meam::Preset::Paper));
}

void vtkMEAMSceneEdgeExtraction::SetParametersToRecommended()
{
  this->SetParameters(meam::sceneEdgeSettings(meam::Preset::Recommended));
}

void vtkMEAMSceneEdgeExtraction::SetParameters(const meam::SceneEdgeExtractionSettings& settings)
{
  const int threads = this->Settings->threads;
  *this->Settings = settings;
  this->Settings->threads = threads;
  this->Modified();
}

int vtkMEAMSceneEdgeExtraction::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  return port == 0 ? fillInputPort(info, { "vtkStructuredGrid" }, Connections::One)
                   : fillInputPort(info, { "vtkImageData" }, Connections::OneOrNone);
}

int vtkMEAMSceneEdgeExtraction::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkImageData");
  return 1;
}

int vtkMEAMSceneEdgeExtraction::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* scene = inputVector[0]->GetInformationObject(0);
  vtkInformation* image = outputVector->GetInformationObject(1);
  image->CopyEntry(scene, vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  vtkDataObject::SetPointDataActiveScalarInfo(image, VTK_UNSIGNED_CHAR, 1);
  vtkMEAMSceneRequests::announceTime(inputVector, { 0, 1 }, outputVector);
  return 1;
}

int vtkMEAMSceneEdgeExtraction::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkMEAMSceneRequests::askForWhole(inputVector, 2);
  return 1;
}

int vtkMEAMSceneEdgeExtraction::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* scene = vtkStructuredGrid::GetData(inputVector[0]);
  auto* imageInput = vtkImageData::GetData(inputVector[1]);
  auto* edges = vtkPolyData::GetData(outputVector, 0);
  auto* edgeImage = vtkImageData::GetData(outputVector, 1);
  return vtkMEAMRun(
    this,
    [&]
    {
      meam::SceneEdgeExtractionSettings settings = *this->Settings;
      const meam::OrganizedCloud cloud = vtkMEAMConversion::toOrganizedCloud(scene, this->GetNumberOfThreads());
      meam::requirePoints(cloud.points, "The scene");
      meam::Image image;
      if (this->GetImageEdges())
      {
        image = imageInput ? vtkMEAMConversion::toImage(imageInput) : vtkMEAMConversion::imageOfCloud(scene);
        if (image.pixels.empty())
        {
          throw meam::Error("The scene has no image: it needs the point array 'Intensity' or 'RGB', or connect the "
                            "sensor's as Image, or turn ImageEdges off.");
        }
        settings.camera = vtkMEAMConversion::cameraOf(this->CameraFile, imageInput, cloud);
      }
      const meam::SceneEdges found =
        meam::extractSceneEdges(cloud, image, settings, vtkMEAMConversion::progressOf(this));
      vtkMEAMConversion::fromSceneEdges(found, edges);

      meam::Image pixels;
      pixels.width = cloud.width;
      pixels.height = cloud.height;
      pixels.pixels.assign(cloud.size(), 0);
      for (const int id : found.cloud.pointIds)
      {
        pixels.pixels[id] = 255;
      }
      vtkMEAMConversion::fromImage(pixels, edgeImage);
      edgeImage->GetPointData()->GetScalars()->SetName("Edges");
    },
    edges, edgeImage);
}

void vtkMEAMSceneEdgeExtraction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ImageEdges: " << this->GetImageEdges() << "\n";
  os << indent << "DepthEdges: " << this->GetDepthEdges() << "\n";
  os << indent << "Creases: " << this->GetCreases() << "\n";
  os << indent << "CreaseAngle: " << this->GetCreaseAngle() << " degrees\n";
  os << indent << "ImageTangents: " << this->GetImageTangents() << "\n";
  os << indent << "CameraFile: " << (this->CameraFile ? this->CameraFile : "(none)") << "\n";
  os << indent << "Smoothing: " << this->GetSmoothing() << " pixels\n";
  os << indent << "LowThreshold: " << this->GetLowThreshold() << "\n";
  os << indent << "HighThreshold: " << this->GetHighThreshold() << "\n";
  os << indent << "SearchRadius: " << this->GetSearchRadius() << " pixels\n";
  os << indent << "DepthJump: " << this->GetDepthJump() << " mm\n";
  os << indent << "NumberOfThreads: " << this->GetNumberOfThreads() << "\n";
}
