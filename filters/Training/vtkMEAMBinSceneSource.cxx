// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMBinSceneSource.h"

#include "mesh/ConvexHull.h"
#include "mesh/TriangleMesh.h"
#include "simulation/BinScene.h"
#include "simulation/parts/SamplePart.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMPickConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSettings.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <vector>

vtkStandardNewMacro(vtkMEAMBinSceneSource);

namespace
{
using vtkMEAMConversion::arrayOf;

/// The truth in the image: where each copy is seen.
void addMasks(const std::vector<meam::BinInstance>& copies, vtkPolyData* truth)
{
  std::vector<int> pixels;
  std::vector<int> visible;
  std::vector<int> boxes;
  std::vector<unsigned char> silhouettes;
  for (const meam::BinInstance& copy : copies)
  {
    const meam::Mask& mask = copy.silhouette;
    pixels.push_back(mask.count());
    visible.push_back(copy.visiblePixels);
    boxes.insert(boxes.end(), { mask.left, mask.top, mask.width, mask.height });
    silhouettes.insert(silhouettes.end(), mask.pixels.begin(), mask.pixels.end());
  }
  truth->GetPointData()->AddArray(arrayOf<vtkIntArray>("Pixels", pixels));
  truth->GetPointData()->AddArray(arrayOf<vtkIntArray>("VisiblePixels", visible));
  truth->GetPointData()->AddArray(arrayOf<vtkIntArray>("Box", boxes, 4));
  truth->GetFieldData()->AddArray(arrayOf<vtkUnsignedCharArray>("Silhouettes", silhouettes));
}

/// A value of the user's in place of the sensor's, unless it is negative.
template <typename Value>
void choose(Value chosen, Value& value)
{
  value = chosen < 0 ? value : chosen;
}

void addCamera(const meam::Camera& camera, vtkDataObject* data)
{
  const std::array<double, 9> matrix{ camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0 };
  data->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>("CameraMatrix", matrix, 9));
  data->GetFieldData()->AddArray(vtkMEAMConversion::frameOf("CameraPose", camera.T_camera_scene));
}
}

vtkMEAMBinSceneSource::vtkMEAMBinSceneSource()
  : Settings(new meam::BinSceneSettings)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(4);
}

vtkMEAMBinSceneSource::~vtkMEAMBinSceneSource() = default;

vtkMEAMClampedSettingMacro(vtkMEAMBinSceneSource, Copies, int, copies, 1, 10000)
vtkMEAMSettingMacro(vtkMEAMBinSceneSource, Settle, bool, settle)
vtkMEAMClampedSettingMacro(vtkMEAMBinSceneSource, Seed, int, seed, 0, VTK_INT_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMBinSceneSource, BinSize, double, binSize, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMBinSceneSource, BinWidth, double, binWidth, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMBinSceneSource, WallHeight, double, wallHeight, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMBinSceneSource, SensorHeight, double, sensorHeight, 0.0, VTK_DOUBLE_MAX)
vtkMEAMSettingMacro(vtkMEAMBinSceneSource, Colored, bool, colored)
vtkMEAMClampedSettingMacro(vtkMEAMBinSceneSource, Baseline, double, baseline, 0.0, VTK_DOUBLE_MAX)

int vtkMEAMBinSceneSource::FillInputPortInformation(int, vtkInformation* info)
{
  return vtkMEAMConversion::fillInputPort(info, { "vtkPolyData" }, vtkMEAMConversion::Connections::OneOrNone);
}

int vtkMEAMBinSceneSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  static const char* const types[] = { "vtkStructuredGrid", "vtkPolyData", "vtkPolyData", "vtkImageData" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

int vtkMEAMBinSceneSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  meam::BinSceneSettings settings = meam::binSettings(static_cast<meam::SensorKind>(this->Sensor));
  choose(this->Width, settings.width);
  choose(this->Height, settings.height);
  const int extent[6] = { 0, settings.width - 1, 0, settings.height - 1, 0, 0 };
  for (const int port : { 0, 3 })
  {
    outputVector->GetInformationObject(port)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  }
  return 1;
}

