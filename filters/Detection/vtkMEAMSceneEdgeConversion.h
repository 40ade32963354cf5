// SPDX-License-Identifier: BSD-3-Clause
/**
 * A scene's edges, and the camera that took its image, between VTK's data objects and the core. Not wrapped.
 */
#ifndef vtkMEAMSceneEdgeConversion_h
#define vtkMEAMSceneEdgeConversion_h

#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"

#include <optional>
#include <string>

namespace meam
{
struct SceneEdges;
struct ScanQuality;
}
class vtkDataArray;
class vtkDataObject;
class vtkImageData;
class vtkPointSet;
class vtkPolyData;

namespace vtkMEAMConversion
{
/// The camera beside the sensor that took an image: from a calibration file, when one is named, otherwise from the
/// image's field data `CameraMatrix` (9, row-major, pixels) and `CameraPose` (16, row-major T_camera_scene, mm). None
/// when neither is there, and when the field data say that the image is registered with the cloud. `image` may be null.
std::optional<meam::Camera> cameraOf(const char* file, vtkImageData* image, const meam::OrganizedCloud& cloud);
/// Edge points as fromCloud() has them, the point array `EdgeSource` and, as field data, how well the sensor measured.
void fromSceneEdges(const meam::SceneEdges& edges, vtkPolyData* output);
/// Their point array `EdgeSource`; null for edge points that were not found in a scan.
vtkDataArray* edgeSourcesOf(vtkPointSet* edges);
/// How well the sensor measured a scan, as the field data `ScanQuality`, whose components have names, and
/// `ScanReport`, the same in a sentence after what was assumed of the scan; nothing where nothing is known.
void setScanQuality(vtkDataObject* output, const meam::ScanQuality& quality, const std::string& assumed = {});
/// Not known where they are not there.
meam::ScanQuality scanQualityOf(vtkDataObject* input);
}

#endif
