// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseVerification
 * @brief Scores poses against the scene.
 *
 * Section 5.2 of the paper. EdgeCoverage is the paper's score: the share of the edge appearance model of the pose that
 * has a scene edge point near. VisibleEvidence, the recommended one, asks of each edge and surface point that should be
 * visible at the pose whether the sensor saw it, saw something in front of it (which says nothing) or saw past it
 * (which speaks against the pose), and which scene edges on the part stay unexplained. Where nothing was measured, as
 * in glare, the surface says nothing.
 *
 * Input ports: as vtkMEAMPoseAlgorithm has them.
 * Output port 0: vtkPolyData, every pose but those below MinimumScore, best first, with `Score` (share of what should
 * be visible that is there), `Probability` (that the pose is right) and `VisibleFraction` (without a surface 1: nothing
 * tells what hides), all in [0, 1], `ViewId`, `Rank` and the other arrays of vtkMEAMPoseDetection.
 */
#ifndef vtkMEAMPoseVerification_h
#define vtkMEAMPoseVerification_h

#include "vtkMEAMPoseAlgorithm.h"

namespace meam
{
struct PoseVerificationSettings;
}

class PPFMEAMFILTERS_EXPORT vtkMEAMPoseVerification : public vtkMEAMPoseAlgorithm
{
public:
  static vtkMEAMPoseVerification* New();
  vtkTypeMacro(vtkMEAMPoseVerification, vtkMEAMPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Methods
  {
    EdgeCoverage = 0,
    VisibleEvidence = 1
  };

  ///@{
  /**
   * EdgeCoverage (0, the paper's) or VisibleEvidence (1). Default: VisibleEvidence.
   */
  virtual void SetMethod(int value);
  virtual int GetMethod();
  void SetMethodToEdgeCoverage() { this->SetMethod(EdgeCoverage); }
  void SetMethodToVisibleEvidence() { this->SetMethod(VisibleEvidence); }
  ///@}

  ///@{
  /**
   * A point of the model this near to the scene fits, in mm; 0: 3 % of the part's diameter. Default: 0.
   * The paper: 1.
   */
  virtual void SetTolerance(double value);
  virtual double GetTolerance();
  ///@}

  ///@{
  /**
   * What edges, surface, and that scene edges on the part are explained count in the score: three numbers of 0 or more,
   * not all 0. Where a part is printed on, edges are there that its model does not explain: then the third is better 0.
   * Without a surface edges alone count. `Probability` is calibrated for the defaults. Default: 0.4, 0.4, 0.2.
   */
  virtual void SetEvidenceWeights(double edges, double surface, double explained);
  virtual void SetEvidenceWeights(const double values[3]) { this->SetEvidenceWeights(values[0], values[1], values[2]); }
  virtual double* GetEvidenceWeights() VTK_SIZEHINT(3);
  ///@}

  ///@{
  /**
   * Surface of a pose that the sensor saw past speaks against it; false: it says nothing, as where nothing was
   * measured. Default: true.
   */
  virtual void SetFreeSpace(bool value);
  virtual bool GetFreeSpace();
  vtkBooleanMacro(FreeSpace, bool);
  ///@}

  ///@{
  /**
   * Of the predicted points one of so many is looked at: 2 is enough for candidates. Default: 1.
   */
  virtual void SetPointStride(int value);
  virtual int GetPointStride();
  ///@}

  ///@{
  /**
   * Poses with a lower score, in [0, 1], are dropped. Default: 0.
   */
  virtual void SetMinimumScore(double value);
  virtual double GetMinimumScore();
  ///@}

  ///@{
  /**
   * Best poses kept for each appearance model (N_pv); 0: no limit. Default: 0. The paper: 5.
   */
  virtual void SetPosesPerView(int value);
  virtual int GetPosesPerView();
  ///@}

  /** The parameters of the paper, Section 6. Sensor and number of threads stay. */
  void SetParametersToPaper();
  /** The parameters that measure better: the defaults. Sensor and number of threads stay. */
  void SetParametersToRecommended();

protected:
  vtkMEAMPoseVerification();
  ~vtkMEAMPoseVerification() override;
  void Process(Work& work) override;

private:
  vtkMEAMPoseVerification(const vtkMEAMPoseVerification&) = delete;
  void operator=(const vtkMEAMPoseVerification&) = delete;

  std::unique_ptr<meam::PoseVerificationSettings> Settings;
  double Weights[3]; ///< what GetEvidenceWeights() hands out
};

#endif
