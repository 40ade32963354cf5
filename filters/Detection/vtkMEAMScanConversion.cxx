// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMScanConversion.h"

#include "base/Error.h"
#include "base/Parallel.h"
#include "base/sequences/Sequences.h"
#include "io/CameraFile.h"
#include "scene/MeasuredCloud.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"

#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace vtkMEAMConversion
{
namespace
{
using meam::Error;

/// Values of an 8 bit image from an array of any type.
std::vector<std::uint8_t> toPixels(vtkDataArray* array, int channels)
{
  const vtkIdType count = array->GetNumberOfTuples();
  const int components = array->GetNumberOfComponents();
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(count) * channels);
  if (auto* bytes = vtkUnsignedCharArray::FastDownCast(array))
  {
    const unsigned char* from = count > 0 ? bytes->GetPointer(0) : nullptr;
    if (components == channels)
    {
      std::copy_n(from, pixels.size(), pixels.begin());
      return pixels;
    }
    for (auto to = pixels.begin(); to != pixels.end(); to += channels, from += components)
    {
      std::copy_n(from, channels, to);
    }
    return pixels;
  }
  // 16 bit images use their whole range.
  const double scale = array->GetDataType() == VTK_UNSIGNED_SHORT ? 1.0 / 257.0 : 1.0;
  std::size_t place = 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    for (int c = 0; c < channels; ++c)
    {
      const double value = std::round(scale * array->GetComponent(i, c));
      if (!(value >= 0.0 && value <= 255.0))
      {
        throw Error("The image has the value " + std::to_string(value) + ": grey values and colours go from 0 to 255.");
      }
      pixels[place++] = static_cast<std::uint8_t>(value);
    }
  }
  return pixels;
}

/// Points in single precision, NaN where they are blanked, from arrays as they lie in memory. `flags` may be null.
template <typename Scalar>
meam::Points toGrid(const Scalar* xyz, std::size_t count, const unsigned char* flags, int threads)
{
  meam::Points points(count);
  meam::parallelFor(static_cast<int>(count), threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        points[i] =
          Eigen::Map<const Eigen::Matrix<Scalar, 3, 1>>(xyz + 3 * static_cast<std::size_t>(i)).template cast<float>();
      }
      for (int i = begin; flags && i < end; ++i)
      {
        if (flags[i] & vtkDataSetAttributes::HIDDENPOINT)
        {
          points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
        }
      }
    });
  return points;
}

void addIntensity(const std::vector<float>& intensities, const std::vector<int>& kept, vtkDataSet* output)
{
  const std::vector<std::uint8_t> values = meam::greyValues(intensities);
  output->GetPointData()->SetScalars(
    columnOf<vtkUnsignedCharArray>("Intensity", kept, [&](int i) { return values[i]; }));
}

void addColors(const std::vector<std::uint8_t>& colors, const std::vector<int>& kept, vtkDataSet* output)
{
  std::vector<std::uint8_t> values;
  values.reserve(3 * kept.size());
  for (const int i : kept)
  {
    const auto color = colors.begin() + 3 * static_cast<std::ptrdiff_t>(i);
    values.insert(values.end(), color, color + 3);
  }
  output->GetPointData()->SetScalars(arrayOf<vtkUnsignedCharArray>("RGB", values, 3));
}
}

void requireLayer(vtkStructuredGrid* grid)
{
  int size[3];
  grid->GetDimensions(size);
  const vtkIdType count = grid->GetNumberOfPoints();
  if (count > 0 && (size[2] != 1 || static_cast<vtkIdType>(size[0]) * size[1] != count))
  {
    throw Error("The scene is a grid of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
                std::to_string(size[2]) + " points: an organized cloud is width x height x 1.");
  }
}

meam::OrganizedCloud toOrganizedCloud(vtkStructuredGrid* input, int threads)
{
  meam::OrganizedCloud cloud;
  requireLayer(input);
  int size[3];
  input->GetDimensions(size);
  const vtkIdType count = input->GetNumberOfPoints();
  if (count == 0 || !input->GetPoints() || input->GetPoints()->GetNumberOfPoints() != count)
  {
    return cloud;
  }
  cloud.width = size[0];
  cloud.height = size[1];
  vtkDataArray* array = input->GetPoints()->GetData();
  const unsigned char* flags = ghostsOf(input);
  if (auto* floats = vtkFloatArray::FastDownCast(array))
  {
    cloud.points = toGrid(floats->GetPointer(0), count, flags, threads);
  }
  else
  {
    const meam::PrecisePoints points = toVectors<double>(array);
    cloud.points = toGrid(points.front().data(), count, flags, threads);
  }
  return cloud;
}

