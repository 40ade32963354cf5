// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the filters that find poses know of a scene: edge points, surface, sensor. Not wrapped.
 */
#ifndef vtkMEAMSceneConversion_h
#define vtkMEAMSceneConversion_h

#include "base/LocalCloud.h"
#include "scene/Sensor.h"

#include <optional>

class vtkDataObject;
class vtkDataSet;
class vtkPointSet;

namespace vtkMEAMConversion
{
/// The property `Projection` of the filters that need to know where the scene is seen from.
enum Projection
{
  AutomaticProjection, ///< as the points tell; with given edges perspective from the origin along +z for an organized
                       ///< cloud, otherwise orthographic
  OrthographicProjection, ///< along the view direction
  PerspectiveProjection   ///< from the sensor position, looking along the view direction
};

/// Where the scene is seen from; `surface` may be null. With a view direction of zero a perspective sensor looks at the
/// middle of the surface. Throws Error for another view direction of zero.
meam::Sensor sensorOf(
  int projection, const double viewDirection[3], const double sensorPosition[3], vtkDataSet* surface);
/// The same where the filter's properties say it, or the scan's file by `Sensor`; none where the points have to tell.
std::optional<meam::Sensor> givenSensor(
  int projection, const double viewDirection[3], const double sensorPosition[3], vtkDataSet* surface);
/// The sensor of a scan's file as its field data `Sensor`: position, then direction, (0, 0, 0) for at the points'
/// middle.
void fromSensor(const std::optional<meam::Sensor>& sensor, vtkDataObject* output);
/// A scene's edge points with `Tangent`, and `Weight` where it is there, in their local frame. Throws Error without
/// points or tangents.
meam::LocalCloud edgesOf(vtkPointSet* input, int threads);
/// The points that a sensor measured, but for blanked and invalid ones, in the local frame of the scene's edges; none
/// for null. Throws Error, naming `what`, without points and for a grid that is not a single layer.
meam::Points surfaceOf(vtkDataSet* input, const char* what, const meam::LocalCloud& edges, int threads);
}

#endif
