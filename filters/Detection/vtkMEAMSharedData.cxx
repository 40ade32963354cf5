// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSharedData.h"

#include "base/LocalCloud.h"
#include "model/TrainedModel.h"
#include "scene/Scene.h"
#include "scene/Units.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneEdgeConversion.h"

#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstring>
#include <map>
#include <mutex>

namespace vtkMEAMConversion
{
namespace
{
/// Modification times and numbers. VTK's times count up over all objects of a process, so no two arrays have the same.
class Key
{
public:
  void add(vtkObject* object) { this->Words.push_back(object ? object->GetMTime() : 0); }
  void add(double number)
  {
    std::uint64_t word;
    std::memcpy(&word, &number, sizeof(word));
    this->Words.push_back(word);
  }
  void add(const double* numbers, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      this->add(numbers[i]);
    }
  }
  void addArrays(vtkFieldData* fields)
  {
    const int count = fields ? fields->GetNumberOfArrays() : 0;
    this->Words.push_back(count);
    for (int i = 0; i < count; ++i)
    {
      this->add(fields->GetAbstractArray(i));
    }
  }
  void addPoints(vtkDataSet* data)
  {
    auto* points = vtkPointSet::SafeDownCast(data);
    this->add(points && points->GetPoints() ? points->GetPoints()->GetData() : nullptr);
    this->add(data ? static_cast<double>(data->GetNumberOfPoints()) : -1.0);
    this->addArrays(data ? data->GetPointData() : nullptr);
  }
  bool operator<(const Key& other) const { return this->Words < other.Words; }

private:
  std::vector<std::uint64_t> Words;
};

/// What is there of one kind.
template <typename Data>
class Cache
{
public:
  std::shared_ptr<const Data> find(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = this->Entries.find(key);
    return found == this->Entries.end() ? nullptr : found->second.lock();
  }
  void insert(const Key& key, const std::shared_ptr<const Data>& data)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
    {
      entry = entry->second.expired() ? this->Entries.erase(entry) : std::next(entry);
    }
    this->Entries[key] = data;
  }

private:
  std::mutex Mutex;
  std::map<Key, std::weak_ptr<const Data>> Entries;
};

template <typename Data>
Cache<Data>& cacheOf()
{
  static Cache<Data> cache;
  return cache;
}

Key keyOf(vtkPartitionedDataSetCollection* model)
{
  Key key;
  key.addArrays(model->GetFieldData());
  for (unsigned int i = 0; i < model->GetNumberOfPartitionedDataSets(); ++i)
  {
    vtkPartitionedDataSet* set = model->GetPartitionedDataSet(i);
    vtkDataSet* data = set && set->GetNumberOfPartitions() > 0 ? set->GetPartition(0) : nullptr;
    key.addPoints(data);
    key.addArrays(data ? data->GetFieldData() : nullptr);
  }
  return key;
}

Key keyOf(vtkPolyData* poses)
{
  Key key;
  key.addPoints(poses);
  return key;
}

Key keyOf(vtkPolyData* mesh, const std::vector<double>& settings)
{
  Key key = keyOf(mesh);
  for (vtkCellArray* cells : { mesh->GetPolys(), mesh->GetStrips() })
  {
    key.add(cells ? cells->GetConnectivityArray() : nullptr);
  }
  key.add(settings.data(), static_cast<int>(settings.size()));
  return key;
}
}

std::shared_ptr<const meam::TrainedModel> sharedModel(vtkPartitionedDataSetCollection* input)
{
  const Key key = keyOf(input);
  std::shared_ptr<const meam::TrainedModel> model = cacheOf<meam::TrainedModel>().find(key);
  if (!model)
  {
    model = std::make_shared<const meam::TrainedModel>(toTrainedModel(input));
    cacheOf<meam::TrainedModel>().insert(key, model);
  }
  return model;
}

void shareModel(vtkPartitionedDataSetCollection* output, const std::shared_ptr<const meam::TrainedModel>& model)
{
  cacheOf<meam::TrainedModel>().insert(keyOf(output), model);
}

std::shared_ptr<const TrainedPart> sharedTraining(vtkPolyData* mesh, const std::vector<double>& settings)
{
  return cacheOf<TrainedPart>().find(keyOf(mesh, settings));
}

void shareTraining(
  vtkPolyData* mesh, const std::vector<double>& settings, const std::shared_ptr<const TrainedPart>& part)
{
  cacheOf<TrainedPart>().insert(keyOf(mesh, settings), part);
}

std::shared_ptr<const meam::Scene> sharedScene(
  vtkPointSet* edges, vtkDataSet* surface, const meam::Sensor& sensor, double partDiameter, int threads)
{
  Key key;
  key.addPoints(edges);
  key.addArrays(edges->GetFieldData());
  key.addPoints(surface);
  key.add(sensor.perspective ? 1.0 : 0.0);
  key.add(sensor.position.data(), 3);
  key.add(sensor.direction.data(), 3);
  key.add(partDiameter);
  std::shared_ptr<const meam::Scene> scene = cacheOf<meam::Scene>().find(key);
  if (!scene)
  {
    meam::SceneSettings settings;
    settings.threads = threads;
    meam::LocalCloud local = edgesOf(edges, threads);
    meam::requireSameUnits(local.cloud.points, partDiameter);
    const meam::Points measured = surfaceOf(surface, "The scene's surface", local, threads);
    scene = std::make_shared<const meam::Scene>(
      std::move(local), measured, sensor, partDiameter, settings, scanQualityOf(edges));
    cacheOf<meam::Scene>().insert(key, scene);
  }
  return scene;
}

std::shared_ptr<const meam::LocalPoses> sharedPoses(
  vtkPolyData* input, const meam::Scene& scene, const meam::Symmetries& symmetries)
{
  const Eigen::Isometry3d& T_local_scene = scene.T_local_scene();
  const std::shared_ptr<const meam::LocalPoses> known = cacheOf<meam::LocalPoses>().find(keyOf(input));
  if (known && known->T_local_scene.matrix() == T_local_scene.matrix())
  {
    return known;
  }
  return std::make_shared<const meam::LocalPoses>(
    meam::LocalPoses{ T_local_scene, meam::toLocalFrame(toPoses(input), T_local_scene, symmetries) });
}

std::shared_ptr<const meam::LocalPoses> sharePoses(
  meam::LocalPoses poses, const meam::TrainedModel& model, vtkPolyData* output)
{
  fromPoses(meam::toSceneFrame(poses.poses, poses.T_local_scene, model.symmetries), output);
  setDiameter(output, model.diameter);
  setPartExtent(output, model);
  const auto shared = std::make_shared<const meam::LocalPoses>(std::move(poses));
  cacheOf<meam::LocalPoses>().insert(keyOf(output), shared);
  return shared;
}
}
