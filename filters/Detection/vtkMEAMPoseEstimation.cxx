// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseEstimation.h"

#include "pose/DetectionSteps.h"
#include "pose/verification/EdgeExplanation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMEstimationWork.h"
#include "vtkMEAMInstanceConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneEdgeConversion.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkMEAMPoseEstimation);

namespace
{
/// The rank of the pose that explains each of the edge points; 0: none does.
void addRanks(const std::vector<int>& explained, vtkPolyData* edges)
{
  vtkNew<vtkIntArray> ranks;
  ranks->SetName("Rank");
  ranks->SetNumberOfTuples(static_cast<vtkIdType>(explained.size()));
  std::transform(explained.begin(), explained.end(), ranks->GetPointer(0), [](int pose) { return pose + 1; });
  edges->GetPointData()->AddArray(ranks);
  edges->GetPointData()->SetActiveScalars("Rank");
}
}

vtkMEAMPoseEstimation::vtkMEAMPoseEstimation() { this->SetNumberOfOutputPorts(6); }

int vtkMEAMPoseEstimation::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port < 3 ? "vtkPolyData" : "vtkTable");
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
  return vtkMEAMRun(
    this,
    [&]
    {
      requireInputs(this, { "Part", "Scan" });
      const double start = vtkTimerLog::GetUniversalTime();
      Work work = this->Prepare(inputVector);
      const double limit = this->GetTimeLimit();
      if (limit > 0.0)
      {
        work.settings.deadline = meam::Deadline(limit - work.secondsEdges - work.secondsLoading);
      }
      const meam::TrainedModel& model = *work.part->model;
      const meam::SceneInput& scene = work.scene;
      meam::DetectionReport report;
      const meam::Poses poses = meam::estimatePoses(
        model, scene, work.settings, &report, meam::subProgress(progressOf(this), Work::Prepared, 1.0));
      const double found = vtkTimerLog::GetUniversalTime();
      for (const std::string& warning :
        { report.isCutShort ? meam::cutShort(limit) : std::string(), meam::doubtsOf(poses, scene, model.diameter) })
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
        fromSceneEdges(work.found, edges);
      }
      addRanks(meam::explainEdges(scene.edges, poses, model, scene.quality.noise, this->GetNumberOfThreads()), edges);
      fromPoses(poses, output);
      output->GetPointData()->SetActiveScalars("Rank");
      InstanceSettings drawn;
      drawn.minimumProbability = this->ShownProbability;
      addLabels(poses, drawn.minimumProbability, output);
      fromInstances(
        work.part->shape, poses, [](std::size_t k) { return static_cast<int>(k) + 1; }, drawn, {}, parts);
      fromAnswer(
        { poses.empty() ? meam::describe(poses) : describeHidden(poses, drawn.minimumProbability, "ShownProbability") },
        answer);
      setDiameter(output, model.diameter);
      setPartExtent(output, model);
      setFieldText(output, "Report", meam::describe(poses));
      setScanQuality(output, scene.quality, work.scanReport);
      setFieldValue(output, "IsCutShort", report.isCutShort ? 1.0 : 0.0);
      if (report.rates)
      {
        setFieldValue(output, "EdgesFound", report.rates->edges.found);
        setFieldValue(output, "EdgesByChance", report.rates->edges.chance);
      }
      const meam::StageTimes& times = report.times;
      const double filled = vtkTimerLog::GetUniversalTime(); // but for the tables
      const std::pair<const char*, double> seconds[] = { { "Training", work.secondsTraining },
        { "SceneEdges", work.secondsEdges }, { "Scene", work.secondsLoading + times.scene },
        { "Tangents", times.tangents }, { "Detection", times.detection }, { "Screening", times.screening },
        { "Verification", times.verification }, { "Refinement", times.refinement }, { "Selection", times.selection },
        { "Output", filled - found } };
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
      vtkNew<vtkIntArray> ranks;
      ranks->SetName("Pose");
      for (std::size_t k = 1; k <= poses.size(); ++k)
      {
        ranks->InsertNextValue(static_cast<int>(k));
      }
      scores->AddColumn(ranks);
      for (const char* name : { "PlaceProbability", "Probability", "Score", "VisibleFraction", "Certainty" })
      {
        scores->AddColumn(output->GetPointData()->GetArray(name));
      }
      setFieldValue(output, "ScenePoints", static_cast<double>(scene.measured.size()));
      setFieldValue(output, "SceneEdgePoints", static_cast<double>(scene.edges.cloud.size()));
      setFieldValue(output, "ModelEdgePoints", static_cast<double>(model.edges.size()));
      setFieldValue(output, "SecondsTotal", filled - start);
    },
    output, edges, parts, scores, stages, answer);
}

void vtkMEAMPoseEstimation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ShownProbability: " << this->ShownProbability << "\n";
}