int vtkMEAMBinSceneSource::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* input = vtkPolyData::GetData(inputVector[0]);
  auto* standing = vtkPolyData::GetData(inputVector[1]);
  auto* scan = vtkStructuredGrid::GetData(outputVector, 0);
  auto* truth = vtkPolyData::GetData(outputVector, 1);
  auto* part = vtkPolyData::GetData(outputVector, 2);
  auto* picture = vtkImageData::GetData(outputVector, 3);
  return vtkMEAMRun(
    this,
    [&]
    {
      const meam::TriangleMesh mesh = input ? toMesh(input) : meam::makeSamplePart();
      meam::BinSceneSettings settings = *this->Settings;
      const meam::BinSceneSettings ofSensor = meam::binSettings(static_cast<meam::SensorKind>(this->Sensor));
      settings.width = ofSensor.width;
      settings.height = ofSensor.height;
      settings.quality = ofSensor.quality;
      if (standing)
      {
        if (standing->GetNumberOfPoints() == 0)
        {
          throw meam::Error("There are no poses for copies to stand at: give some, or leave Poses open.");
        }
        for (const meam::Pose& pose : toPoses(standing))
        {
          settings.poses.push_back(pose.T_scene_model);
        }
      }
      choose(this->Width, settings.width);
      choose(this->Height, settings.height);
      meam::SensorQuality& quality = settings.quality;
      choose(this->DepthNoise, quality.depthNoise);
      choose(this->DepthStep, quality.depthStep);
      choose(this->Dropout, quality.dropout);
      choose(this->JumpDropout, quality.jumpDropout);
      choose(this->MatchingWindow, quality.matchingWindow);
      choose(this->GlareAngle, quality.glareAngle);
      choose(this->NoiseWindow, quality.noiseWindow);
      choose(this->StereoBaseline, quality.stereoBaseline);
      choose(this->DisparityNoise, quality.disparityNoise);
      choose(this->DisparityStep, quality.disparityStep);
      choose(this->SmoothingWindow, quality.smoothingWindow);
      choose(this->RangeNoise, quality.rangeNoise);
      choose(this->PixelBlur, quality.pixelBlur);
      choose(this->Multipath, quality.multipath);
      choose(this->ImageNoise, quality.imageNoise);
      choose(this->ImageBlur, quality.imageBlur);
      const meam::BinScene scene = meam::simulateBin(mesh, settings, progressOf(this));

      fromOrganizedCloud(scene.cloud, scan);
      if (settings.baseline == 0.0)
      {
        scan->GetPointData()->SetScalars(arrayOf<vtkUnsignedCharArray>(
          settings.colored ? "RGB" : "Intensity", scene.image.pixels, scene.image.channels));
      }
      scan->GetPointData()->AddArray(arrayOf<vtkIntArray>("Instance", scene.instanceOfPixel));
      addCamera(scene.sensor, scan);
      setFieldValue(scan, "BinSize", scene.binSize);
      fromImage(scene.image, picture);
      addCamera(scene.camera, picture);

      meam::Poses poses;
      for (const meam::BinInstance& copy : scene.instances)
      {
        poses.emplace_back();
        poses.back().T_scene_model = copy.T_scene_model;
        poses.back().visibleFraction = copy.visibleFraction();
      }
      fromPoses(poses, truth);
      addMasks(scene.instances, truth);
      setBin(truth, scene.bin);
      setDiameter(truth, meam::diameter(mesh.vertices));
      fromMesh(mesh, part);
    },
    scan, truth, part, picture);
}

void vtkMEAMBinSceneSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Copies: " << this->GetCopies() << "\n";
  os << indent << "Settle: " << this->GetSettle() << "\n";
  os << indent << "Seed: " << this->GetSeed() << "\n";
  os << indent << "BinSize: " << this->GetBinSize() << " mm\n";
  os << indent << "BinWidth: " << this->GetBinWidth() << " mm\n";
  os << indent << "WallHeight: " << this->GetWallHeight() << " mm\n";
  os << indent << "SensorHeight: " << this->GetSensorHeight() << " mm\n";
  os << indent << "Sensor: " << this->Sensor << "\n";
  os << indent << "Width: " << this->Width << " pixels\n";
  os << indent << "Height: " << this->Height << " pixels\n";
  os << indent << "Colored: " << this->GetColored() << "\n";
  os << indent << "Baseline: " << this->GetBaseline() << " mm\n";
  os << indent << "DepthNoise: " << this->DepthNoise << " mm\n";
  os << indent << "DepthStep: " << this->DepthStep << " mm\n";
  os << indent << "Dropout: " << this->Dropout << "\n";
  os << indent << "JumpDropout: " << this->JumpDropout << "\n";
  os << indent << "MatchingWindow: " << this->MatchingWindow << " pixels\n";
  os << indent << "GlareAngle: " << this->GlareAngle << " degrees\n";
  os << indent << "NoiseWindow: " << this->NoiseWindow << " pixels\n";
  os << indent << "StereoBaseline: " << this->StereoBaseline << " mm\n";
  os << indent << "DisparityNoise: " << this->DisparityNoise << " pixels\n";
  os << indent << "DisparityStep: " << this->DisparityStep << " pixels\n";
  os << indent << "SmoothingWindow: " << this->SmoothingWindow << " pixels\n";
  os << indent << "RangeNoise: " << this->RangeNoise << " mm\n";
  os << indent << "PixelBlur: " << this->PixelBlur << " pixels\n";
  os << indent << "Multipath: " << this->Multipath << "\n";
  os << indent << "ImageNoise: " << this->ImageNoise << "\n";
  os << indent << "ImageBlur: " << this->ImageBlur << " pixels\n";
}
