// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseEvaluation
 * @brief Compares estimated poses with the true ones (paper, Section 6.3).
 *
 * A pose is right when some true pose is within 10 % of the part's diameter and 5 degrees. Both ports
 * take one connection, or as many as there are scenes, in the same order; the figures are over all.
 *
 * Input port 0: estimated poses of each scene, best first, a vtkPolyData with the point array
 * `Transform` (16, row-major T_scene_model) and, where it is there, `Score`. An empty one is a scene in
 * which nothing was found.
 * Input port 1: true poses of each scene, likewise. Where they have `VisibleFraction`, instances that are
 * too hidden need not be found.
 * The part's diameter is the property, or else the field data `Diameter` of an input.
 *
 * Input port 2 (optional): the part's samples from vtkMEAMSymmetryDetection, or its trained model. Of poses that are
 * equal under the part's exact symmetries the one nearest to the true pose is judged, and translation errors are
 * displacements of the part's middle. Without it they are those of the origin, which may lie far from the part.
 * Input port 3 (optional): the part's mesh in the frame of the poses, mm, for `AveragePrecisionMSSD`.
 *
 * Output port 0: a vtkTable with a row for each estimated pose, and the columns `Scene` (from 0), `Rank`,
 * `Score`, `Right` (0 or 1), `Duplicate` (1: a better pose has found the same instance), `Instance`
 * (index of the true pose, -1 for a wrong pose), `NearestInstance`, `TranslationError` (mm),
 * `RotationError`, `AxisError` and `RollError` (degrees; to the matched instance, or to the nearest), `Outcome` (0 hit,
 * 1 duplicate, 2 wrong turn: near enough but turned too far, 3 wrong place). Field data: `PaperRate` (right / poses
 * that came out), `StrictRate` (distinct right poses / poses asked for), `Top1Rate`, `Recall`, `AveragePrecision` and
 * `RecallAtPrecision99` (by the likeliest poses, as long as 99 % of them are right) in %, the last three of all poses,
 * not only those asked for; with a mesh `AveragePrecisionMSSD` (%, as the BOP benchmark has it for industrial parts:
 * the mean over MSSD less than 2, 4, ..., 20 mm, of copies of which at least a tenth is visible);
 * `MeanTranslationError`, `MedianTranslationError` (mm), `MeanRotationError`, `MedianRotationError`, `MedianAxisError`,
 * `MedianRollError` (degrees) of the right poses; `Scenes`, `Poses` (judged).
 *
 * Output port 1: a vtkTable with a row for each true instance, and the columns `Scene`, `Instance`, `HasToBeFound` (1:
 * it is visible enough), `FoundBy` (rank of the first pose that found it, 0: missed), `NearestRank` (of the pose whose
 * middle is nearest, 0: there is none), `VisibleFraction`, `TranslationError` (mm) and `RotationError` (degrees) of the
 * pose that found it, or else of the nearest. Output port 2: the estimated poses of all scenes, a vtkPolyData with the
 * arrays of every pose, `Scene`, `PoseOutcome`, the `Outcome` of the table, which a view colours them by, and
 * `CopyIsThere` (1: a copy is there, if need be turned by a near-symmetry, and no better pose has it), for
 * vtkMEAMModelCalibration.
 */
#ifndef vtkMEAMPoseEvaluation_h
#define vtkMEAMPoseEvaluation_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkTableAlgorithm.h"

#include <memory>

namespace meam
{
struct PoseEvaluationSettings;
}

class PPFMEAMTRAINING_EXPORT vtkMEAMPoseEvaluation : public vtkTableAlgorithm
{
public:
  static vtkMEAMPoseEvaluation* New();
  vtkTypeMacro(vtkMEAMPoseEvaluation, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The true poses; a further scene is added by AddInputConnection(1, ...). */
  void SetTrueConnection(vtkAlgorithmOutput* truth) { this->SetInputConnection(1, truth); }
  /** Takes the true poses of all scenes away. */
  void RemoveAllTrueConnections() { this->RemoveAllInputConnections(1); }

  /** mm, the part's largest vertex distance; 0 takes it from the poses' field data. Default: 0. */
  vtkMEAMDeclareSettingMacro(Diameter, double);

  /** % of the diameter: a right pose is nearer to a true one. Default: 10. */
  vtkMEAMDeclareSettingMacro(TranslationTolerance, double);

  /** Degrees: a right pose is turned by less against a true one. Default: 5. */
  vtkMEAMDeclareSettingMacro(RotationTolerance, double);

  /** Best poses of a scene that count; missing ones are wrong. 0: all there are. Default: 5. */
  vtkMEAMDeclareSettingMacro(PosesAskedFor, int);

  /** The part's axis in the model's frame, for the axis and roll errors. Default: 0, 0, 1. */
  vtkMEAMVectorMemberMacro(Axis, double, 3);

  /** Share of a true instance, in [0, 1], that has to be visible to count for the recall. Default: 0.5. */
  vtkMEAMDeclareSettingMacro(MinimumVisibleFraction, double);

protected:
  vtkMEAMPoseEvaluation();
  ~vtkMEAMPoseEvaluation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::PoseEvaluationSettings> Settings;
  double Axis[3] = { 0.0, 0.0, 1.0 };
};

#endif
