// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseEstimation.h"

#include "base/Error.h"
#include "pose/DetectionSteps.h"
#include "pose/PartsEstimation.h"
#include "pose/ScanAdvice.h"
#include "pose/verification/EdgeExplanation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMEstimationWork.h"
#include "vtkMEAMInstanceConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneEdgeConversion.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkMEAMPoseEstimation);

namespace
{
/// The rank of the first pose that explains each of the edge points; 0: none does.
std::vector<int> ranksOfEdges(const meam::SceneInput& scene, const std::vector<meam::PartPose>& poses,
  const std::vector<const meam::TrainedModel*>& models, int threads)
{
  std::vector<int> ranks(scene.edges.cloud.size(), 0);
  for (std::size_t part = 0; part < models.size(); ++part)
  {
    const auto [ofPart, rankOf] = meam::posesOfPart(poses, static_cast<int>(part));
    const std::vector<int> explained =
      meam::explainEdges(scene.edges, ofPart, *models[part], scene.quality.noise, threads);
    for (std::size_t i = 0; i < explained.size(); ++i)
    {
      if (explained[i] >= 0 && (ranks[i] == 0 || rankOf[explained[i]] < ranks[i]))
      {
        ranks[i] = rankOf[explained[i]];
      }
    }
  }
  return ranks;
}

/// Where the labels of poses stand: amid the edge points that are theirs, which are in sight, or else at the middle of
/// the part.
void placeLabels(const meam::LocalCloud& edges, const std::vector<int>& rankOf,
  const std::vector<meam::PartPose>& poses, const std::vector<const meam::TrainedModel*>& models, vtkPolyData* output)
{
  constexpr int fewest = 8; // edge points: fewer may be those of a corner
  std::vector<Eigen::Vector3d> sums(poses.size(), Eigen::Vector3d::Zero());
  std::vector<int> counts(poses.size(), 0);
  for (std::size_t i = 0; i < rankOf.size(); ++i)
  {
    if (rankOf[i] > 0)
    {
      sums[rankOf[i] - 1] += edges.cloud.points[i].cast<double>();
      ++counts[rankOf[i] - 1];
    }
  }
  const Eigen::Isometry3d T_scene_local = edges.T_local_scene.inverse();
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    const Eigen::Vector3d middle = models[poses[k].part]->visibility->middle().cast<double>();
    const Eigen::Vector3d place =
      counts[k] < fewest ? poses[k].pose.T_scene_model * middle : T_scene_local * (sums[k] / counts[k]);
    output->GetPoints()->SetPoint(static_cast<vtkIdType>(k), place.data());
  }
}

}

vtkMEAMPoseEstimation::vtkMEAMPoseEstimation() { this->SetNumberOfOutputPorts(7); }

vtkMEAMPoseEstimation::~vtkMEAMPoseEstimation() = default;

