// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseEstimation.h"

#include "mesh/preparation/MeshPreparation.h"
#include "model/ModelTraining.h"
#include "pose/MEAMPoseEstimation.h"
#include "scene/Units.h"
#include "scene/edges/SceneEdgeExtraction.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMInstanceConversion.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneEdgeConversion.h"
#include "vtkMEAMSceneTime.h"
#include "vtkMEAMSharedData.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"
#include "vtkWeakPointer.h"

#include <string>
#include <tuple>
#include <utility>

vtkStandardNewMacro(vtkMEAMPoseEstimation);

namespace
{
// Shares of the work, for the progress.
constexpr double AfterSceneEdges = 0.1;
constexpr double AfterTraining = 0.5;
}

/// The trained model and what it was made of.
class vtkMEAMPoseEstimation::Training
{
public:
  /// What of the filter's settings the model depends on.
  using Settings = std::tuple<int, int, int, double, double, double, double>;

  std::shared_ptr<const meam::TrainedModel> modelOf(
    vtkDataObject* part, const Settings& settings, const meam::Progress& progress)
  {
    if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(part))
    {
      this->Part = nullptr;
      this->Model = vtkMEAMConversion::sharedModel(collection);
      this->Shape->Initialize();
      vtkMEAMConversion::fromCloud(this->Model->surface, this->Shape);
      return this->Model;
    }
    if (this->Part != part || this->Time != part->GetMTime() || this->Made != settings)
    {
      this->Part = nullptr; // until the new one is there
      this->Model = std::make_shared<const meam::TrainedModel>(this->train(part, settings, progress));
      this->Part = part;
      this->Time = part->GetMTime();
      this->Made = settings;
    }
    return this->Model;
  }

  /// What the part looks like: its prepared mesh or, of a trained model, points of its surface.
  vtkPolyData* shape() const { return this->Shape; }

private:
  meam::TrainedModel train(vtkDataObject* part, const Settings& settings, const meam::Progress& progress)
  {
    meam::MeshPreparationSettings preparation;
    int preset = 0, features = 0, seed = 0;
    Eigen::Vector3d& offset = preparation.offset;
    std::tie(preset, features, seed, preparation.scale, offset[0], offset[1], offset[2]) = settings;
    const meam::TriangleMesh mesh = vtkMEAMConversion::toMesh(vtkPolyData::SafeDownCast(part));
    const meam::PreparedMesh prepared = meam::prepareMesh(mesh, preparation, meam::subProgress(progress, 0.0, 0.2));
    this->Shape->Initialize();
    vtkMEAMConversion::fromMesh(prepared.mesh, this->Shape);
    meam::TrainingSettings training = meam::trainingSettings(static_cast<meam::Preset>(preset));
    training.sampling.seed = static_cast<unsigned>(seed);
    if (meam::takesFeatures(static_cast<meam::Preset>(preset)))
    {
      training.hashing.features = static_cast<meam::Features>(features);
    }
    return meam::trainModel(prepared.mesh, training, meam::subProgress(progress, 0.2, 1.0));
  }

  std::shared_ptr<const meam::TrainedModel> Model;
  vtkNew<vtkPolyData> Shape;
  vtkWeakPointer<vtkDataObject> Part;
  vtkMTimeType Time = 0;
  Settings Made;
};

vtkMEAMPoseEstimation::vtkMEAMPoseEstimation()
  : Trained(new Training)
{
  this->SetNumberOfInputPorts(4);
  this->SetNumberOfOutputPorts(5);
}

vtkMEAMPoseEstimation::~vtkMEAMPoseEstimation() { this->SetCameraFile(nullptr); }

int vtkMEAMPoseEstimation::FillInputPortInformation(int port, vtkInformation* info)
{
  static const char* const types[4][2] = { { "vtkPolyData", "vtkPartitionedDataSetCollection" },
    { "vtkStructuredGrid", "vtkPolyData" }, { "vtkPolyData", nullptr }, { "vtkImageData", nullptr } };
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  for (const char* type : types[port])
  {
    if (type)
    {
      info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
    }
  }
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1); // requireInputs
  return 1;
}

int vtkMEAMPoseEstimation::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port < 3 ? "vtkPolyData" : "vtkTable");
  return 1;
}

