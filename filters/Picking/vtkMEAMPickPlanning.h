// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPickPlanning
 * @brief Where a gripper can take which part out of the bin, and why not elsewhere.
 *
 * Every grasp of every pose is tried, at all turns that are as good: the part's exact symmetries and those that the
 * grasp leaves free. A pick is possible when the pose is likely enough, nothing lies on the part, the gripper comes
 * from above and keeps, on its whole way in, a safety margin from the bin, from other copies and from what was measured
 * besides (FCL). Of the turns of a grasp the one comes out where it is possible with most clearance.
 *
 * Input port 0: poses of the part, best first, a vtkPolyData with `Transform` and, where they are known,
 * `PlaceProbability` and `Probability`; of several types of part with `PartId`. Input port 1: the CAD mesh in the frame
 * of the poses, a vtkPolyData; with the field data of vtkMEAMSymmetryDetection, or the grasps with it, symmetric grasps
 * are tried, too. Input port 2: grasps, a vtkPolyData with `Transform` (vtkMEAMGraspDefinition). Ports 1 and 2 are
 * repeatable, for several types of part, in the order of `PartId`; what is a copy of one type is in the way of the
 * others. Input port 3, optional: all points the sensor measured, a
 * vtkPointSet in mm. Without it only copies and bin are in the way. Input port 4, optional: any gripper as it stands
 * open, a vtkPolyData with faces in the grasp's frame, mm: origin between the jaws, z the way in. It takes the place of
 * the one by lengths.
 *
 * Output port 0: a vtkPolyData, a vertex at each pick: possible ones first, best first, then those that come farthest
 * in the order of Obstructions. Point arrays: `Transform` (16, row-major T_scene_grasp), `Quaternion` (x y z w), `Rank`
 * (from 1), `Possible` (0 or 1, active scalars), `Obstruction` (int, see Obstructions), `Reason` (text), `Label` (text:
 * where the gripper is shown the rank, or the reason in a word), `Instance` and
 * `Grasp` (from 1: which pose, which grasp of its type), `GraspName` (text), `Kind` and `Width` (of the grasp),
 * `Obstacle` (the instance in the way, 0: none), `Clearance`, `Reach` (mm, down from the bin's rim or the highest
 * point), `Tilt` (degrees), `Covered` and `Score` ([0, 1]); with a RobotFrameFile `RobotTransform` (16, row-major
 * T_robot_grasp, mm); of several types of part `PartId`. Field data: `PickReport`, in a sentence: how many copies can
 * be picked, and what keeps the gripper from the others; `PickAdvice`: what to change for these, a sentence for each
 * reason, empty where all can be picked; `Gripper` (11, named: kind and lengths; not of a mesh); with a bin `Bin` (20:
 * its frame, row-major, inner length, inner width, height, wall; mm).
 *
 * Output port 1: the gripper at the picks, a vtkPolyData with `Possible` (active scalars), `Rank` and `Obstruction` for
 * its cells.
 *
 * Output port 2: the bin's floor and walls, a vtkPolyData; empty without a bin.
 *
 * Output port 3: vtkTable with one row, `Text`: report and advice in lines, to show in a view.
 */
#ifndef vtkMEAMPickPlanning_h
#define vtkMEAMPickPlanning_h

#include "vtkMEAMGripperAlgorithm.h"

#include <memory>

namespace meam
{
struct PlanSettings;
}