int vtkMEAMPoseEstimation::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port < 3   ? "vtkPolyData"
                                             : port < 6 ? "vtkTable"
                                                        : "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkMEAMPoseEstimation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* boundary = vtkPolyData::GetData(inputVector[2]);
  auto* output = vtkPolyData::GetData(outputVector, 0);
  auto* edges = vtkPolyData::GetData(outputVector, 1);
  auto* parts = vtkPolyData::GetData(outputVector, 2);
  auto* scores = vtkTable::GetData(outputVector, 3);
  auto* stages = vtkTable::GetData(outputVector, 4);
  auto* answer = vtkTable::GetData(outputVector, 5);
  auto* trained = vtkPartitionedDataSetCollection::GetData(outputVector, 6);
  return vtkMEAMRun(
    this,
    [&]
    {
      this->Suggestion.clear();
      requireInputs(this, { "Part", "Scan" });
      const double start = vtkTimerLog::GetUniversalTime();
      Work work = this->Prepare(inputVector);
      const double limit = this->GetTimeLimit();
      if (limit > 0.0)
      {
        work.settings.deadline = meam::Deadline(limit - work.secondsEdges - work.secondsLoading);
      }
      std::vector<const meam::TrainedModel*> models;
      std::vector<vtkPolyData*> shapes;
      for (const auto& part : work.parts)
      {
        models.push_back(part->model.get());
        shapes.push_back(part->shape);
      }
      const meam::SceneInput& scene = work.scan.scene;
      meam::DetectionReport report;
      const std::vector<meam::PartPose> partPoses = meam::estimateParts(
        models, scene, work.settings, &report, meam::subProgress(progressOf(this), Work::Prepared, 1.0));
      meam::Poses poses;
      std::vector<std::string> nameOfEach;
      for (const meam::PartPose& one : partPoses)
      {
        poses.push_back(one.pose);
        nameOfEach.push_back(work.names[one.part]);
      }
      const bool isOne = models.size() == 1;
      const double found = vtkTimerLog::GetUniversalTime();
      for (const std::string& warning : { report.isCutShort ? meam::cutShort(limit) : std::string(),
             meam::doubtsOf(poses, scene, models.front()->diameter) })
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
        fromSceneEdges(work.scan.found, edges);
      }
      const std::vector<int> rankOfEdges = ranksOfEdges(scene, partPoses, models, this->GetNumberOfThreads());
      edges->GetPointData()->AddArray(arrayOf<vtkIntArray>("Rank", rankOfEdges));
      edges->GetPointData()->SetActiveScalars("Rank");
      fromPoses(poses, output);
      for (const char* name : { "SceneId", "ImageId" }) // of a dataset
      {
        output->GetFieldData()->AddArray(vtkDataObject::GetData(inputVector[1])->GetFieldData()->GetArray(name));
      }
      placeLabels(scene.edges, rankOfEdges, partPoses, models, output);
      output->GetPointData()->SetActiveScalars("Rank");
      InstanceSettings drawn;
      drawn.minimumProbability = this->ShownProbability;
      addLabels(poses, isOne ? std::vector<std::string>() : nameOfEach, drawn.minimumProbability, output);
      const double largest = meam::largestDiameter(models);
      const std::string advice = meam::scanAdvice(scene.quality, report, poses, largest, scene.isViewpointGuessed);
      setFieldText(output, "Advice", advice);
      this->Suggestion = (advice.empty() ? "Nothing stands out that has to be changed." : advice) + "\n" +
                         meam::scanSummary(scene.quality, report, poses, largest);
      fromAnswer(
        { poses.empty() ? meam::describe(poses) : describeHidden(poses, drawn.minimumProbability, "ShownProbability"),
          advice },
        answer);
      if (isOne)
      {
        fromInstances(
          shapes.front(), poses, [](std::size_t k) { return static_cast<int>(k) + 1; }, drawn, {}, parts);
        setDiameter(output, models.front()->diameter);
        setPartExtent(output, *models.front());
        if (this->Given != work.parts.front())
        {
          this->GivenData = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
          fromTrainedModel(*models.front(), this->GivenData);
          shareModel(this->GivenData, work.parts.front()->model);
          this->Given = work.parts.front();
        }
        trained->ShallowCopy(this->GivenData);
      }
      else
      {
        fromInstances(
          shapes, partPoses, [](std::size_t k) { return static_cast<int>(k) + 1; }, drawn, {}, parts);
        setParts(partPoses, models, output);
        output->GetPointData()->SetActiveScalars("PartId"); // as the parts that are drawn
      }
      output->GetFieldData()->AddArray(arrayOf<vtkStringArray>("PartName", work.names));
      setFieldText(output, "Report", meam::untoldLengths(partPoses, meam::describe(poses), work.names));
      setScanQuality(output, scene.quality, work.scan.report);
      setFieldValue(output, "IsCutShort", report.isCutShort ? 1.0 : 0.0);
      if (report.rates)
      {
        setFieldValue(output, "EdgesFound", report.rates->edges.found);
        setFieldValue(output, "EdgesByChance", report.rates->edges.chance);
      }
      const meam::StageTimes& times = report.times;
      const double filled = vtkTimerLog::GetUniversalTime(); // but for the tables
      using Stage = std::pair<const char*, double>;
      const Stage seconds[] = { { "Training", work.secondsTraining }, { "SceneEdges", work.secondsEdges },
        { "Scene", work.secondsLoading + times.scene }, { "Tangents", times.tangents },
        { "Detection", times.detection }, { "Screening", times.screening }, { "Verification", times.verification },
        { "Refinement", times.refinement }, { "Selection", times.selection }, { "Output", filled - found } };
      for (const auto& [name, duration] : seconds)
      {
        setFieldValue(output, (std::string("Seconds") + name).c_str(), duration);
      }
      stages->AddColumn(columnOf<vtkStringArray>("Stage", seconds, &Stage::first));
      stages->AddColumn(columnOf<vtkDoubleArray>("Seconds", seconds, &Stage::second));
      scores->AddColumn(columnOf<vtkIntArray>("Pose", poses, [rank = 0](const meam::Pose&) mutable { return ++rank; }));
      for (const char* name : { "PlaceProbability", "Probability", "Score", "VisibleFraction", "Certainty" })
      {
        scores->AddColumn(output->GetPointData()->GetArray(name));
      }
      const meam::WorkCounts& done = report.work;
      const std::pair<const char*, int> counts[] = { { "References", done.references }, { "Screened", done.screened },
        { "Verified", done.verified }, { "Refined", done.refined }, { "Selected", done.selected } };
      for (const auto& [name, count] : counts)
      {
        setFieldValue(output, (std::string("Work") + name).c_str(), count);
      }
      setFieldValue(output, "ScenePoints", static_cast<double>(scene.measured.size()));
      setFieldValue(output, "SceneEdgePoints", static_cast<double>(scene.edges.cloud.size()));
      setFieldValue(output, "ModelEdgePoints",
        std::accumulate(models.begin(), models.end(), 0.0,
          [](double sum, const meam::TrainedModel* model) { return sum + static_cast<double>(model->edges.size()); }));
      setFieldValue(output, "SecondsTotal", filled - start);
    },
    output, edges, parts, scores, stages, answer, trained);
}

void vtkMEAMPoseEstimation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ShownProbability: " << this->ShownProbability << "\n";
  os << indent << "Suggestion: " << this->Suggestion << "\n";
}
