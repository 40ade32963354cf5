// SPDX-License-Identifier: BSD-3-Clause
/**
 * Between VTK's data objects and the core's: every filter converts in, calls the core, converts out.
 * Arrays and their shapes are those of the data contracts in docs/architecture.md. Not wrapped.
 */
#ifndef vtkMEAMConversion_h
#define vtkMEAMConversion_h

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"
#include "model/AppearanceModel.h"
#include "mesh/Symmetries.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"
#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"

#include "vtkAlgorithm.h"
#include "vtkObject.h"
#include "vtkSetGet.h"

#include <array>
#include <optional>
#include <vector>

namespace meam
{
struct CameraFile;
struct EdgeTangents;
struct MeasuredCloud;
struct SceneEdges;
}
class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkFieldData;
class vtkImageData;
class vtkPartitionedDataSetCollection;
class vtkPointSet;
class vtkPolyData;
class vtkStructuredGrid;

namespace vtkMEAMConversion
{
/// Polygons and strips become triangles. Coordinates as they are.
meam::TriangleMesh toMesh(vtkPolyData* input);
void fromMesh(const meam::TriangleMesh& mesh, vtkPolyData* output);

/// Points with the arrays `Normals`, `Tangent` (3 components each), `PointId` and `EdgeType`, where they are there.
meam::PointCloud toCloud(vtkPointSet* input);
/// The same arrays, `Weight` where it is known, and a vertex cell for each point.
void fromCloud(const meam::PointCloud& cloud, vtkPolyData* output);
/// Edge points with the arrays `Tangent`, made unit, and `Weight`, where they are there.
meam::PreciseCloud toPreciseCloud(vtkPointSet* input);
/// Of `input` the points that stay, in the precision they have there, with the arrays of toCloud(), `Tangent` in double
/// precision and `Weight`.
void fromEdgeTangents(const meam::EdgeTangents& edges, vtkPointSet* input, vtkPolyData* output);

/// W x H x 1; blanked points become NaN. Throws for a grid that is not a single layer.
meam::OrganizedCloud toOrganizedCloud(vtkStructuredGrid* input);
/// NaN points are blanked.
void fromOrganizedCloud(const meam::OrganizedCloud& cloud, vtkStructuredGrid* output);
/// From the point array `Intensity` (1 component) or `RGB` (3) of an organized cloud. Throws without.
meam::Image imageOfCloud(vtkStructuredGrid* input);
/// From image scalars of 1, 3 or 4 components; VTK's images start at the lower left, ours at the upper left.
meam::Image toImage(vtkImageData* input);
void fromImage(const meam::Image& image, vtkImageData* output);

/// An organized cloud for a vtkStructuredGrid, otherwise a vertex for each point that has depth; `Normals`, `Intensity`
/// (whole numbers from 0 to 255 are kept, other values are spread so that the largest becomes 255) and `RGB` where
/// they are known.
void fromMeasuredCloud(const meam::MeasuredCloud& measured, vtkPointSet* output);
/// The point array `Intensity` or `RGB` of an organized cloud.
void addRegisteredImage(const meam::Image& image, vtkStructuredGrid* output);
/// The sensor's calibration: that of the file, when one is named, otherwise a pinhole. Throws Error for neither.
meam::CameraFile calibrationOf(const char* file, const double focalLength[2], const double principalPoint[2]);

/// The camera beside the sensor that took an image: from a calibration file, when one is named, otherwise from the
/// image's field data `CameraMatrix` (9, row-major, pixels) and `CameraPose` (16, row-major T_camera_scene, mm). None
/// when neither is there, and when the field data say that the image is registered with the cloud. `image` may be null.
std::optional<meam::Camera> cameraOf(const char* file, vtkImageData* image, const meam::OrganizedCloud& cloud);
/// Edge points as fromCloud() has them, and the point array `EdgeSource`.
void fromSceneEdges(const meam::SceneEdges& edges, vtkPolyData* output);
/// Their point array `EdgeSource`; null for edge points that were not found in a scan.
vtkDataArray* edgeSourcesOf(vtkPointSet* edges);
/// P_ref: of edges found in a scan more than of others.
double referenceShareOf(vtkPolyData* edges);

/// One partition for each viewpoint, named, with the field data `ViewDirection` (3) and, where it is known,
/// `Viewpoint` (3, mm); `WholePart` (1) stands where there is no viewpoint at all.
std::vector<meam::AppearanceModel> toAppearanceModels(vtkPartitionedDataSetCollection* input);
void fromAppearanceModels(const std::vector<meam::AppearanceModel>& models, vtkPartitionedDataSetCollection* output);

/// Throws Error for another version, for missing parts and for arrays whose lengths do not fit.
meam::TrainedModel toTrainedModel(vtkPartitionedDataSetCollection* input);
void fromTrainedModel(const meam::TrainedModel& model, vtkPartitionedDataSetCollection* output);

/// One vertex for each pose, best first: `Transform` (16, row-major T_scene_model), `Quaternion` (x y z w),
/// `Score`, `Probability`, `Votes`, `ViewId`, `VisibleFraction`, `Certainty`, `Rank` (from 1); of refined poses `Residual`,
/// `Iterations`, `Covariance` (36), `ConstrainedDegreesOfFreedom` and `ConstrainedAxes` (6).
meam::Poses toPoses(vtkPolyData* input);
void fromPoses(const meam::Poses& poses, vtkPolyData* output);

/// d_max in mm travels with the part from step to step as the field data `Diameter`; 0 when it is not there.
double diameterOf(vtkDataObject* input);
void setDiameter(vtkDataObject* output, double diameter);
/// A part's symmetries travel with its samples and its trained model as the field data `SymmetriesDiscrete` (16 components,
/// row-major), `SymmetriesContinuous` (6: unit axis and a point on it), `NearSymmetries` (16), `NearSymmetryOverlap`
/// and `NearSymmetryDeviation` (mm). None when they are not there, or for null. Throws Error for values that are no
/// rotations.
meam::Symmetries symmetriesOf(vtkDataObject* input);
void setSymmetries(vtkDataObject* output, const meam::Symmetries& symmetries);
/// Middle of the box around a part's samples or the surface of its trained model, mm; the origin for null and for what
/// has no points.
std::array<double, 3> middleOf(vtkDataObject* input);
/// A number as field data; replaces an array of that name.
void setFieldValue(vtkDataObject* output, const char* name, double value);

/// The property `Projection` of the filters that need to know where the scene is seen from.
enum Projection
{
  AutomaticProjection,    ///< perspective from the origin along +z for an organized cloud, otherwise orthographic
  OrthographicProjection, ///< along the view direction
  PerspectiveProjection   ///< from the sensor position, looking along the view direction
};

/// Where the scene is seen from; `surface` may be null. Throws Error for a view direction of zero.
meam::Sensor sensorOf(
  int projection, const double viewDirection[3], const double sensorPosition[3], vtkDataSet* surface);
/// Finite edge points with `Tangent`, and `Weight` where it is there. Throws Error without points or tangents.
meam::PreciseCloud edgesOf(vtkPointSet* input);
/// The points that a sensor measured, but for blanked ones; none for null. Throws Error, naming `what`, without points and
/// for a grid that is not a single layer.
meam::FramedPoints surfaceOf(vtkDataSet* input, const char* what, int threads);
/// Both, for the filters that judge poses.
meam::Scene sceneOf(vtkPointSet* edges, vtkDataSet* surface, const meam::Sensor& sensor, int threads);

/// Progress and abort of a filter as the core asks for them.
meam::Progress progressOf(vtkAlgorithm* filter);
}

/**
 * The body of a RequestData: what the core throws becomes an error on VTK's channel with nothing in the
 * output, a wish to stop becomes an empty output. `work` is a callable, `outputs...` the data objects to
 * empty when it fails.
 */
template <typename Work, typename... Outputs>
int vtkMEAMRun(vtkAlgorithm* self, Work&& work, Outputs*... outputs)
{
  try
  {
    work();
    return 1;
  }
  catch (const meam::Aborted&)
  {
    (outputs->Initialize(), ...);
    return 1;
  }
  catch (const std::exception& error)
  {
    (outputs->Initialize(), ...);
    vtkErrorWithObjectMacro(self, << error.what());
    return 0;
  }
}

#endif
