// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseEvaluation.h"

#include "evaluation/BOPEvaluation.h"
#include "evaluation/PoseEvaluation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneRequests.h"
#include "vtkMEAMSettings.h"
#include "vtkMEAMSymmetryConversion.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <optional>

vtkStandardNewMacro(vtkMEAMPoseEvaluation);

namespace
{
/// A table's columns, filled row by row.
template <std::size_t Integer, std::size_t Double>
class Columns
{
public:
  Columns(
    vtkTable* table, const std::array<const char*, Integer>& integers, const std::array<const char*, Double>& doubles)
  {
    for (std::size_t i = 0; i < Integer; ++i)
    {
      this->Integers[i]->SetName(integers[i]);
      table->AddColumn(this->Integers[i]);
    }
    for (std::size_t i = 0; i < Double; ++i)
    {
      this->Doubles[i]->SetName(doubles[i]);
      table->AddColumn(this->Doubles[i]);
    }
  }

  void addRow(const std::array<int, Integer>& integers, const std::array<double, Double>& doubles)
  {
    for (std::size_t i = 0; i < Integer; ++i)
    {
      this->Integers[i]->InsertNextValue(integers[i]);
    }
    for (std::size_t i = 0; i < Double; ++i)
    {
      this->Doubles[i]->InsertNextValue(doubles[i]);
    }
  }

private:
  std::array<vtkNew<vtkIntArray>, Integer> Integers;
  std::array<vtkNew<vtkDoubleArray>, Double> Doubles;
};
}

vtkMEAMPoseEvaluation::vtkMEAMPoseEvaluation()
  : Settings(new meam::PoseEvaluationSettings)
{
  this->SetNumberOfInputPorts(4);
  this->SetNumberOfOutputPorts(3);
}

vtkMEAMPoseEvaluation::~vtkMEAMPoseEvaluation() = default;

vtkMEAMClampedSettingMacro(vtkMEAMPoseEvaluation, Diameter, double, diameter, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(
  vtkMEAMPoseEvaluation, TranslationTolerance, double, translationTolerance, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMPoseEvaluation, RotationTolerance, double, rotationTolerance, 0.0, 180.0)
vtkMEAMClampedSettingMacro(vtkMEAMPoseEvaluation, PosesAskedFor, int, posesAskedFor, 0, VTK_INT_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMPoseEvaluation, MinimumVisibleFraction, double, minimumVisibleFraction, 0.0, 1.0)

int vtkMEAMPoseEvaluation::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkPolyData" : "vtkTable");
  return 1;
}

int vtkMEAMPoseEvaluation::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  return fillInputPort(
    info, { port == 2 ? "vtkDataObject" : "vtkPolyData" }, port < 2 ? Connections::Any : Connections::OneOrNone);
}

int vtkMEAMPoseEvaluation::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneRequests::announceTime(inputVector, { 0, 1 }, outputVector);
  return 1;
}

