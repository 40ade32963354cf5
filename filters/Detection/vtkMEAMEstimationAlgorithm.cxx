// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMEstimationAlgorithm.h"

#include "features/TrainSettings.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMEstimationWork.h"
#include "vtkMEAMPartNames.h"
#include "vtkMEAMPartTrainer.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneEdgeConversion.h"
#include "vtkMEAMSceneRequests.h"
#include "vtkMEAMSettings.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace
{
constexpr double AfterSceneEdges = 0.1; // of the work, for the progress

/// As the property and the point array `Region` of the scan say it.
meam::Region regionOf(const double ends[6], vtkPointSet* scan)
{
  meam::Region region;
  if (std::any_of(ends, ends + 6, [](double end) { return end != 0.0; }))
  {
    region.box =
      Eigen::AlignedBox3d(Eigen::Vector3d(ends[0], ends[2], ends[4]), Eigen::Vector3d(ends[1], ends[3], ends[5]));
  }
  if (vtkDataArray* mask = vtkMEAMConversion::pointArray(scan, "Region", 1))
  {
    for (vtkIdType i = 0; i < mask->GetNumberOfTuples(); ++i)
    {
      region.mask.push_back(mask->GetComponent(i, 0) != 0.0 ? 1 : 0);
    }
  }
  return region;
}
}

/// The trained models, in the order of their parts, and what they were made of.
class vtkMEAMEstimationAlgorithm::Training
{
public:
  using Parts = std::vector<std::shared_ptr<const vtkMEAMConversion::TrainedPart>>;

  const Parts& partsOf(
    vtkInformationVector* inputs, const meam::TrainSettings& settings, const meam::Progress& progress)
  {
    const int count = inputs->GetNumberOfInformationObjects();
    this->Known.resize(count);
    for (int i = 0; i < count; ++i)
    {
      this->update(vtkDataObject::GetData(inputs, i), settings,
        meam::subProgress(progress, static_cast<double>(i) / count, (i + 1.0) / count), this->Known[i]);
    }
    return this->Known;
  }

private:
  static void update(vtkDataObject* input, const meam::TrainSettings& settings, const meam::Progress& progress,
    std::shared_ptr<const vtkMEAMConversion::TrainedPart>& known)
  {
    using namespace vtkMEAMConversion;
    if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(input))
    {
      const auto model = sharedModel(collection);
      if (!known || known->model != model)
      {
        auto part = std::make_shared<TrainedPart>();
        part->model = model;
        fromCloud(model->surface, part->shape);
        known = part;
      }
      return;
    }
    auto* mesh = vtkPolyData::SafeDownCast(input);
    const std::vector<double> numbers{ static_cast<double>(settings.preset), static_cast<double>(settings.features),
      static_cast<double>(settings.seed), settings.scale, settings.offset[0], settings.offset[1], settings.offset[2] };
    if (const auto shared = sharedTraining(mesh, numbers))
    {
      known = shared;
      return;
    }
    known = nullptr; // until the new one is there
    const auto trained = vtkMEAMPartTrainer::Create("To train the part's CAD mesh", "give a trained model to Part")
                           ->Train(mesh, settings, progress);
    shareTraining(mesh, numbers, trained);
    known = trained;
  }

  Parts Known; ///< what other filters find as long as this one holds it
};

vtkMEAMEstimationAlgorithm::vtkMEAMEstimationAlgorithm()
  : Trained(new Training)
  , Settings(std::make_unique<meam::DetectSettings>())
{
  this->SetNumberOfInputPorts(4);
}

vtkMEAMEstimationAlgorithm::~vtkMEAMEstimationAlgorithm() { this->SetCameraFile(nullptr); }

vtkMEAMClampedSettingMacro(vtkMEAMEstimationAlgorithm, Preset, int, preset, Paper, B2B);
vtkMEAMClampedSettingMacro(vtkMEAMEstimationAlgorithm, Features, int, features, Edges, Both);
vtkMEAMClampedSettingMacro(vtkMEAMEstimationAlgorithm, MaximumNumberOfPoses, int, maximumPoses, 0, VTK_INT_MAX);
vtkMEAMClampedSettingMacro(vtkMEAMEstimationAlgorithm, MinimumProbability, double, minimumProbability, 0.0, 1.0);
vtkMEAMSettingMacro(vtkMEAMEstimationAlgorithm, RotationCounts, bool, rotationCounts);
vtkMEAMClampedSettingMacro(vtkMEAMEstimationAlgorithm, ReferenceShare, double, referenceShare, 0.0, 1.0);
vtkMEAMClampedSettingMacro(vtkMEAMEstimationAlgorithm, TimeLimit, double, timeLimit, 0.0, VTK_DOUBLE_MAX);
vtkMEAMClampedSettingMacro(vtkMEAMEstimationAlgorithm, Seed, int, seed, 0, VTK_INT_MAX);
vtkMEAMSettingMacro(vtkMEAMEstimationAlgorithm, ImageEdges, bool, imageEdges);
vtkMEAMSettingMacro(vtkMEAMEstimationAlgorithm, DepthEdges, bool, depthEdges);
vtkMEAMSettingMacro(vtkMEAMEstimationAlgorithm, Creases, bool, creases);

int vtkMEAMEstimationAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  switch (port)
  {
    case 0:
      return fillInputPort(info, { "vtkPolyData", "vtkPartitionedDataSetCollection" }, Connections::Any);
    case 1:
      return fillInputPort(info, { "vtkStructuredGrid", "vtkPolyData" }, Connections::OneOrNone);
    case 2:
      return fillInputPort(info, { "vtkPolyData", "vtkStructuredGrid" }, Connections::OneOrNone);
    default:
      return fillInputPort(info, { "vtkImageData" }, Connections::OneOrNone);
  }
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
  auto* sceneInput = vtkPointSet::GetData(inputVector[1]);
  auto* boundary = vtkPointSet::GetData(inputVector[2]);
  auto* image = vtkImageData::GetData(inputVector[3]);
  const meam::Progress progress = progressOf(this);
  meam::DetectSettings& settings = *this->Settings;
  settings.threads = this->NumberOfThreads;
  Work work;
  double last = vtkTimerLog::GetUniversalTime();
  const auto watch = [&last]
  {
    const double before = last;
    last = vtkTimerLog::GetUniversalTime();
    return last - before;
  };

  const auto train = [&]
  {
    work.secondsEdges += watch();
    if (work.parts.empty())
    {
      work.parts = this->Trained->partsOf(inputVector[0],
        { settings.preset, settings.features, this->CADScale, Eigen::Vector3d(this->CADOffset), settings.seed },
        meam::subProgress(progress, AfterSceneEdges, Work::Prepared));
    }
    double largest = 0.0;
    for (const auto& part : work.parts)
    {
      largest = std::max(largest, part->model->diameter);
    }
    work.secondsTraining += watch();
    return largest;
  };

  // What is wrong with the scene is told before any time goes into training.
  meam::requirePoints(sceneInput->GetNumberOfPoints(), sceneInput->GetNumberOfPoints(), "The scene");
  meam::ScanSource source;
  if (boundary)
  {
    source.sensor = sensorOf(this->Projection, this->ViewDirection, this->SensorPosition, sceneInput);
    source.edges = toLocalCloud(boundary, this->NumberOfThreads);
    meam::requirePoints(source.edges->cloud.points, "The scene's boundary cloud");
  }
  else
  {
    source.cloud = toScanCloud(sceneInput, this->NumberOfThreads);
    source.imageCamera = cameraOf(this->CameraFile, image, source.cloud);
    if (settings.imageEdges)
    {
      source.image = image ? toImage(image) : imageOfCloud(sceneInput);
    }
    source.sensor = givenSensor(this->Projection, this->ViewDirection, this->SensorPosition, sceneInput);
  }
  source.region = regionOf(this->Region, sceneInput);
  source.measured = [&](const meam::LocalCloud& edges)
  {
    work.secondsEdges += watch();
    meam::Points measured = surfaceOf(sceneInput, "The scene", edges, this->NumberOfThreads);
    work.secondsLoading = watch();
    return measured;
  };
  source.diameter = train;
  work.scan = meam::sceneOfScan(std::move(source), settings, meam::subProgress(progress, 0.0, AfterSceneEdges));
  train();
  work.settings = meam::detectionSettings(settings);
  work.settings.region = work.scan.region;
  for (int k = 0; k < inputVector[0]->GetNumberOfInformationObjects(); ++k)
  {
    const std::string name = partNameOf(this, k);
    const bool isTaken = std::find(work.names.begin(), work.names.end(), name) != work.names.end();
    work.names.push_back(isTaken ? name + " " + std::to_string(k + 1) : name);
  }
  return work;
}

void vtkMEAMEstimationAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const meam::DetectSettings& settings = *this->Settings;
  os << indent << "Preset: " << meam::nameOf(settings.preset) << "\n";
  os << indent << "Features: " << meam::nameOf(settings.features) << "\n";
  os << indent << "MaximumNumberOfPoses: " << settings.maximumPoses << "\n";
  os << indent << "MinimumProbability: " << settings.minimumProbability << "\n";
  os << indent << "RotationCounts: " << settings.rotationCounts << "\n";
  os << indent << "ReferenceShare: " << settings.referenceShare << "\n";
  os << indent << "TimeLimit: " << settings.timeLimit << " s\n";
  os << indent << "Seed: " << settings.seed << "\n";
  os << indent << "ImageEdges: " << settings.imageEdges << "\n";
  os << indent << "DepthEdges: " << settings.depthEdges << "\n";
  os << indent << "Creases: " << settings.creases << "\n";
  os << indent << "CameraFile: " << (this->CameraFile ? this->CameraFile : "(none)") << "\n";
  os << indent << "CADScale: " << this->CADScale << "\n";
  os << indent << "Region:";
  for (const double end : this->Region)
  {
    os << " " << end;
  }
  os << "\n";
  os << indent << "CADOffset: " << this->CADOffset[0] << " " << this->CADOffset[1] << " " << this->CADOffset[2] << "\n";
}
