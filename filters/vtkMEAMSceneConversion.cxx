// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSceneConversion.h"

#include "base/Error.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMScanConversion.h"

#include "vtkDataSetAttributes.h"
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

/// The points that are finite and not hidden; `flags` may be null.
template <typename Scalar>
meam::FramedPoints seenPoints(const Scalar* xyz, std::size_t count, const unsigned char* flags, int threads)
{
  const auto isHidden = [flags](std::size_t i) { return (flags[i] & vtkDataSetAttributes::HIDDENPOINT) != 0; };
  std::size_t first = flags ? 0 : count; // hidden, but with coordinates
  while (first < count && !(isHidden(first) && std::isfinite(xyz[3 * first])))
  {
    ++first;
  }
  if (first == count)
  {
    return meam::inOwnFrame(xyz, count, threads);
  }
  std::vector<Scalar> seen(xyz, xyz + 3 * count);
  for (std::size_t i = first; i < count; ++i)
  {
    seen[3 * i] = isHidden(i) ? std::numeric_limits<Scalar>::quiet_NaN() : seen[3 * i];
  }
  return meam::inOwnFrame(seen.data(), count, threads);
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

meam::PreciseCloud edgesOf(vtkPointSet* input)
{
  const meam::PreciseCloud all = toPreciseCloud(input);
  meam::PreciseCloud finite;
  for (std::size_t i = 0; i < all.points.size(); ++i)
  {
    const bool directed = all.tangents.empty() || (all.tangents[i].allFinite() && !all.tangents[i].isZero());
    if (!all.points[i].allFinite() || !directed)
    {
      continue;
    }
    finite.points.push_back(all.points[i]);
    if (!all.tangents.empty())
    {
      finite.tangents.push_back(all.tangents[i]);
    }
    if (!all.weights.empty())
    {
      finite.weights.push_back(all.weights[i]);
    }
  }
  meam::requirePoints(all.points.size(), finite.points.size(), "The scene's edge cloud");
  if (finite.tangents.empty())
  {
    throw Error("The scene's edge points have no point array 'Tangent': use TangentEstimation first.");
  }
  return finite;
}

meam::FramedPoints surfaceOf(vtkDataSet* input, const char* what, int threads)
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
  const unsigned char* ghosts = grid ? ghostsOf(grid) : nullptr;
  meam::FramedPoints surface;
  if (auto* floats = vtkFloatArray::FastDownCast(array))
  {
    surface = seenPoints(floats->GetPointer(0), count, ghosts, threads);
  }
  else if (count > 0)
  {
    const meam::PrecisePoints points = toVectors<double>(array);
    surface = seenPoints(points.front().data(), count, ghosts, threads);
  }
  meam::requirePoints(count, surface.points.size(), what);
  return surface;
}

meam::Scene sceneOf(vtkPointSet* edges, vtkDataSet* surface, const meam::Sensor& sensor, int threads)
{
  return meam::sceneInOwnFrame(edgesOf(edges), surfaceOf(surface, "The scene's surface", threads), sensor);
}
}
