// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSceneConversion.h"

#include "base/Error.h"
#include "scene/preparation/ScanViewpoint.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMScanConversion.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPointSet.h"
#include "vtkStructuredGrid.h"

namespace vtkMEAMConversion
{
namespace
{
using meam::Error;
}

meam::Sensor sensorOf(
  int projection, const double viewDirection[3], const double sensorPosition[3], vtkDataSet* surface)
{
  int size[3] = { 0, 0, 0 };
  if (auto* grid = vtkStructuredGrid::SafeDownCast(surface))
  {
    grid->GetDimensions(size);
  }
  meam::Sensor sensor;
  if (projection == AutomaticProjection && size[0] > 1 && size[1] > 1 && size[2] == 1)
  {
    return sensor; // the data contract: an organized cloud is in its sensor's frame
  }
  sensor.perspective = projection == PerspectiveProjection;
  sensor.direction = Eigen::Vector3d(viewDirection);
  sensor.position = Eigen::Vector3d(sensorPosition);
  auto* measured = vtkPointSet::SafeDownCast(surface);
  const bool looksAtPoints = sensor.perspective && sensor.direction.isZero(0.0) && measured;
  sensor.direction = meam::lookingDirection(sensor, looksAtPoints ? toScanCloud(measured).points : meam::Points());
  if (sensor.direction.isZero(0.0))
  {
    throw Error(
      "The view direction is zero: set ViewDirection to the way the sensor looks, in the scene's coordinates.");
  }
  return sensor;
}

std::optional<meam::Sensor> givenSensor(
  int projection, const double viewDirection[3], const double sensorPosition[3], vtkDataSet* surface)
{
  const bool isFromAbove = viewDirection[0] == 0.0 && viewDirection[1] == 0.0 && viewDirection[2] < 0.0;
  const bool isDefault = isFromAbove || vtkStructuredGrid::SafeDownCast(surface);
  if (projection != AutomaticProjection || !isDefault)
  {
    return sensorOf(projection, viewDirection, sensorPosition, surface);
  }
  auto* ofFile = surface ? surface->GetFieldData()->GetArray("Sensor") : nullptr;
  if (!ofFile || ofFile->GetNumberOfComponents() != 6 || ofFile->GetNumberOfTuples() != 1)
  {
    return std::nullopt;
  }
  double values[6];
  ofFile->GetTuple(0, values);
  return sensorOf(PerspectiveProjection, values + 3, values, surface);
}

void fromSensor(const std::optional<meam::Sensor>& sensor, vtkDataObject* output)
{
  output->GetFieldData()->RemoveArray("Sensor");
  if (sensor)
  {
    Eigen::Matrix<double, 6, 1> numbers;
    numbers << sensor->position, sensor->direction;
    output->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>("Sensor", numbers, 6));
  }
}

meam::LocalCloud edgesOf(vtkPointSet* input, int threads)
{
  meam::LocalCloud edges = toLocalCloud(input, threads);
  const std::size_t count = edges.cloud.size();
  edges.cloud = meam::finitePoints(std::move(edges.cloud));
  meam::requirePoints(count, edges.cloud.size(), "The scene's edge cloud");
  if (edges.cloud.tangents.empty())
  {
    throw Error("The scene's edge points have no point array 'Tangent': use TangentEstimation first.");
  }
  return edges;
}

meam::Points surfaceOf(vtkDataSet* input, const char* what, const meam::LocalCloud& edges, int threads)
{
  auto* measured = vtkPointSet::SafeDownCast(input);
  if (!measured)
  {
    return {};
  }
  auto* grid = vtkStructuredGrid::SafeDownCast(measured);
  if (grid)
  {
    requireLayer(grid);
  }
  vtkDataArray* array = measured->GetNumberOfPoints() > 0 ? measured->GetPoints()->GetData() : nullptr;
  const std::size_t count = array ? array->GetNumberOfTuples() : 0;
  const unsigned char* flags = grid ? ghostsOf(grid) : nullptr;
  constexpr std::uint8_t hidden = vtkDataSetAttributes::HIDDENPOINT;
  meam::Points surface;
  if (auto* floats = vtkFloatArray::FastDownCast(array))
  {
    surface = meam::toLocalPoints(
      meam::ScanPoints<float>{ floats->GetPointer(0), count, flags, hidden }, edges.T_local_scene, threads);
  }
  else if (count > 0)
  {
    const meam::PrecisePoints points = toVectors<double>(array);
    surface = meam::toLocalPoints(
      meam::ScanPoints<double>{ points.front().data(), count, flags, hidden }, edges.T_local_scene, threads);
  }
  meam::requirePoints(count, surface.size(), what);
  return surface;
}
}