int vtkMEAMPoseEstimation::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneTime::announce(inputVector, { 1, 2, 3 }, outputVector);
  return 1;
}

int vtkMEAMPoseEstimation::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* info = inputVector[port]->GetInformationObject(0);
    if (info && info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
    {
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
        info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
    }
  }
  return 1;
}

int vtkMEAMPoseEstimation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkDataObject* part = vtkDataObject::GetData(inputVector[0]);
  auto* sceneInput = vtkPointSet::GetData(inputVector[1]);
  auto* organized = vtkStructuredGrid::SafeDownCast(sceneInput);
  auto* boundary = vtkPolyData::GetData(inputVector[2]);
  auto* image = vtkImageData::GetData(inputVector[3]);
  auto* output = vtkPolyData::GetData(outputVector, 0);
  auto* edges = vtkPolyData::GetData(outputVector, 1);
  auto* parts = vtkPolyData::GetData(outputVector, 2);
  auto* scores = vtkTable::GetData(outputVector, 3);
  auto* stages = vtkTable::GetData(outputVector, 4);
  return vtkMEAMRun(
    this,
    [&]
    {
      requireInputs(this, { "Part", "Scan" });
      const meam::Progress progress = progressOf(this);
      const double start = vtkTimerLog::GetUniversalTime();

      // What is wrong with the scene is told before any time goes into training.
      meam::requirePoints(sceneInput->GetNumberOfPoints(), sceneInput->GetNumberOfPoints(), "The scene");
      int size[3] = { 0, 0, 0 };
      if (organized)
      {
        organized->GetDimensions(size);
      }
      if (!boundary && size[1] <= 1)
      {
        throw meam::Error(
          "The scene is not organized, so that its edges cannot be taken from an image: give its edge "
          "points, the boundary, to Boundary, or an organized scan (a grid of width x height points) to "
          "Scene.");
      }
      meam::SceneInput scene;
      scene.sensor = sensorOf(this->Projection, this->ViewDirection, this->SensorPosition, sceneInput);
      meam::SceneEdges found; // of a scan
      if (boundary)
      {
        scene.edges = toLocalCloud(boundary, this->NumberOfThreads);
        meam::requirePoints(scene.edges.cloud.points, "The scene's boundary cloud");
      }
      else
      {
        const meam::OrganizedCloud cloud = toOrganizedCloud(organized, this->NumberOfThreads);
        meam::requirePoints(cloud.points, "The scene");
        meam::SceneEdgeExtractionSettings extraction = meam::sceneEdgeSettings(static_cast<meam::Preset>(this->Preset));
        extraction.imageEdges = this->ImageEdges;
        extraction.depthEdges &= this->DepthEdges;
        extraction.creases &= this->Creases;
        extraction.threads = this->NumberOfThreads;
        meam::Image pixels;
        if (this->ImageEdges)
        {
          pixels = image ? toImage(image) : imageOfCloud(organized);
          extraction.camera = cameraOf(this->CameraFile, image, cloud);
        }
        found = meam::extractSceneEdges(cloud, pixels, extraction, meam::subProgress(progress, 0.0, AfterSceneEdges));
        scene.edges = meam::toLocalCloud(found.cloud, this->NumberOfThreads);
        scene.edges.fromScan = true;
        scene.quality = found.quality;
      }
      const double extracted = vtkTimerLog::GetUniversalTime();
      scene.measured = surfaceOf(sceneInput, "The scene", scene.edges, this->NumberOfThreads);
      const std::size_t measured = scene.measured.size();
      const std::size_t edgePoints = scene.edges.cloud.size();
      const double loaded = vtkTimerLog::GetUniversalTime();

      const auto model = this->Trained->modelOf(part,
        { this->Preset, this->Features, this->Seed, this->CADScale, this->CADOffset[0], this->CADOffset[1],
          this->CADOffset[2] },
        meam::subProgress(progress, AfterSceneEdges, AfterTraining));
      const double trained = vtkTimerLog::GetUniversalTime();

      meam::DetectionSettings settings = meam::detectionSettings(static_cast<meam::Preset>(this->Preset),
        this->MaximumNumberOfPoses, this->NumberOfThreads, this->MinimumProbability);
      settings.detection.seed = static_cast<unsigned>(this->Seed);
      if (meam::takesFeatures(static_cast<meam::Preset>(this->Preset)))
      {
        settings.detection.features = static_cast<meam::Features>(this->Features);
      }
      if (this->ReferenceShare > 0.0)
      {
        settings.detection.referenceShare = this->ReferenceShare;
      }
      meam::DetectionReport report;
      const meam::Poses poses =
        meam::estimatePoses(*model, scene, settings, &report, meam::subProgress(progress, AfterTraining, 1.0));
      for (const std::string& warning :
        { meam::unitsWarning(scene.edges.cloud.points, model->diameter), meam::doubtsOf(poses) })
      {
        if (!warning.empty())
        {
          vtkWarningMacro(<< warning);
        }
      }

      if (boundary)
      {
        edges->ShallowCopy(boundary);
      }
      else
      {
        fromSceneEdges(found, edges);
      }
      fromPoses(poses, output);
      output->GetPointData()->SetActiveScalars("Rank");
      const InstanceSettings drawn;
      addLabels(poses, drawn.minimumProbability, output);
      fromInstances(
        this->Trained->shape(), poses, [](std::size_t k) { return static_cast<int>(k) + 1; }, drawn, {}, parts);
      setDiameter(output, model->diameter);
      setFieldText(output, "Report", meam::describe(poses));
      setScanQuality(output, scene.quality);
      if (report.edgeRates)
      {
        setFieldValue(output, "EdgesFound", report.edgeRates->found);
        setFieldValue(output, "EdgesByChance", report.edgeRates->chance);
      }
      const meam::StageTimes& times = report.times;
      const std::pair<const char*, double> seconds[] = { { "Training", trained - loaded },
        { "SceneEdges", extracted - start }, { "Scene", loaded - extracted + times.scene },
        { "Tangents", times.tangents }, { "Detection", times.detection }, { "Screening", times.screening },
        { "Verification", times.verification }, { "Refinement", times.refinement }, { "Selection", times.selection } };
      vtkNew<vtkStringArray> names;
      names->SetName("Stage");
      vtkNew<vtkDoubleArray> durations;
      durations->SetName("Seconds");
      for (const auto& [name, duration] : seconds)
      {
        setFieldValue(output, (std::string("Seconds") + name).c_str(), duration);
        names->InsertNextValue(name);
        durations->InsertNextValue(duration);
      }
      stages->AddColumn(names);
      stages->AddColumn(durations);
      vtkNew<vtkStringArray> ranks;
      ranks->SetName("Pose");
      for (std::size_t k = 1; k <= poses.size(); ++k)
      {
        ranks->InsertNextValue(std::to_string(k));
      }
      scores->AddColumn(ranks);
      for (const char* name : { "Probability", "Score", "VisibleFraction", "Certainty" })
      {
        scores->AddColumn(output->GetPointData()->GetArray(name));
      }
      setFieldValue(output, "ScenePoints", static_cast<double>(measured));
      setFieldValue(output, "SceneEdgePoints", static_cast<double>(edgePoints));
      setFieldValue(output, "ModelEdgePoints", static_cast<double>(model->edges.size()));
      setFieldValue(output, "SecondsTotal", vtkTimerLog::GetUniversalTime() - start);
    },
    output, edges, parts, scores, stages);
}

void vtkMEAMPoseEstimation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preset: " << meam::nameOf(static_cast<meam::Preset>(this->Preset)) << "\n";
  os << indent << "Features: " << meam::nameOf(static_cast<meam::Features>(this->Features)) << "\n";
  os << indent << "MaximumNumberOfPoses: " << this->MaximumNumberOfPoses << "\n";
  os << indent << "MinimumProbability: " << this->MinimumProbability << "\n";
  os << indent << "ReferenceShare: " << this->ReferenceShare << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "ImageEdges: " << this->ImageEdges << "\n";
  os << indent << "DepthEdges: " << this->DepthEdges << "\n";
  os << indent << "Creases: " << this->Creases << "\n";
  os << indent << "CameraFile: " << (this->CameraFile ? this->CameraFile : "(none)") << "\n";
  os << indent << "CADScale: " << this->CADScale << "\n";
  os << indent << "CADOffset: " << this->CADOffset[0] << " " << this->CADOffset[1] << " " << this->CADOffset[2] << "\n";
}
