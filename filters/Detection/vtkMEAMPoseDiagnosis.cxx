// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseDiagnosis.h"

#include "base/sequences/Sequences.h"
#include "pose/diagnosis/DiagnosisReport.h"
#include "pose/diagnosis/PartsDiagnosis.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMEstimationWork.h"
#include "vtkMEAMInstanceConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkMEAMPoseDiagnosis);

namespace
{
const char* const StateNames[] = { "explained", "turned", "hidden", "not measured", "seen past" };
const char* const MissingName = "missing"; // of an edge point where there is no edge

/// As the array `Residual` has them: those of states, of edge points of which there is no edge, and of the scan beside
/// the part.
constexpr int Missing = 5, Unexplained = 6;

/// Throws Error where the poses' types of part, by their diameters, are not those that are connected.
void requireOrder(vtkPolyData* poses, const std::vector<const meam::TrainedModel*>& models)
{
  constexpr double Same = 1e-3; // of a diameter: one that was rounded
  vtkDataArray* diameters = poses->GetFieldData()->GetArray("Diameter");
  for (std::size_t k = 0; diameters && k < models.size(); ++k)
  {
    const auto row = static_cast<vtkIdType>(k);
    if (diameters->GetNumberOfTuples() != static_cast<vtkIdType>(models.size()) ||
        std::abs(diameters->GetComponent(row, 0) - models[k]->diameter) > Same * models[k]->diameter)
    {
      throw meam::Error("The poses are of other parts than those that are connected, or these stand in another order: "
                        "connect to Part all that were searched, in their order.");
    }
  }
}

/// As the array `State` has it.
int stateId(meam::PointState state)
{
  switch (state)
  {
    case meam::PointState::Matched:
      return 0;
    case meam::PointState::Turned:
      return 1;
    case meam::PointState::Hidden:
      return 2;
    case meam::PointState::Unknown:
      return 3;
    case meam::PointState::Violated:
      break;
  }
  return 4;
}

void fromEvidence(const meam::Diagnosis& diagnosis, vtkPolyData* output)
{
  using namespace vtkMEAMConversion;
  struct State
  {
    int id;
    bool isEdge;
  };
  meam::PrecisePoints points;
  std::vector<State> states;
  const auto add = [&](const meam::PrecisePoints& from, const std::vector<meam::PointState>& stateOf, bool isEdge)
  {
    points.insert(points.end(), from.begin(), from.end());
    for (std::size_t k = 0; k < from.size(); ++k)
    {
      states.push_back({ stateId(stateOf[k]), isEdge });
    }
  };
  add(diagnosis.surfacePoints, diagnosis.evidence.points.surfaceStates, false);
  add(diagnosis.edgePoints, diagnosis.evidence.points.edgeStates, true);
  setVertices(points, output);
  vtkPointData* arrays = output->GetPointData();
  arrays->AddArray(columnOf<vtkIntArray>("State", states, &State::id));
  const auto isMissing = [](const State& state)
  { return state.isEdge && state.id == stateId(meam::PointState::Violated); };
  arrays->AddArray(columnOf<vtkStringArray>(
    "StateName", states, [&](const State& state) { return isMissing(state) ? MissingName : StateNames[state.id]; }));
  arrays->AddArray(columnOf<vtkIntArray>("IsEdge", states, &State::isEdge));
  arrays->AddArray(columnOf<vtkIntArray>(
    "Residual", states, [&](const State& state) { return isMissing(state) ? Missing : state.id; }));
  arrays->SetActiveScalars("Residual");
}

void fromUnexplained(const meam::PrecisePoints& points, vtkPolyData* output)
{
  vtkMEAMConversion::setVertices(points, output);
  output->GetPointData()->SetScalars(
    vtkMEAMConversion::arrayOf<vtkIntArray>("Residual", std::vector<int>(points.size(), Unexplained)));
}

/// The poses that came out of a search for the connected types of part: their probabilities are known.
std::vector<meam::FoundPose> foundPoses(vtkPolyData* given, const meam::Poses& poses, const std::vector<int>& types)
{
  const auto array = [&](const char* name) { return given ? given->GetPointData()->GetArray(name) : nullptr; };
  vtkDataArray *places = array("PlaceProbability"), *parts = array("PartId"), *ranks = array("Rank");
  const bool isKnown = places && places->GetNumberOfTuples() > 0 && places->GetRange()[0] > 0.0;
  const bool isOne = std::all_of(types.begin(), types.end(), [](int type) { return type == 0; });
  const bool isOfOthers = isOne && parts && parts->GetRange()[0] < parts->GetRange()[1];
  std::vector<meam::FoundPose> found;
  for (std::size_t k = 0; isKnown && !isOfOthers && k < poses.size() && types[k] >= 0; ++k)
  {
    const int rank = ranks ? vtkMEAMConversion::wholeIn(ranks, static_cast<vtkIdType>(k)) : static_cast<int>(k) + 1;
    found.push_back({ types[k], rank, poses[k] });
  }
  return found;
}

void fromNumbers(const std::vector<meam::DiagnosisNumber>& numbers, vtkTable* output)
{
  using namespace vtkMEAMConversion;
  using meam::DiagnosisNumber;
  output->AddColumn(columnOf<vtkStringArray>("Step", numbers, &DiagnosisNumber::step));
  output->AddColumn(columnOf<vtkStringArray>("Quantity", numbers, &DiagnosisNumber::what));
  output->AddColumn(columnOf<vtkDoubleArray>("Value", numbers, &DiagnosisNumber::value));
  output->AddColumn(columnOf<vtkDoubleArray>("Of", numbers, &DiagnosisNumber::of));
}
}

