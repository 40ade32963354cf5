// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseDiagnosis
 * @brief Tells why a part of a scan was missed, or what speaks for a pose and against it, and what to change.
 *
 * Detects the part as vtkMEAMPoseEstimation does with the same properties, and looks at one place: where a picked point
 * lies, at a pose, or at one of the poses on port 4. It tells what of the part the scan shows there (edges with their
 * tangents, surface), what the scene's points on it voted for, at which stage its candidates ended, and which pose took
 * their place. The detection is kept until an input or a setting that it depends on changes, so that the next place
 * takes a fraction of the time.
 *
 * Input ports 0 to 3: as vtkMEAMEstimationAlgorithm has them. Input port 4 (optional): poses, a vtkPolyData with
 * `Transform` (16, row-major T_scene_model), such as true ones. Poses with `PlaceProbability` came out of a search: of
 * such a pose, also at a point that it has its surface at, it is told why it came out. Of several types of part, which
 * are connected to port 0 in the order of that search, `PartId` tells the type of each; of poses of several types with
 * one part on port 0 it is told as of poses that came out of nowhere.
 *
 * Output port 0: vtkPolyData, the points of the part that should be visible at the place, in the scene's coordinates,
 * with the point arrays `State` (0 explained; 1 turned, a surface that faces elsewhere; 2 hidden, something lies in
 * front of it; 3 not measured, or lost beside a step of the part; 4 seen past, or of an edge point there is no edge),
 * `StateName` (the same as a text), `IsEdge` (1 of an edge point) and `Residual` (active scalars: the same as `State`,
 * but for 5 of an edge point that is missing in the scan). Field data: `Verdict` (a sentence), `MainReason` (what
 * speaks most for the place and most against it; may be empty), `Advice` (what to change; may be empty), `Reasons`
 * (what speaks for the place and against it, lines), `LostIn` (the stage; empty: it was found), `Rank` (of the pose
 * that came out there; 0: none), `Transform` (16, the place; not there when no pose lies at the point), and of several
 * types `PartId`, that it is about. Output port 1: vtkTable, the numbers of all steps: `Step`, `Quantity`, `Value`,
 * `Of` (what the value is out of, or is compared with; NaN: nothing). Output port 2: the part at the place, as
 * vtkMEAMPoseInstances has it. Output port 3: vtkTable with one row, `Text`: verdict, main reason and advice in lines,
 * with More all reasons, to show in a view. Output port 4: vtkPolyData, measured surface that goes on from the part at
 * the place and is not explained by it, with `Residual` (6).
 */
#ifndef vtkMEAMPoseDiagnosis_h
#define vtkMEAMPoseDiagnosis_h

#include "ppfmeamDetectionModule.h"
#include "vtkMEAMEstimationAlgorithm.h"

class PPFMEAMDETECTION_EXPORT vtkMEAMPoseDiagnosis : public vtkMEAMEstimationAlgorithm
{
public:
  static vtkMEAMPoseDiagnosis* New();
  vtkTypeMacro(vtkMEAMPoseDiagnosis, vtkMEAMEstimationAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Poses of the part, such as true ones. */
  void SetPosesConnection(vtkAlgorithmOutput* poses) { this->SetInputConnection(4, poses); }

  enum Places
  {
    Point = 0,
    Pose = 1,
    RankedPose = 2
  };

  ///@{
  /**
   * What gives the place: Position (Point, 0), PosePosition and PoseRotation (Pose, 1), or RankOfPose of the poses on
   * port 4 (RankedPose, 2). Default: Point.
   */
  vtkMEAMClampedMemberMacro(Place, int, Point, RankedPose);
  void SetPlaceToPoint() { this->SetPlace(Point); }
  void SetPlaceToPose() { this->SetPlace(Pose); }
  void SetPlaceToRankedPose() { this->SetPlace(RankedPose); }
  ///@}

  /** Point: a point of the scan on the part, scene coordinates, mm. Default: 0, 0, 0. */
  vtkMEAMVectorMemberMacro(Position, double, 3);

  /** Pose: where the part's origin lies, scene coordinates, mm. Default: 0, 0, 0. */
  vtkMEAMVectorMemberMacro(PosePosition, double, 3);

  /**
   * Pose: turns about x, y and z in degrees, as vtkProp3D has them: first about y, then about x, then about z. Default:
   * 0, 0, 0.
   */
  vtkMEAMVectorMemberMacro(PoseRotation, double, 3);

  /** RankedPose: which of the poses on port 4, from 1, in their order. Default: 1. */
  vtkMEAMClampedMemberMacro(RankOfPose, int, 1, VTK_INT_MAX);

  /**
   * Of several types of part the one that is asked about, 0 the first on port 0; -1: that of the likely pose at the
   * place, or else the one that has most evidence there, for which all are searched. Of poses on port 4 their `PartId`
   * counts. Default: -1.
   */
  vtkMEAMClampedMemberMacro(PartId, int, -1, VTK_INT_MAX);

  ///@{
  /**
   * A place that is given as a pose is first fitted to the scan, where that leaves it nearby: for poses laid by hand.
   * Default: true.
   */
  vtkMEAMMemberMacro(Fit, bool);
  vtkBooleanMacro(Fit, bool);
  ///@}

  ///@{
  /** The answer in the view has all that speaks for the place and against it, in numbers. Default: false. */
  vtkMEAMMemberMacro(More, bool);
  vtkBooleanMacro(More, bool);
  ///@}

protected:
  vtkMEAMPoseDiagnosis();
  ~vtkMEAMPoseDiagnosis() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  struct Detection;
  std::unique_ptr<Detection> Detected; ///< the last one
  Detection& Detect(vtkInformationVector** inputVector);

  int Place = Point;
  double Position[3] = { 0.0, 0.0, 0.0 };
  double PosePosition[3] = { 0.0, 0.0, 0.0 };
  double PoseRotation[3] = { 0.0, 0.0, 0.0 };
  int RankOfPose = 1;
  int PartId = -1;
  bool Fit = true;
  bool More = false;
};

#endif
