// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSceneEdgeConversion.h"

#include "base/Frames.h"
#include "io/CameraFile.h"
#include "scene/edges/SceneEdgeExtraction.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <string>

namespace vtkMEAMConversion
{
namespace
{
constexpr const char* EdgeSourceName = "EdgeSource";
constexpr const char* ScanQualityName = "ScanQuality";

struct QualityField
{
  const char* name;
  double meam::ScanQuality::*value;
};
constexpr QualityField QualityFields[] = { { "PointDistance", &meam::ScanQuality::pointDistance },
  { "Noise", &meam::ScanQuality::noise }, { "Smoothing", &meam::ScanQuality::smoothing },
  { "DepthStep", &meam::ScanQuality::depthStep }, { "JumpGap", &meam::ScanQuality::jumpGap },
  { "Flying", &meam::ScanQuality::flying }, { "Coverage", &meam::ScanQuality::coverage } };
constexpr int QualityFieldCount = static_cast<int>(std::size(QualityFields));

/// The numbers of a field data array, row by row; nothing when it is not there.
template <int Count>
std::optional<Eigen::Matrix<double, Count, 1>> numbersOf(vtkImageData* image, const char* name)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(name);
  if (!array)
  {
    return std::nullopt;
  }
  if (array->GetNumberOfValues() != Count)
  {
    throw meam::Error(
      "The image's field data '" + std::string(name) + "' must have " + std::to_string(Count) + " numbers.");
  }
  Eigen::Matrix<double, Count, 1> numbers;
  for (int i = 0; i < Count; ++i)
  {
    numbers[i] = array->GetComponent(i / array->GetNumberOfComponents(), i % array->GetNumberOfComponents());
  }
  return numbers;
}
}

std::optional<meam::Camera> cameraOf(const char* file, vtkImageData* image, const meam::OrganizedCloud& cloud)
{
  if (file && *file)
  {
    return meam::readImageCamera(file);
  }
  const auto matrix = image ? numbersOf<9>(image, "CameraMatrix") : std::nullopt;
  const auto pose = image ? numbersOf<16>(image, "CameraPose") : std::nullopt;
  if (!matrix || !pose)
  {
    return std::nullopt;
  }
  meam::Camera camera;
  int size[3];
  image->GetDimensions(size);
  camera.width = size[0];
  camera.height = size[1];
  camera.fx = (*matrix)[0];
  camera.cx = (*matrix)[2];
  camera.fy = (*matrix)[4];
  camera.cy = (*matrix)[5];
  camera.T_camera_scene = meam::transformOf(pose->data());
  if (camera.width == cloud.width && camera.height == cloud.height &&
      camera.T_camera_scene.isApprox(Eigen::Isometry3d::Identity(), 1e-9))
  {
    return std::nullopt; // the sensor's own image
  }
  return camera;
}

void fromSceneEdges(const meam::SceneEdges& edges, vtkPolyData* output)
{
  fromCloud(edges.cloud, output);
  output->GetPointData()->SetScalars( // what a view colours by
    arrayOf<vtkUnsignedCharArray>(EdgeSourceName, edges.sources));
  setScanQuality(output, edges.quality);
}

void setScanQuality(vtkDataObject* output, const meam::ScanQuality& quality, const std::string& assumed)
{
  if (!quality.isKnown())
  {
    if (!assumed.empty())
    {
      setFieldText(output, "ScanReport", assumed);
    }
    return;
  }
  const auto valueOf = [&](const QualityField& field) { return quality.*field.value; };
  const auto numbers = columnOf<vtkDoubleArray>(ScanQualityName, QualityFields, valueOf, QualityFieldCount);
  for (int i = 0; i < QualityFieldCount; ++i)
  {
    numbers->SetComponentName(i, QualityFields[i].name);
  }
  output->GetFieldData()->AddArray(numbers);
  setFieldText(output, "ScanReport", assumed + (assumed.empty() ? "" : " ") + meam::describe(quality));
}

meam::ScanQuality scanQualityOf(vtkDataObject* input)
{
  meam::ScanQuality quality;
  vtkDataArray* numbers = input->GetFieldData()->GetArray(ScanQualityName);
  if (numbers && numbers->GetNumberOfTuples() > 0 && numbers->GetNumberOfComponents() == QualityFieldCount)
  {
    for (int i = 0; i < QualityFieldCount; ++i)
    {
      quality.*QualityFields[i].value = numbers->GetComponent(0, i);
    }
  }
  return quality;
}

vtkDataArray* edgeSourcesOf(vtkPointSet* edges) { return edges->GetPointData()->GetArray(EdgeSourceName); }
}
