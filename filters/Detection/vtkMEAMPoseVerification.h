// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseVerification
 * @brief Scores poses against the scene.
 *
 * Section 5.2 of the paper. EdgeCoverage is the paper's score: the share of the edge appearance model of the pose that
 * has a scene edge point near. VisibleEvidence, the recommended one, asks of each edge and surface point that should be
 * visible at the pose whether the sensor saw it and it faces the right way, saw something in front of it or saw past
 * it, and whether the surface goes on beyond the part's outline. The more independent places tell the same, the more it
 * says; edges count as far as this scan's edges can be trusted, which is measured on the poses of the input.
 *
 * Input ports: as vtkMEAMPoseAlgorithm has them.
 * Output port 0: vtkPolyData, the poses, or the best PosesPerView of each view, best first, with `Evidence` (logarithm
 * of the odds that a copy is there), `PlaceProbability` (the same as a probability), `Probability` (that times
 * `Certainty`), `Score` (share of the surface that
 * nothing hides that is there; without a surface, of the edges) and `VisibleFraction` (without a surface 1: nothing
 * tells what hides), all in [0, 1], `ViewId`, `Rank` and the other arrays of vtkMEAMPoseDetection.
 */
#ifndef vtkMEAMPoseVerification_h
#define vtkMEAMPoseVerification_h

#include "vtkMEAMPoseAlgorithm.h"

namespace meam
{
struct PoseVerificationSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMPoseVerification : public vtkMEAMPoseAlgorithm
{
public:
  static vtkMEAMPoseVerification* New();
  vtkTypeMacro(vtkMEAMPoseVerification, vtkMEAMPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Methods
  {
    EdgeCoverage = 0,
    VisibleEvidence = 1,
    Votes = 2
  };

  ///@{
  /**
   * EdgeCoverage (0, the paper's), VisibleEvidence (1), or Votes (2): those of all poses that agree with one, as a
   * share of the most, without a look at the scene, as methods before the paper rank poses. Default: VisibleEvidence.
   */
  vtkMEAMDeclareSettingMacro(Method, int);
  void SetMethodToEdgeCoverage() { this->SetMethod(EdgeCoverage); }
  void SetMethodToVisibleEvidence() { this->SetMethod(VisibleEvidence); }
  void SetMethodToVotes() { this->SetMethod(Votes); }
  ///@}

  /**
   * A point of the model this near to the scene fits, in mm; 0: 3 % of the part's diameter. Default: 0.
   * The preset Paper: 1.5, which the text leaves open.
   */
  vtkMEAMDeclareSettingMacro(Tolerance, double);

  /**
   * Surface of a pose that the sensor saw past speaks against it; false: it says nothing, as where nothing was
   * measured. Default: true.
   */
  vtkMEAMDeclareFlagMacro(FreeSpace);

  /**
   * Of the predicted points one of so many is looked at: 2 is enough for candidates. Default: 1.
   */
  vtkMEAMDeclareSettingMacro(PointStride, int);

  /**
   * Best poses kept for each appearance model (N_pv); 0: no limit. Default: 0. The paper: 5 in its picking cell;
   * its preset: 20.
   */
  vtkMEAMDeclareSettingMacro(PosesPerView, int);

  /** The parameters of the paper, Section 6. Sensor and number of threads stay. */
  void SetParametersToPaper();
  /** The parameters that measure better: the defaults. Sensor and number of threads stay. */
  void SetParametersToRecommended();
  /** The recommended parameters of this step before refinement. Sensor and number of threads stay. */
  void SetParametersToCandidates();
  /** Those of the methods that rank poses by their votes. Sensor and number of threads stay. */
  void SetParametersToVotes();

protected:
  vtkMEAMPoseVerification();
  ~vtkMEAMPoseVerification() override;
  void Process(Work& work) override;

private:
  std::unique_ptr<meam::PoseVerificationSettings> Settings;
};

#endif