int vtkMEAMPoseEvaluation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* output = vtkTable::GetData(outputVector, 0);
  auto* instances = vtkTable::GetData(outputVector, 1);
  auto* judged = vtkPolyData::GetData(outputVector, 2);
  return vtkMEAMRun(
    this,
    [&]
    {
      requireInputs(this, { "Poses", "True Poses" });
      const int scenes = inputVector[0]->GetNumberOfInformationObjects();
      if (inputVector[1]->GetNumberOfInformationObjects() != scenes)
      {
        throw meam::Error("There are estimated poses of " + std::to_string(scenes) + " scenes and true poses of " +
                          std::to_string(inputVector[1]->GetNumberOfInformationObjects()) +
                          ": connect both of each scene.");
      }
      meam::PoseEvaluationSettings settings = *this->Settings;
      for (int port = 0; port < 2; ++port)
      {
        for (int i = 0; i < scenes && !(settings.diameter > 0.0); ++i)
        {
          settings.diameter = diameterOf(vtkDataObject::GetData(inputVector[port], i));
        }
      }
      settings.middle = Eigen::Map<const Eigen::Vector3d>(middleOf(vtkDataObject::GetData(inputVector[2])).data());
      settings.symmetries = symmetriesOf(vtkDataObject::GetData(inputVector[2]));
      settings.axis = Eigen::Map<const Eigen::Vector3d>(this->Axis);

      vtkPolyData* mesh = vtkPolyData::GetData(inputVector[3]);
      std::optional<meam::BOPEvaluation> benchmark;
      if (mesh)
      {
        benchmark.emplace(toMesh(mesh), settings.symmetries, settings.diameter);
      }
      meam::BOPRanking ranking;
      meam::EvaluationTotals totals;
      Columns<7, 5> ofPoses(output, { "Scene", "Rank", "Right", "Duplicate", "Instance", "NearestInstance", "Outcome" },
        { "Score", "TranslationError", "RotationError", "AxisError", "RollError" });
      Columns<5, 3> ofInstances(instances, { "Scene", "Instance", "HasToBeFound", "FoundBy", "NearestRank" },
        { "VisibleFraction", "TranslationError", "RotationError" });
      meam::Poses all;
      vtkNew<vtkIntArray> sceneOf, outcomes, copies;
      sceneOf->SetName("Scene");
      copies->SetName("CopyIsThere");
      outcomes->SetName(
        "PoseOutcome"); // vtkMEAMPickTrial has an `Outcome` of other values, and a view one color map for a name
      for (int i = 0; i < scenes; ++i)
      {
        const meam::Poses estimates = toPoses(vtkPolyData::GetData(inputVector[0], i));
        const meam::Poses truths = toPoses(vtkPolyData::GetData(inputVector[1], i));
        const meam::SceneEvaluation scene = meam::evaluatePoses(estimates, truths, settings);
        totals.add(scene);
        if (benchmark)
        {
          ranking.add(benchmark->ranking(estimates, truths));
        }
        for (std::size_t k = 0; k < estimates.size(); ++k)
        {
          const meam::PoseJudgement& judgement = scene.judgements[k];
          const int outcome = static_cast<int>(judgement.outcome);
          ofPoses.addRow({ i, static_cast<int>(k) + 1, judgement.instance >= 0 ? 1 : 0, judgement.duplicate ? 1 : 0,
                           judgement.instance, judgement.nearest, outcome },
            { estimates[k].score, judgement.translationError, judgement.rotationError, judgement.axisError,
              judgement.rollError });
          all.push_back(estimates[k]);
          sceneOf->InsertNextValue(i);
          outcomes->InsertNextValue(outcome);
          copies->InsertNextValue(judgement.isThere ? 1 : 0);
        }
        for (std::size_t k = 0; k < truths.size(); ++k)
        {
          const meam::InstanceJudgement& judgement = scene.instances[k];
          ofInstances.addRow(
            { i, static_cast<int>(k), judgement.counts ? 1 : 0, judgement.pose + 1, judgement.nearest + 1 },
            { truths[k].visibleFraction, judgement.translationError, judgement.rotationError });
        }
      }
      const meam::EvaluationFigures figures = meam::evaluationFigures(totals);
      fromPoses(all, judged);
      judged->GetPointData()->AddArray(sceneOf);
      judged->GetPointData()->AddArray(outcomes);
      judged->GetPointData()->AddArray(copies);
      judged->GetPointData()->SetActiveScalars("PoseOutcome");
      setDiameter(output, settings.diameter);
      setFieldValue(output, "PaperRate", figures.paperRate);
      setFieldValue(output, "StrictRate", figures.strictRate);
      setFieldValue(output, "Top1Rate", figures.top1Rate);
      setFieldValue(output, "Recall", figures.recall);
      setFieldValue(output, "AveragePrecision", figures.averagePrecision);
      setFieldValue(output, "RecallAtPrecision99", figures.recallAtPrecision99);
      if (benchmark)
      {
        setFieldValue(output, "AveragePrecisionMSSD", ranking.averagePrecision());
      }
      setFieldValue(output, "MeanTranslationError", figures.meanTranslationError);
      setFieldValue(output, "MedianTranslationError", figures.medianTranslationError);
      setFieldValue(output, "MeanRotationError", figures.meanRotationError);
      setFieldValue(output, "MedianRotationError", figures.medianRotationError);
      setFieldValue(output, "MedianAxisError", figures.medianAxisError);
      setFieldValue(output, "MedianRollError", figures.medianRollError);
      setFieldValue(output, "Scenes", totals.scenes);
      setFieldValue(output, "Poses", totals.poses);
    },
    output, instances, judged);
}

void vtkMEAMPoseEvaluation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Diameter: " << this->GetDiameter() << " mm\n";
  os << indent << "TranslationTolerance: " << this->GetTranslationTolerance() << " %\n";
  os << indent << "RotationTolerance: " << this->GetRotationTolerance() << " degrees\n";
  os << indent << "PosesAskedFor: " << this->GetPosesAskedFor() << "\n";
  os << indent << "Axis: " << this->Axis[0] << " " << this->Axis[1] << " " << this->Axis[2] << "\n";
  os << indent << "MinimumVisibleFraction: " << this->GetMinimumVisibleFraction() << "\n";
}
