// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the filters of a pipeline share of the core: trained models, scenes and poses in their local frame, keyed by the
 * modification times of the arrays that they were made of, which no other data have. So a model is parsed once and a
 * scene is indexed once, and poses go from filter to filter without being rounded. Entries live as long as a filter
 * holds them. Not wrapped.
 */
#ifndef vtkMEAMSharedData_h
#define vtkMEAMSharedData_h

#include "pose/Pose.h"

#include "vtkNew.h"
#include "vtkPolyData.h"

#include <cstdint>
#include <memory>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkObject;
class vtkPartitionedDataSetCollection;
class vtkPointSet;

namespace meam
{
struct LocalCloud;
struct Scene;
struct Sensor;
struct TrainedModel;
}

namespace vtkMEAMConversion
{
/// The core's model of a collection; throws as toTrainedModel() does.
std::shared_ptr<const meam::TrainedModel> sharedModel(vtkPartitionedDataSetCollection* input);
/// Lets others find the model that a collection was made of.
void shareModel(vtkPartitionedDataSetCollection* output, const std::shared_ptr<const meam::TrainedModel>& model);

/// A part that is known: its model, and what it looks like, the prepared mesh or points of the surface.
struct TrainedPart
{
  std::shared_ptr<const meam::TrainedModel> model;
  vtkNew<vtkPolyData> shape;
};
/// What a filter has trained of a mesh with settings (all that it depends on, as numbers), or null.
std::shared_ptr<const TrainedPart> sharedTraining(vtkPolyData* mesh, const std::vector<double>& settings);
/// Lets others find it.
void shareTraining(
  vtkPolyData* mesh, const std::vector<double>& settings, const std::shared_ptr<const TrainedPart>& part);

/// The scene of edge points with `Tangent` and a measured surface, which may be null, for parts of a diameter (mm).
/// Throws Error for what cannot be a scene.
std::shared_ptr<const meam::Scene> sharedScene(
  vtkPointSet* edges, vtkDataSet* surface, const meam::Sensor& sensor, double partDiameter, int threads);

/// Poses in the local frame of the scene: those that the filter before had, when the data are its own, otherwise from
/// their arrays.
std::shared_ptr<const meam::LocalPoses> sharedPoses(
  vtkPolyData* input, const meam::Scene& scene, const meam::Symmetries& symmetries);
/// Writes poses in the scene's coordinates, with the field data `Diameter`, and lets others find them in the local
/// frame.
std::shared_ptr<const meam::LocalPoses> sharePoses(
  meam::LocalPoses poses, const meam::TrainedModel& model, vtkPolyData* output);
}

#endif