/// A detection, and what it was made of.
struct vtkMEAMPoseDiagnosis::Detection
{
  Detection(Work&& from, std::vector<double> madeOf, bool fit)
    : made(std::move(madeOf))
    , work(std::move(from))
    , diagnosis(modelsOf(work), work.scan.scene, work.settings, fit)
  {
  }

  static std::vector<const meam::TrainedModel*> modelsOf(const Work& work)
  {
    return meam::mapped<const meam::TrainedModel*>(work.parts, [&](const auto& part) { return part->model.get(); });
  }

  std::vector<double> made;
  Work work;
  meam::PartsDiagnosis diagnosis;
};

vtkMEAMPoseDiagnosis::vtkMEAMPoseDiagnosis()
{
  this->SetNumberOfInputPorts(5);
  this->SetNumberOfOutputPorts(5);
}

vtkMEAMPoseDiagnosis::~vtkMEAMPoseDiagnosis() = default;

int vtkMEAMPoseDiagnosis::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  return port < 4 ? this->Superclass::FillInputPortInformation(port, info)
                  : fillInputPort(info, { "vtkPolyData" }, Connections::OneOrNone);
}

int vtkMEAMPoseDiagnosis::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 || port == 3 ? "vtkTable" : "vtkPolyData");
  return 1;
}

vtkMEAMPoseDiagnosis::Detection& vtkMEAMPoseDiagnosis::Detect(vtkInformationVector** inputVector)
{
  const char* camera = this->GetCameraFile();
  std::vector<double> made{ static_cast<double>(this->GetPreset()), static_cast<double>(this->GetFeatures()),
    static_cast<double>(this->GetMaximumNumberOfPoses()), this->GetMinimumProbability(),
    this->GetRotationCounts() ? 1.0 : 0.0, this->GetReferenceShare(), static_cast<double>(this->GetSeed()),
    this->GetImageEdges() ? 1.0 : 0.0, this->GetDepthEdges() ? 1.0 : 0.0, this->GetCreases() ? 1.0 : 0.0,
    this->GetCADScale(), static_cast<double>(this->Projection), this->Fit ? 1.0 : 0.0,
    static_cast<double>(std::hash<std::string>()(camera ? camera : "")) };
  made.insert(made.end(), this->GetRegion(), this->GetRegion() + 6);
  for (const double* vector : { this->GetCADOffset(), this->ViewDirection, this->SensorPosition })
  {
    made.insert(made.end(), vector, vector + 3);
  }
  for (int port = 0; port < 4; ++port)
  {
    for (int k = 0; k < inputVector[port]->GetNumberOfInformationObjects(); ++k)
    {
      made.push_back(static_cast<double>(vtkDataObject::GetData(inputVector[port], k)->GetMTime()));
    }
    made.push_back(0.0); // ends those of the port
  }
  if (!this->Detected || this->Detected->made != made)
  {
    this->Detected = nullptr; // until the new one is there
    this->Detected = std::make_unique<Detection>(this->Prepare(inputVector), std::move(made), this->Fit);
  }
  return *this->Detected;
}

