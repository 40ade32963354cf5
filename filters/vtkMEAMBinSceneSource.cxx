// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMBinSceneSource.h"

#include "mesh/ConvexHull.h"
#include "simulation/BinScene.h"
#include "simulation/SamplePart.h"
#include "vtkMEAMConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

vtkStandardNewMacro(vtkMEAMBinSceneSource);

vtkMEAMBinSceneSource::vtkMEAMBinSceneSource()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(3);
}

int vtkMEAMBinSceneSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkMEAMBinSceneSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkStructuredGrid" : "vtkPolyData");
  return 1;
}

int vtkMEAMBinSceneSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const int extent[6] = { 0, this->Width - 1, 0, this->Height - 1, 0, 0 };
  outputVector->GetInformationObject(0)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  return 1;
}

int vtkMEAMBinSceneSource::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* input = vtkPolyData::GetData(inputVector[0]);
  auto* scan = vtkStructuredGrid::GetData(outputVector, 0);
  auto* truth = vtkPolyData::GetData(outputVector, 1);
  auto* part = vtkPolyData::GetData(outputVector, 2);
  return vtkMEAMRun(
    this,
    [&]
    {
      const meam::TriangleMesh mesh = input ? toMesh(input) : meam::makeSamplePart();
      meam::BinSceneSettings settings;
      settings.copies = this->Copies;
      settings.seed = static_cast<unsigned>(this->Seed);
      settings.binSize = this->BinSize;
      settings.sensorHeight = this->SensorHeight;
      settings.width = this->Width;
      settings.height = this->Height;
      settings.depthNoise = this->DepthNoise;
      settings.dropout = this->Dropout;
      settings.imageNoise = this->ImageNoise;
      const meam::BinScene scene = meam::simulateBin(mesh, settings, progressOf(this));

      fromOrganizedCloud(scene.cloud, scan);
      const auto pixels = static_cast<vtkIdType>(scene.cloud.size());
      vtkNew<vtkUnsignedCharArray> intensity;
      intensity->SetName("Intensity");
      intensity->SetNumberOfTuples(pixels);
      std::copy(scene.image.pixels.begin(), scene.image.pixels.end(), intensity->GetPointer(0));
      scan->GetPointData()->SetScalars(intensity);
      vtkNew<vtkIntArray> instance;
      instance->SetName("Instance");
      instance->SetNumberOfTuples(pixels);
      std::copy(scene.instanceOfPixel.begin(), scene.instanceOfPixel.end(), instance->GetPointer(0));
      scan->GetPointData()->AddArray(instance);
      setFieldValue(scan, "FocalLength", scene.focalLength);
      setFieldValue(scan, "BinSize", scene.binSize);

      meam::Poses poses;
      for (const meam::BinInstance& copy : scene.instances)
      {
        poses.emplace_back();
        poses.back().T_scene_model = copy.T_scene_model;
        poses.back().visibleFraction = copy.visibleFraction;
      }
      fromPoses(poses, truth);
      setDiameter(truth, meam::diameter(mesh.vertices));
      fromMesh(mesh, part);
    },
    scan, truth, part);
}

void vtkMEAMBinSceneSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Copies: " << this->Copies << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "BinSize: " << this->BinSize << " mm\n";
  os << indent << "SensorHeight: " << this->SensorHeight << " mm\n";
  os << indent << "Width: " << this->Width << " pixels\n";
  os << indent << "Height: " << this->Height << " pixels\n";
  os << indent << "DepthNoise: " << this->DepthNoise << " mm\n";
  os << indent << "Dropout: " << this->Dropout << "\n";
  os << indent << "ImageNoise: " << this->ImageNoise << "\n";
}
