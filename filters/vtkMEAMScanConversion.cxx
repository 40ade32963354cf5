// SPDX-License-Identifier: BSD-3-Clause
// The part of vtkMEAMConversion.h that deals with what sensors measure.
#include "vtkMEAMConversion.h"

#include "io/CameraFile.h"
#include "scene/MeasuredCloud.h"

#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace vtkMEAMConversion
{
namespace
{
vtkSmartPointer<vtkUnsignedCharArray> newBytes(const char* name, int components, std::size_t tuples)
{
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array;
}

void addIntensity(const std::vector<float>& intensities, const std::vector<int>& kept, vtkDataSet* output)
{
  float largest = 0.0f;
  bool whole = true;
  for (const float value : intensities)
  {
    if (std::isfinite(value))
    {
      largest = std::max(largest, value);
      whole = whole && value >= 0.0f && value == std::floor(value);
    }
  }
  const float factor = (whole && largest <= 255.0f) || largest <= 0.0f ? 1.0f : 255.0f / largest;
  const auto array = newBytes("Intensity", 1, kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    const float value = std::round(factor * intensities[kept[i]]);
    *array->GetPointer(static_cast<vtkIdType>(i)) =
      value > 0.0f ? static_cast<unsigned char>(std::min(value, 255.0f)) : 0; // NaN is black
  }
  output->GetPointData()->SetScalars(array);
}

void addColors(const std::vector<std::uint8_t>& colors, const std::vector<int>& kept, vtkDataSet* output)
{
  const auto array = newBytes("RGB", 3, kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    std::copy_n(&colors[3 * static_cast<std::size_t>(kept[i])], 3, array->GetPointer(3 * static_cast<vtkIdType>(i)));
  }
  output->GetPointData()->SetScalars(array);
}

void addNormals(const meam::Points& normals, vtkDataSet* output)
{
  const auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName("Normals");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    std::copy_n(normals[i].data(), 3, array->GetPointer(3 * static_cast<vtkIdType>(i)));
  }
  output->GetPointData()->SetNormals(array);
}
}

void fromMeasuredCloud(const meam::MeasuredCloud& measured, vtkPointSet* output)
{
  auto* grid = vtkStructuredGrid::SafeDownCast(output);
  std::vector<int> kept;
  for (std::size_t i = 0; i < measured.cloud.size(); ++i)
  {
    if (grid || measured.cloud.points[i].allFinite())
    {
      kept.push_back(static_cast<int>(i));
    }
  }
  if (grid)
  {
    fromOrganizedCloud(measured.cloud, grid);
    if (!measured.normals.empty())
    {
      addNormals(measured.normals, grid);
    }
  }
  else
  {
    meam::PointCloud cloud;
    cloud.points = measured.cloud.points;
    cloud.normals = measured.normals;
    fromCloud(cloud.subset(kept), vtkPolyData::SafeDownCast(output));
  }
  if (!measured.intensities.empty())
  {
    addIntensity(measured.intensities, kept, output);
  }
  if (!measured.colors.empty())
  {
    addColors(measured.colors, kept, output);
  }
}

void addRegisteredImage(const meam::Image& image, vtkStructuredGrid* output)
{
  const auto array =
    newBytes(image.channels == 1 ? "Intensity" : "RGB", image.channels, image.pixels.size() / image.channels);
  std::copy(image.pixels.begin(), image.pixels.end(), array->GetPointer(0));
  output->GetPointData()->SetScalars(array);
}

meam::CameraFile calibrationOf(const char* file, const double focalLength[2], const double principalPoint[2])
{
  if (file && *file)
  {
    return meam::readCamera(file);
  }
  if (!(focalLength[0] > 0.0))
  {
    throw meam::Error("No camera is given: set CameraFile, or FocalLength and PrincipalPoint.");
  }
  meam::CameraFile result;
  result.camera.fx = focalLength[0];
  result.camera.fy = focalLength[1];
  result.camera.cx = principalPoint[0];
  result.camera.cy = principalPoint[1];
  return result;
}
}
