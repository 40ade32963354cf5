// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseEvaluation.h"

#include "evaluation/PoseEvaluation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneTime.h"
#include "vtkMEAMSymmetryConversion.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkMEAMPoseEvaluation);

namespace
{
/// The table's columns, filled row by row.
class Columns
{
public:
  explicit Columns(vtkTable* table)
  {
    for (std::size_t i = 0; i < this->Integers.size(); ++i)
    {
      static const char* const names[] = { "Scene", "Rank", "Right", "Duplicate", "Instance", "NearestInstance" };
      this->Integers[i]->SetName(names[i]);
      table->AddColumn(this->Integers[i]);
    }
    for (std::size_t i = 0; i < this->Doubles.size(); ++i)
    {
      static const char* const names[] = { "Score", "TranslationError", "RotationError", "AxisError", "RollError" };
      this->Doubles[i]->SetName(names[i]);
      table->AddColumn(this->Doubles[i]);
    }
  }

  void addRow(const std::array<int, 6>& integers, const std::array<double, 5>& doubles)
  {
    for (std::size_t i = 0; i < integers.size(); ++i)
    {
      this->Integers[i]->InsertNextValue(integers[i]);
    }
    for (std::size_t i = 0; i < doubles.size(); ++i)
    {
      this->Doubles[i]->InsertNextValue(doubles[i]);
    }
  }

private:
  std::array<vtkNew<vtkIntArray>, 6> Integers;
  std::array<vtkNew<vtkDoubleArray>, 5> Doubles;
};
}

vtkMEAMPoseEvaluation::vtkMEAMPoseEvaluation() { this->SetNumberOfInputPorts(3); }

int vtkMEAMPoseEvaluation::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1); // requireInputs
  return 1;
}

int vtkMEAMPoseEvaluation::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneTime::announce(inputVector, { 0, 1 }, outputVector);
  return 1;
}

int vtkMEAMPoseEvaluation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* output = vtkTable::GetData(outputVector);
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
      meam::PoseEvaluationSettings settings;
      settings.diameter = this->Diameter;
      for (int port = 0; port < 2; ++port)
      {
        for (int i = 0; i < scenes && !(settings.diameter > 0.0); ++i)
        {
          settings.diameter = diameterOf(vtkDataObject::GetData(inputVector[port], i));
        }
      }
      settings.middle = Eigen::Map<const Eigen::Vector3d>(middleOf(vtkDataObject::GetData(inputVector[2])).data());
      settings.symmetries = symmetriesOf(vtkDataObject::GetData(inputVector[2]));
      settings.translationTolerance = this->TranslationTolerance;
      settings.rotationTolerance = this->RotationTolerance;
      settings.posesAskedFor = this->PosesAskedFor;
      settings.axis = Eigen::Map<const Eigen::Vector3d>(this->Axis);
      settings.minimumVisibleFraction = this->MinimumVisibleFraction;

      meam::EvaluationTotals totals;
      Columns columns(output);
      for (int i = 0; i < scenes; ++i)
      {
        const meam::Poses estimates = toPoses(vtkPolyData::GetData(inputVector[0], i));
        const meam::Poses truths = toPoses(vtkPolyData::GetData(inputVector[1], i));
        const meam::SceneEvaluation scene = meam::evaluatePoses(estimates, truths, settings);
        totals.add(scene);
        for (std::size_t k = 0; k < estimates.size(); ++k)
        {
          const meam::PoseJudgement& judgement = scene.judgements[k];
          columns.addRow({ i, static_cast<int>(k) + 1, judgement.instance >= 0 ? 1 : 0, judgement.duplicate ? 1 : 0,
                           judgement.instance, judgement.nearest },
            { estimates[k].score, judgement.translationError, judgement.rotationError, judgement.axisError,
              judgement.rollError });
        }
      }
      const meam::EvaluationFigures figures = meam::evaluationFigures(totals);
      setDiameter(output, settings.diameter);
      setFieldValue(output, "PaperRate", figures.paperRate);
      setFieldValue(output, "StrictRate", figures.strictRate);
      setFieldValue(output, "Top1Rate", figures.top1Rate);
      setFieldValue(output, "Recall", figures.recall);
      setFieldValue(output, "AveragePrecision", figures.averagePrecision);
      setFieldValue(output, "MeanTranslationError", figures.meanTranslationError);
      setFieldValue(output, "MedianTranslationError", figures.medianTranslationError);
      setFieldValue(output, "MeanRotationError", figures.meanRotationError);
      setFieldValue(output, "MedianRotationError", figures.medianRotationError);
      setFieldValue(output, "MedianAxisError", figures.medianAxisError);
      setFieldValue(output, "MedianRollError", figures.medianRollError);
      setFieldValue(output, "Scenes", totals.scenes);
      setFieldValue(output, "Poses", totals.poses);
    },
    output);
}

void vtkMEAMPoseEvaluation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Diameter: " << this->Diameter << " mm\n";
  os << indent << "TranslationTolerance: " << this->TranslationTolerance << " %\n";
  os << indent << "RotationTolerance: " << this->RotationTolerance << " degrees\n";
  os << indent << "PosesAskedFor: " << this->PosesAskedFor << "\n";
  os << indent << "Axis: " << this->Axis[0] << " " << this->Axis[1] << " " << this->Axis[2] << "\n";
  os << indent << "MinimumVisibleFraction: " << this->MinimumVisibleFraction << "\n";
}