class PPFMEAMPICKING_EXPORT vtkMEAMPickPlanning : public vtkMEAMGripperAlgorithm
{
public:
  static vtkMEAMPickPlanning* New();
  vtkTypeMacro(vtkMEAMPickPlanning, vtkMEAMGripperAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Takes the meshes, or the grasps, of all types away; one is added by AddInputConnection(1, ...), (2, ...). */
  void RemoveAllMeshConnections() { this->RemoveAllInputConnections(1); }
  void RemoveAllGraspsConnections() { this->RemoveAllInputConnections(2); }
  ///@}

  /** Values of `Obstruction`: why a pick is not possible. */
  enum Obstructions
  {
    NoObstruction,
    Uncertain,
    Covered,
    WrongKind,
    TooWide,
    Tilted,
    PartItself,
    CollidesWithBin,
    CollidesWithInstance,
    CollidesWithMeasured
  };

  enum Grippers
  {
    ParallelJaws,
    SuctionCup
  };

  ///@{
  /** What the gripper is, when its mesh is not given: two jaws, or a cup. Default: ParallelJaws. */
  vtkMEAMDeclareSettingMacro(Gripper, int);
  void SetGripperToParallelJaws() { this->SetGripper(ParallelJaws); }
  void SetGripperToSuctionCup() { this->SetGripper(SuctionCup); }
  ///@}

  enum Bins
  {
    DetectedBin,
    GivenBin,
    NoBin
  };

  ///@{
  /**
   * Where the bin is: found in the scan by its rim, given by the next four, or none; then down is the way the sensor
   * looks and walls are what was measured of them. Default: DetectedBin.
   */
  vtkMEAMClampedMemberMacro(Bin, int, DetectedBin, NoBin);
  void SetBinToDetected() { this->SetBin(DetectedBin); }
  void SetBinToGiven() { this->SetBin(GivenBin); }
  void SetBinToNone() { this->SetBin(NoBin); }
  ///@}

  /** mm, scene coordinates: the middle of the bin's floor, when it is given. Default: 0, 0, 0. */
  vtkMEAMVectorMemberMacro(BinPosition, double, 3);

  /**
   * Degrees about x, y and z, first about y, then about x, then about z: turns the bin, whose z goes from its floor to
   * its rim. Default: 180, 0, 0, a bin under a sensor that looks down.
   */
  vtkMEAMVectorMemberMacro(BinRotation, double, 3);

  /** mm: inner length, inner width and height of the bin, when it is given. Default: 300, 200, 100. */
  vtkMEAMVectorMemberMacro(BinSize, double, 3);

  /** mm, thickness of the walls of a bin that is given. Default: 5. */
  vtkMEAMMemberMacro(BinWall, double);

  /** mm that the gripper keeps from all but the part it takes. Default: 2. */
  vtkMEAMDeclareSettingMacro(SafetyMargin, double);

  /** mm straight along the grasp's z that have to be free. Default: 80. */
  vtkMEAMDeclareSettingMacro(WayIn, double);

  /**
   * [0, 1], of what is picked, that a copy is there, however it is turned; where the gripper would not find the part's
   * surface at each of the near-symmetric rotations, that the pose is right. Less likely copies do not stand in the
   * way. Default: 0.5.
   */
  vtkMEAMDeclareSettingMacro(MinimumProbability, double);

  /**
   * The minimum probability of a pick is that of the pose, its rotation included: for parts that have to be put down
   * turned right. Default: off.
   */
  vtkMEAMDeclareFlagMacro(RotationCounts);

  /** Degrees between the way in and straight down, at most. Default: 60. */
  vtkMEAMDeclareSettingMacro(MaximumTilt, double);

  /** % of the part, from above, that may lie under something. Default: 20. */
  vtkMEAMDeclareSettingMacro(MaximumCovered, double);

  /** Degrees between the turns that free and symmetric grasps are tried at, 1 to 360. Default: 30. */
  vtkMEAMDeclareSettingMacro(TurnStep, double);

  /**
   * mm: measured points so near to a copy or to the bin are of it; 0: 3 times the noise and 1 % of the part. Default:
   * 0.
   */
  vtkMEAMDeclareSettingMacro(Tolerance, double);

  /**
   * A file with T_robot_camera, as vtkMEAMHandEyeCalibration writes it, OpenCV's or ROS's form: picks have the array
   * `RobotTransform`, too. Default: none.
   */
  vtkMEAMFileMemberMacro(RobotFrameFile);

  enum Shown
  {
    BestOfEachInstance,
    AllPossible,
    AllPicks
  };

  /** At which picks the gripper is shown by output port 1, with a label; BestOfEachInstance leaves out what is not
   * possible of poses whose `Label` is empty, which are not shown. Default: BestOfEachInstance. */
  vtkMEAMClampedMemberMacro(ShownGrippers, int, BestOfEachInstance, AllPicks);

  /** Rank of the pick at which the gripper is shown whole; at the others thin lines leave the parts in sight. 0: it is
   * shown whole at all picks. Default: 1. */
  vtkMEAMClampedMemberMacro(WholeGripper, int, 0, VTK_INT_MAX);

protected:
  vtkMEAMPickPlanning();
  ~vtkMEAMPickPlanning() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  const std::unique_ptr<meam::PlanSettings> Settings;
  int Bin = DetectedBin;
  double BinPosition[3] = { 0.0, 0.0, 0.0 };
  double BinRotation[3] = { 180.0, 0.0, 0.0 };
  double BinSize[3] = { 300.0, 200.0, 100.0 };
  double BinWall = 5.0;
  char* RobotFrameFile = nullptr;
  int ShownGrippers = BestOfEachInstance;
  int WholeGripper = 1;
};

#endif
