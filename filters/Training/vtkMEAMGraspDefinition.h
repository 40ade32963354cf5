// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMGraspDefinition
 * @brief Where a gripper holds the part: grasps of a file, one laid by hand, and such as its mesh proposes.
 *
 * The grasps of the file come first, then the one laid by hand, then those proposed, best first: pairs of faces that
 * face apart for jaws, flat spots for a cup, where the gripper is not in the way of the part. Of proposals that the
 * part's exact symmetries make equal one comes out.
 *
 * Input port 0: the part's CAD mesh, a vtkPolyData in mm; vtkMEAMMeshPreparation gives it.
 * Input port 1, optional: what carries the part's symmetries, the output of vtkMEAMSymmetryDetection or a trained
 * model; without it the mesh's own field data, as far as they are there. Input port 2, optional: any gripper as it
 * stands open, a vtkPolyData with faces in the grasp's frame, mm: origin between the jaws, or in the middle of the
 * cup's rim, z the way in. It takes the place of the one by lengths.
 *
 * Output port 0: vtkPolyData, a vertex for each grasp at its origin, with the point arrays `Transform` (16, row-major
 * T_model_grasp: z the way in, x along which the jaws close), `Kind` (0 jaws, 1 a cup), `Width` (mm), `FreeTurn` (0
 * none, 1 about the approach, 2 about the closing direction), `Quality` ([0, 1], active scalars) and `GraspName`
 * (text); field data: the part's symmetries. Output port 1: vtkPolyData, jaws or a cup at each, to look at, with
 * `Quality`, `Kind` and `Grasp` (from 1) for the cells.
 */
#ifndef vtkMEAMGraspDefinition_h
#define vtkMEAMGraspDefinition_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMGripperAlgorithm.h"

#include <memory>

namespace meam
{
struct Grasp;
struct ProposeSettings;
}

class PPFMEAMTRAINING_EXPORT vtkMEAMGraspDefinition : public vtkMEAMGripperAlgorithm
{
public:
  static vtkMEAMGraspDefinition* New();
  vtkTypeMacro(vtkMEAMGraspDefinition, vtkMEAMGripperAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What carries the part's symmetries. */
  void SetSymmetriesConnection(vtkAlgorithmOutput* symmetries) { this->SetInputConnection(1, symmetries); }
  /** The open gripper. */
  void SetGripperMeshConnection(vtkAlgorithmOutput* gripper) { this->SetInputConnection(2, gripper); }

  /** Grasps of the part, as vtkMEAMGraspWriter writes them (JSON). Default: none. */
  vtkMEAMFileMemberMacro(FileName);

  enum Proposals
  {
    Off,
    ParallelJaws,
    Suction,
    Both
  };

  ///@{
  /** What is proposed from the mesh: nothing (Off, 0), grasps of jaws (1), of a cup (2), or of both (3). Default: 1. */
  vtkMEAMClampedMemberMacro(Propose, int, Off, Both);
  void SetProposeToOff() { this->SetPropose(Off); }
  void SetProposeToParallelJaws() { this->SetPropose(ParallelJaws); }
  void SetProposeToSuction() { this->SetPropose(Suction); }
  void SetProposeToBoth() { this->SetPropose(Both); }
  ///@}

  /** Grasps proposed of each kind, the best ones. Default: 20. */
  vtkMEAMDeclareSettingMacro(MaximumNumberOfGrasps, int);

  /** Degrees between the closing direction and the surface's normals: of 15, a friction of 0.27. Default: 15. */
  vtkMEAMDeclareSettingMacro(FrictionAngle, double);

  /** mm: of proposals nearer than this that face the same way one comes out; 0: 10 % of the diameter. Default: 0. */
  vtkMEAMDeclareSettingMacro(Spread, double);

  enum HandKinds
  {
    NoHandGrasp,
    HandJaws,
    HandCup
  };

  ///@{
  /** Whether a grasp is laid by hand, and of what: none (0), jaws (1), a cup (2). Default: 0. */
  vtkMEAMClampedMemberMacro(HandGrasp, int, NoHandGrasp, HandCup);
  void SetHandGraspToNone() { this->SetHandGrasp(NoHandGrasp); }
  void SetHandGraspToParallelJaws() { this->SetHandGrasp(HandJaws); }
  void SetHandGraspToSuction() { this->SetHandGrasp(HandCup); }
  ///@}

  /** By hand: the origin of the grasp, mm, the part's coordinates. Default: 0, 0, 0. */
  vtkMEAMVectorMemberMacro(HandPosition, double, 3);

  /**
   * By hand: turns of the grasp's frame about x, y and z in degrees, as vtkProp3D has them: first about y, then about
   * x, then about z. Without any z, the way in, is the part's z. Default: 180, 0, 0, from above.
   */
  vtkMEAMVectorMemberMacro(HandRotation, double, 3);

  /**
   * By hand: mm of the part between the jaws; 0: they close from their opening until they touch, with the origin in the
   * middle; a cup goes along its approach until it touches. Default: 0.
   */
  vtkMEAMMemberMacro(HandWidth, double);

protected:
  vtkMEAMGraspDefinition();
  ~vtkMEAMGraspDefinition() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  meam::Grasp LaidByHand() const;

  std::unique_ptr<meam::ProposeSettings> Settings;
  char* FileName = nullptr;
  int Propose = ParallelJaws;
  int HandGrasp = NoHandGrasp;
  double HandPosition[3] = { 0.0, 0.0, 0.0 };
  double HandRotation[3] = { 180.0, 0.0, 0.0 };
  double HandWidth = 0.0;
};

#endif
