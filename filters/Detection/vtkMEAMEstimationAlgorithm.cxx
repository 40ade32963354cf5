// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMEstimationAlgorithm.h"

#include "pose/DetectionChoices.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMEstimationWork.h"
#include "vtkMEAMPartTrainer.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneEdgeConversion.h"
#include "vtkMEAMSceneRequests.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkTimerLog.h"

#include <vector>

namespace
{
constexpr double AfterSceneEdges = 0.1; // of the work, for the progress
}

/// The trained model and what it was made of.
class vtkMEAMEstimationAlgorithm::Training
{
public:
  std::shared_ptr<const vtkMEAMConversion::TrainedPart> partOf(
    vtkDataObject* input, const vtkMEAMPartTrainer::Choices& choices, const meam::Progress& progress)
  {
    using namespace vtkMEAMConversion;
    if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(input))
    {
      const auto model = sharedModel(collection);
      if (!this->Part || this->Part->model != model)
      {
        auto part = std::make_shared<TrainedPart>();
        part->model = model;
        fromCloud(model->surface, part->shape);
        this->Part = part;
      }
      return this->Part;
    }
    auto* mesh = vtkPolyData::SafeDownCast(input);
    const std::vector<double> numbers{ static_cast<double>(choices.preset), static_cast<double>(choices.features),
      static_cast<double>(choices.seed), choices.scale, choices.offset[0], choices.offset[1], choices.offset[2] };
    const auto known = sharedTraining(mesh, numbers);
    if (!known)
    {
      this->Part = nullptr; // until the new one is there
      const auto trained = vtkMEAMPartTrainer::Create()->Train(mesh, choices, progress);
      shareTraining(mesh, numbers, trained);
      this->Part = trained;
      return this->Part;
    }
    this->Part = known;
    return this->Part;
  }

private:
  std::shared_ptr<const vtkMEAMConversion::TrainedPart> Part; ///< what other filters find as long as this one holds it
};

vtkMEAMEstimationAlgorithm::vtkMEAMEstimationAlgorithm()
  : Trained(new Training)
{
  this->SetNumberOfInputPorts(4);
}

vtkMEAMEstimationAlgorithm::~vtkMEAMEstimationAlgorithm() { this->SetCameraFile(nullptr); }

int vtkMEAMEstimationAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
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

int vtkMEAMEstimationAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneRequests::announceTime(inputVector, { 1, 2, 3 }, outputVector);
  return 1;
}

int vtkMEAMEstimationAlgorithm::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkMEAMSceneRequests::askForWhole(inputVector, this->GetNumberOfInputPorts());
  return 1;
}

vtkMEAMEstimationAlgorithm::Work vtkMEAMEstimationAlgorithm::Prepare(vtkInformationVector** inputVector)
{
  using namespace vtkMEAMConversion;
  vtkDataObject* part = vtkDataObject::GetData(inputVector[0]);
  auto* sceneInput = vtkPointSet::GetData(inputVector[1]);
  auto* organized = vtkStructuredGrid::SafeDownCast(sceneInput);
  auto* boundary = vtkPolyData::GetData(inputVector[2]);
  auto* image = vtkImageData::GetData(inputVector[3]);
  const meam::Progress progress = progressOf(this);
  meam::DetectionChoices choices;
  choices.preset = static_cast<meam::Preset>(this->Preset);
  choices.features = static_cast<meam::Features>(this->Features);
  choices.maximumPoses = this->MaximumNumberOfPoses;
  choices.minimumProbability = this->MinimumProbability;
  choices.partIsPresent = this->PartIsPresent;
  choices.referenceShare = this->ReferenceShare;
  choices.imageEdges = this->ImageEdges;
  choices.depthEdges = this->DepthEdges;
  choices.creases = this->Creases;
  choices.seed = static_cast<unsigned>(this->Seed);
  choices.threads = this->NumberOfThreads;
  Work work;
  double last = vtkTimerLog::GetUniversalTime();
  const auto watch = [&last]
  {
    const double before = last;
    last = vtkTimerLog::GetUniversalTime();
    return last - before;
  };

  // What is wrong with the scene is told before any time goes into training.
  meam::requirePoints(sceneInput->GetNumberOfPoints(), sceneInput->GetNumberOfPoints(), "The scene");
  int size[3] = { 0, 0, 0 };
  if (organized)
  {
    organized->GetDimensions(size);
  }
  if (!boundary && size[1] <= 1)
  {
    throw meam::Error("The scene is not organized, so that its edges cannot be taken from an image: give its edge "
                      "points, the boundary, to Boundary, or an organized scan (a grid of width x height points) to "
                      "Scene.");
  }
  meam::SceneInput& scene = work.scene;
  scene.sensor = sensorOf(this->Projection, this->ViewDirection, this->SensorPosition, sceneInput);
  if (boundary)
  {
    scene.edges = toLocalCloud(boundary, this->NumberOfThreads);
    meam::requirePoints(scene.edges.cloud.points, "The scene's boundary cloud");
  }
  else
  {
    const meam::OrganizedCloud cloud = toOrganizedCloud(organized, this->NumberOfThreads);
    meam::requirePoints(cloud.points, "The scene");
    meam::SceneEdgeExtractionSettings extraction = meam::sceneEdgeSettings(choices);
    meam::Image pixels;
    if (this->ImageEdges)
    {
      pixels = image ? toImage(image) : imageOfCloud(organized);
      extraction.camera = cameraOf(this->CameraFile, image, cloud);
    }
    work.found = meam::extractSceneEdges(cloud, pixels, extraction, meam::subProgress(progress, 0.0, AfterSceneEdges));
    meam::setFoundEdges(work.found, this->NumberOfThreads, scene);
  }
  work.secondsEdges = watch();
  scene.measured = surfaceOf(sceneInput, "The scene", scene.edges, this->NumberOfThreads);
  work.secondsLoading = watch();

  work.part = this->Trained->partOf(part,
    { choices.preset, choices.features, choices.seed, this->CADScale,
      { this->CADOffset[0], this->CADOffset[1], this->CADOffset[2] } },
    meam::subProgress(progress, AfterSceneEdges, Work::Prepared));
  work.secondsTraining = watch();

  work.settings = meam::detectionSettings(choices);
  return work;
}

void vtkMEAMEstimationAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preset: " << meam::nameOf(static_cast<meam::Preset>(this->Preset)) << "\n";
  os << indent << "Features: " << meam::nameOf(static_cast<meam::Features>(this->Features)) << "\n";
  os << indent << "MaximumNumberOfPoses: " << this->MaximumNumberOfPoses << "\n";
  os << indent << "MinimumProbability: " << this->MinimumProbability << "\n";
  os << indent << "PartIsPresent: " << this->PartIsPresent << "\n";
  os << indent << "ReferenceShare: " << this->ReferenceShare << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "ImageEdges: " << this->ImageEdges << "\n";
  os << indent << "DepthEdges: " << this->DepthEdges << "\n";
  os << indent << "Creases: " << this->Creases << "\n";
  os << indent << "CameraFile: " << (this->CameraFile ? this->CameraFile : "(none)") << "\n";
  os << indent << "CADScale: " << this->CADScale << "\n";
  os << indent << "CADOffset: " << this->CADOffset[0] << " " << this->CADOffset[1] << " " << this->CADOffset[2] << "\n";
}