int vtkMEAMPoseDiagnosis::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* given = vtkPolyData::GetData(inputVector[4]);
  auto* output = vtkPolyData::GetData(outputVector, 0);
  auto* numbers = vtkTable::GetData(outputVector, 1);
  auto* part = vtkPolyData::GetData(outputVector, 2);
  auto* answer = vtkTable::GetData(outputVector, 3);
  auto* unexplained = vtkPolyData::GetData(outputVector, 4);
  return vtkMEAMRun(
    this,
    [&]
    {
      const bool isRanked = this->Place == RankedPose;
      requireInputs(this, { "Part", "Scan", nullptr, nullptr, isRanked ? "Poses" : nullptr });
      const meam::Poses poses = given ? toPoses(given) : meam::Poses();
      const int parts = inputVector[0]->GetNumberOfInformationObjects();
      std::vector<int> types(poses.size(), parts > 1 ? meam::PartsDiagnosis::AnyPart : 0);
      if (given && parts > 1 && given->GetPointData()->HasArray("PartId"))
      {
        types = typesOf(given, parts);
      }
      const std::vector<meam::FoundPose> found = foundPoses(given, poses, types);
      if (isRanked && this->RankOfPose > static_cast<int>(poses.size()))
      {
        throw meam::Error("There is no pose " + std::to_string(this->RankOfPose) + ": the input Poses has " +
                          std::to_string(poses.size()) + ". Set RankOfPose to one of these.");
      }
      Detection& detection = this->Detect(inputVector);
      if (!found.empty() && detection.work.parts.size() > 1)
      {
        requireOrder(given, Detection::modelsOf(detection.work));
      }
      const meam::Progress progress = meam::subProgress(progressOf(this), Work::Prepared, 1.0);
      const auto asked = [&]
      {
        if (this->Place == Point)
        {
          return detection.diagnosis.atPoint(Eigen::Vector3d(this->Position), found, this->PartId, progress);
        }
        const std::size_t place = this->RankOfPose - 1;
        if (isRanked && !found.empty())
        {
          return detection.diagnosis.ofFound(found[place], progress);
        }
        const meam::Pose& pose = isRanked ? poses[place] : placedAt(this->PosePosition, this->PoseRotation);
        const bool isKnown = isRanked && types[place] >= 0;
        return detection.diagnosis.atPose(pose.T_scene_model, isKnown ? types[place] : this->PartId, progress);
      };
      const meam::PartDiagnosis answered = asked();
      const meam::Diagnosis& diagnosis = answered.diagnosis;
      const TrainedPart& about = *detection.work.parts[answered.part];
      fromEvidence(diagnosis, output);
      fromUnexplained(diagnosis.unexplained, unexplained);
      fromNumbers(meam::numbersOf(diagnosis), numbers);
      const std::string verdict = meam::verdictOf(diagnosis, detection.work.settings);
      const std::string advice = meam::adviceOf(diagnosis, detection.work.settings);
      setFieldText(output, "Verdict", verdict);
      const std::string mainReason = meam::mainReasonOf(diagnosis);
      setFieldText(output, "MainReason", mainReason);
      setFieldText(output, "Advice", advice);
      std::vector<std::string> paragraphs{ meam::aboutWords(answered, detection.work.names), verdict, mainReason,
        advice };
      std::string reasons;
      for (const std::string& reason : meam::reasonsOf(diagnosis))
      {
        reasons += (reasons.empty() ? "" : "\n") + reason;
        paragraphs.push_back(this->More ? reason : "");
      }
      setFieldText(output, "Reasons", reasons);
      fromAnswer(paragraphs, answer);
      setFieldText(output, "LostIn", diagnosis.lostIn ? meam::nameOf(*diagnosis.lostIn) : std::string());
      setFieldValue(output, "Rank", diagnosis.rank);
      setDiameter(output, about.model->diameter);
      if (detection.work.parts.size() > 1)
      {
        setFieldValue(output, "PartId", answered.part);
      }
      if (diagnosis.place)
      {
        meam::Pose place = *diagnosis.place;
        output->GetFieldData()->AddArray(frameOf("Transform", place.T_scene_model));
        InstanceSettings drawn;
        drawn.minimumProbability = 0.0;
        fromInstances(
          about.shape, { place }, [&](std::size_t) { return diagnosis.rank; }, drawn, {}, part);
      }
    },
    output, numbers, part, answer, unexplained);
}

void vtkMEAMPoseDiagnosis::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* names[] = { "Point", "Pose", "RankedPose" };
  os << indent << "Place: " << names[this->Place] << "\n";
  const auto print = [&](const char* name, const double vector[3])
  { os << indent << name << ": " << vector[0] << " " << vector[1] << " " << vector[2] << "\n"; };
  print("Position", this->Position);
  print("PosePosition", this->PosePosition);
  print("PoseRotation", this->PoseRotation);
  os << indent << "RankOfPose: " << this->RankOfPose << "\n";
  os << indent << "PartId: " << this->PartId << "\n";
  os << indent << "Fit: " << this->Fit << "\n";
  os << indent << "More: " << this->More << "\n";
}
