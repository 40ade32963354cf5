// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSceneConversion.h"

#include "base/Error.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMScanConversion.h"

#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkPointSet.h"
#include "vtkStructuredGrid.h"

#include <cmath>
#include <limits>
#include <string>

namespace vtkMEAMConversion
{
namespace
{
using meam::Error;

/// The points that are finite and not hidden; `ghosts` may be null.
template <typename Scalar>
meam::Points seenPoints(const Scalar* xyz, std::size_t count, vtkUnsignedCharArray* ghosts,
  const Eigen::Isometry3d& T_local_scene, int threads)
{
  bool isAnyHidden = false; // of those that have coordinates
  for (std::size_t i = 0; ghosts && !isAnyHidden && i < count; ++i)
  {
    isAnyHidden = isHidden(ghosts, i) && std::isfinite(xyz[3 * i]);
  }
  if (!isAnyHidden)
  {
    return meam::toLocalPoints(xyz, count, T_local_scene, threads);
  }
  std::vector<Scalar> seen(xyz, xyz + 3 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    seen[3 * i] = isHidden(ghosts, i) ? std::numeric_limits<Scalar>::quiet_NaN() : seen[3 * i];
  }
  return meam::toLocalPoints(seen.data(), count, T_local_scene, threads);
}
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
  const Eigen::Vector3d direction(viewDirection[0], viewDirection[1], viewDirection[2]);
  if (!direction.allFinite() || !(direction.norm() > 0.0))
  {
    throw Error("The view direction is zero: give the way the sensor looks, in the scene's coordinates.");
  }
  sensor.perspective = projection == PerspectiveProjection;
  sensor.direction = direction.normalized();
  sensor.position = Eigen::Vector3d(sensorPosition[0], sensorPosition[1], sensorPosition[2]);
  return sensor;
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

meam::Points surfaceOf(vtkDataSet* input, const char* what, const Eigen::Isometry3d& T_local_scene, int threads)
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
  vtkUnsignedCharArray* ghosts = grid ? ghostsOf(grid) : nullptr;
  meam::Points surface;
  if (auto* floats = vtkFloatArray::FastDownCast(array))
  {
    surface = seenPoints(floats->GetPointer(0), count, ghosts, T_local_scene, threads);
  }
  else if (count > 0)
  {
    const meam::PrecisePoints points = toVectors<double>(array);
    surface = seenPoints(points.front().data(), count, ghosts, T_local_scene, threads);
  }
  meam::requirePoints(count, surface.size(), what);
  return surface;
}
}
