// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseVerification
 * @brief Scores poses against the scene and keeps the best of each instance.
 *
 * Section 5.2 of the paper. EdgeCoverage is the paper's score: the share of the edge appearance model of the
 * pose that has a scene edge point near. VisibleEvidence, the recommended one, asks of each edge and surface
 * point that should be visible at the pose whether the sensor saw it, saw something in front of it (which
 * says nothing) or looked past it (which speaks against the pose), and which scene edges on the part stay
 * unexplained. Where nothing was measured, as in glare, the surface says nothing. Then poses near each other are of one
 * instance, of which the best are kept. When more poses come than may stay, those whose surface is not there at a glance
 * go first.
 *
 * Input port 0: vtkPolyData of poses (vtkMEAMPoseDetection, vtkMEAMPoseRefinement or a pose file): `Transform`.
 * Input port 1: vtkPartitionedDataSetCollection, the trained model (vtkMEAMHashing).
 * Input port 2: vtkPolyData, edge points of the scene in mm with `Tangent` (vtkMEAMTangentEstimation).
 * Input port 3, optional: vtkPointSet, all points the sensor measured, in mm: an organized cloud
 * (vtkStructuredGrid, invalid points NaN or blanked) or any cloud. Without it only edges count.
 *
 * Output port 0: vtkPolyData, the poses that stay, best first, with `Score` (share of what should be visible that is
 * there), `Probability` (that the pose is right), `Certainty` (that no near-symmetry turns it) and `VisibleFraction`
 * (without a surface 1: nothing tells what hides), all in [0, 1], `ViewId`, `Rank` and the other arrays of vtkMEAMPoseDetection. Field data `Diameter` (mm, of the part).
 */
#ifndef vtkMEAMPoseVerification_h
#define vtkMEAMPoseVerification_h

#include "vtkMEAMSensorAlgorithm.h"

namespace meam
{
struct PoseVerificationSettings;
}

class PPFMEAMFILTERS_EXPORT vtkMEAMPoseVerification : public vtkMEAMSensorAlgorithm
{
public:
  static vtkMEAMPoseVerification* New();
  vtkTypeMacro(vtkMEAMPoseVerification, vtkMEAMSensorAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Methods
  {
    EdgeCoverage = 0,
    VisibleEvidence = 1
  };

  ///@{
  /** EdgeCoverage (0, the paper's) or VisibleEvidence (1). Default: VisibleEvidence. */
  vtkSetClampMacro(Method, int, EdgeCoverage, VisibleEvidence);
  vtkGetMacro(Method, int);
  void SetMethodToEdgeCoverage() { this->SetMethod(EdgeCoverage); }
  void SetMethodToVisibleEvidence() { this->SetMethod(VisibleEvidence); }
  ///@}

  ///@{
  /**
   * A point of the model this near to the scene fits, in mm; 0: 3 % of the part's diameter. Default: 0.
   * The paper: 1.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * What edges, surface, and that scene edges on the part are explained count in the score of VisibleEvidence: three numbers
   * of 0 or more, not all 0. Where a part is printed on, edges are there that its model does not explain: then the third is
   * better 0. Without a surface edges alone count. `Probability` is calibrated for the defaults. Default: 0.4, 0.4, 0.2.
   */
  vtkSetVector3Macro(EvidenceWeights, double);
  vtkGetVector3Macro(EvidenceWeights, double);
  ///@}

  ///@{
  /**
   * Surface of a pose that the sensor looked past speaks against it; false: it says nothing, as where nothing was measured.
   * Default: true.
   */
  vtkSetMacro(FreeSpace, bool);
  vtkGetMacro(FreeSpace, bool);
  vtkBooleanMacro(FreeSpace, bool);
  ///@}

  ///@{
  /**
   * Turns that compete for an instance are judged on what one of them alone predicts; false: each on all that it predicts,
   * so that what it happens to be seen from decides, too. Only with PosesPerInstance 1. Default: true.
   */
  vtkSetMacro(SameVisibility, bool);
  vtkGetMacro(SameVisibility, bool);
  vtkBooleanMacro(SameVisibility, bool);
  ///@}

  ///@{
  /** Poses with a lower score, in [0, 1], are dropped. Default: 0. */
  vtkSetClampMacro(MinimumScore, double, 0.0, 1.0);
  vtkGetMacro(MinimumScore, double);
  ///@}

  ///@{
  /** Best poses kept for each appearance model (N_pv); 0: no limit. Default: 0. The paper: 5. */
  vtkSetClampMacro(PosesPerView, int, 0, VTK_INT_MAX);
  vtkGetMacro(PosesPerView, int);
  ///@}

  ///@{
  /** Poses nearer than this are of one instance, in mm; 0: 10 % of the part's diameter. Default: 0. */
  vtkSetClampMacro(ClusterDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ClusterDistance, double);
  ///@}

  ///@{
  /** Poses of one instance that are turned less than this are the same, in degrees. Default: 15. */
  vtkSetClampMacro(ClusterAngle, double, 0.0, 180.0);
  vtkGetMacro(ClusterAngle, double);
  ///@}

  ///@{
  /**
   * Poses kept of one instance; of those that a near-symmetry, or any turn of a nearly round part, turns into each other
   * one is kept. With 1, as for the result, alternatives are decided on the points that tell them apart, a nearly round part is turned to where it
   * fits best, and each pose settles where edges and surface fix it, the same whichever candidate led there; more keep
   * the alternatives for refinement. Default: 2. The paper: 1.
   */
  vtkSetClampMacro(PosesPerInstance, int, 1, VTK_INT_MAX);
  vtkGetMacro(PosesPerInstance, int);
  ///@}

  ///@{
  /**
   * Poses kept of all; 0: no limit. When more come, as from detection, and alternatives are kept, each is first turned by
   * the near-symmetry that the scene's edges speak for, and those that are a thousand times less likely than the best go,
   * too. Default: 100.
   */
  vtkSetClampMacro(MaximumNumberOfPoses, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfPoses, int);
  ///@}

  ///@{
  /** Of what comes out, poses that are less likely to be right are dropped, in [0, 1]. Default: 0. */
  vtkSetClampMacro(MinimumProbability, double, 0.0, 1.0);
  vtkGetMacro(MinimumProbability, double);
  ///@}

  /** The parameters of the paper, Section 6. Sensor and number of threads stay. */
  void SetParametersToPaper();
  /** The parameters that measure better: the defaults. Sensor and number of threads stay. */
  void SetParametersToRecommended();

protected:
  vtkMEAMPoseVerification();
  ~vtkMEAMPoseVerification() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMPoseVerification(const vtkMEAMPoseVerification&) = delete;
  void operator=(const vtkMEAMPoseVerification&) = delete;

  void SetParameters(const meam::PoseVerificationSettings& settings);

  int Method;
  double Tolerance;
  double EvidenceWeights[3];
  bool FreeSpace;
  bool SameVisibility;
  double MinimumScore;
  int PosesPerView;
  double ClusterDistance;
  double ClusterAngle;
  int PosesPerInstance;
  int MaximumNumberOfPoses;
  double MinimumProbability;
};

#endif