void fromOrganizedCloud(const meam::OrganizedCloud& cloud, vtkStructuredGrid* output)
{
  output->SetDimensions(cloud.width, cloud.height, 1);
  output->SetPoints(toVTKPoints(cloud.points));
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(static_cast<vtkIdType>(cloud.size()));
  bool anyHidden = false;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const bool hidden = !cloud.points[i].allFinite();
    *ghosts->GetPointer(static_cast<vtkIdType>(i)) = hidden ? vtkDataSetAttributes::HIDDENPOINT : 0;
    anyHidden = anyHidden || hidden;
  }
  if (anyHidden)
  {
    output->GetPointData()->AddArray(ghosts);
  }
}

meam::OrganizedCloud toScanCloud(vtkPointSet* input, int threads)
{
  if (auto* grid = vtkStructuredGrid::SafeDownCast(input))
  {
    return toOrganizedCloud(grid, threads);
  }
  meam::OrganizedCloud cloud;
  for (const Eigen::Vector3d& point : toVectors<double>(input->GetPoints()->GetData()))
  {
    cloud.points.push_back(point.cast<float>());
  }
  cloud.width = static_cast<int>(cloud.size());
  cloud.height = 1;
  return cloud;
}

meam::Image imageOfCloud(vtkPointSet* input)
{
  meam::Image image;
  int size[3] = { static_cast<int>(input->GetNumberOfPoints()), 1, 1 };
  if (auto* grid = vtkStructuredGrid::SafeDownCast(input))
  {
    grid->GetDimensions(size);
  }
  image.width = size[0];
  image.height = size[1];
  vtkDataArray* pixels = pointArray(input, "Intensity", 1);
  if (!pixels)
  {
    pixels = pointArray(input, "RGB", 3);
    image.channels = 3;
  }
  if (!pixels)
  {
    return {};
  }
  image.pixels = toPixels(pixels, image.channels);
  return image;
}

meam::Image toImage(vtkImageData* input)
{
  meam::Image image;
  int size[3];
  input->GetDimensions(size);
  vtkDataArray* scalars = input->GetPointData()->GetScalars();
  if (!scalars && input->GetPointData()->GetNumberOfArrays() == 1)
  {
    scalars = input->GetPointData()->GetArray(0);
  }
  if (!scalars || scalars->GetNumberOfTuples() == 0)
  {
    throw Error("The image has no pixels: check the file.");
  }
  if (size[2] != 1)
  {
    throw Error("The image has " + std::to_string(size[2]) + " layers: one is expected.");
  }
  const int components = scalars->GetNumberOfComponents();
  if (components != 1 && components != 3 && components != 4)
  {
    throw Error("The image has " + std::to_string(components) + " components: 1 (grey), 3 or 4 (colour) are expected.");
  }
  image.width = size[0];
  image.height = size[1];
  image.channels = components == 1 ? 1 : 3;
  const std::vector<std::uint8_t> upwards = toPixels(scalars, image.channels);
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
  image.pixels.reserve(upwards.size());
  for (int y = image.height - 1; y >= 0; --y)
  {
    image.pixels.insert(image.pixels.end(), upwards.begin() + y * row, upwards.begin() + (y + 1) * row);
  }
  return image;
}

void fromImage(const meam::Image& image, vtkImageData* output)
{
  output->SetDimensions(image.width, image.height, 1);
  vtkNew<vtkUnsignedCharArray> scalars;
  scalars->SetName(image.channels == 1 ? "Intensity" : "RGB");
  scalars->SetNumberOfComponents(image.channels);
  scalars->SetNumberOfTuples(static_cast<vtkIdType>(image.width) * image.height);
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
  for (int y = 0; y < image.height; ++y)
  {
    std::copy(image.pixels.begin() + y * row, image.pixels.begin() + (y + 1) * row,
      scalars->GetPointer(0) + (image.height - 1 - y) * row);
  }
  output->GetPointData()->SetScalars(scalars);
}

void fromMeasuredCloud(const meam::MeasuredCloud& measured, vtkPointSet* output)
{
  auto* grid = vtkStructuredGrid::SafeDownCast(output);
  const std::vector<int> kept =
    meam::indicesWhere(measured.cloud.size(), [&](int i) { return grid || measured.cloud.points[i].allFinite(); });
  if (grid)
  {
    fromOrganizedCloud(measured.cloud, grid);
    if (!measured.normals.empty())
    {
      grid->GetPointData()->SetNormals(fromVectors(measured.normals, "Normals"));
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
  output->GetPointData()->SetScalars(
    arrayOf<vtkUnsignedCharArray>(image.channels == 1 ? "Intensity" : "RGB", image.pixels, image.channels));
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
