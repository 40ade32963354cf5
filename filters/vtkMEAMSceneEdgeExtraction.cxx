// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSceneEdgeExtraction.h"

#include "scene/edges/SceneEdgeExtraction.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSceneEdgeConversion.h"
#include "vtkMEAMSceneTime.h"

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
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkMEAMSceneEdgeExtraction::~vtkMEAMSceneEdgeExtraction() { this->SetCameraFile(nullptr); }

int vtkMEAMSceneEdgeExtraction::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkStructuredGrid" : "vtkImageData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
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
  vtkMEAMSceneTime::announce(inputVector, { 0, 1 }, outputVector);
  return 1;
}

int vtkMEAMSceneEdgeExtraction::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  // Edges are found in the whole image, whatever part of the output somebody asks for.
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* info = inputVector[port]->GetInformationObject(0);
    if (info && info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
    {
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
        info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
    }
  }
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
      meam::SceneEdgeExtractionSettings settings;
      settings.imageEdges = this->ImageEdges;
      settings.depthEdges = this->DepthEdges;
      settings.creases = this->Creases;
      settings.creaseAngle = this->CreaseAngle;
      settings.tangents = this->ImageTangents;
      settings.image.smoothing = this->Smoothing;
      settings.image.lowThreshold = this->LowThreshold;
      settings.image.highThreshold = this->HighThreshold;
      settings.searchRadius = this->SearchRadius;
      settings.depthJump = this->DepthJump;
      settings.threads = this->NumberOfThreads;
      const meam::OrganizedCloud cloud = vtkMEAMConversion::toOrganizedCloud(scene, this->NumberOfThreads);
      meam::requirePoints(cloud.points, "The scene");
      meam::Image image;
      if (this->ImageEdges)
      {
        image = imageInput ? vtkMEAMConversion::toImage(imageInput) : vtkMEAMConversion::imageOfCloud(scene);
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
  os << indent << "ImageEdges: " << this->ImageEdges << "\n";
  os << indent << "DepthEdges: " << this->DepthEdges << "\n";
  os << indent << "Creases: " << this->Creases << "\n";
  os << indent << "CreaseAngle: " << this->CreaseAngle << " degrees\n";
  os << indent << "ImageTangents: " << this->ImageTangents << "\n";
  os << indent << "CameraFile: " << (this->CameraFile ? this->CameraFile : "(none)") << "\n";
  os << indent << "Smoothing: " << this->Smoothing << " pixels\n";
  os << indent << "LowThreshold: " << this->LowThreshold << "\n";
  os << indent << "HighThreshold: " << this->HighThreshold << "\n";
  os << indent << "SearchRadius: " << this->SearchRadius << " pixels\n";
  os << indent << "DepthJump: " << this->DepthJump << " mm\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}
