// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseSelection
 * @brief Keeps the poses of each instance that are worth it.
 *
 * Clusters keeps the best of each cluster of poses, as the paper does. Alternatives keeps some of each instance, for
 * refinement; candidates that are equal up to an approximate symmetry are merged. Instances, for the result, keeps one
 * of each instance: poses that share most of what they match are of one instance, too; which stays is decided on the
 * points that tell them apart; it is turned about the axis of a nearly round part, or by an approximate symmetry, where
 * the scene speaks for it, aligned once more robustly, so that it stays at the same place whichever candidate led
 * there, moved from there where the sensor saw past it and the scan speaks more for a place near by, and scored.
 *
 * Input ports: as vtkMEAMPoseAlgorithm has them; port 0: scored poses, best first (vtkMEAMPoseVerification).
 * Output port 0: the poses that stay, best first; of Instances with `Certainty` (that no near-symmetry turns it, [0,
 * 1]) and the arrays that vtkMEAMPoseRefinement adds.
 */
#ifndef vtkMEAMPoseSelection_h
#define vtkMEAMPoseSelection_h

#include "vtkMEAMPoseAlgorithm.h"

namespace meam
{
struct PoseSelectionSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMPoseSelection : public vtkMEAMPoseAlgorithm
{
public:
  static vtkMEAMPoseSelection* New();
  vtkTypeMacro(vtkMEAMPoseSelection, vtkMEAMPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Methods
  {
    Clusters = 0,
    Alternatives = 1,
    Instances = 2
  };

  ///@{
  /**
   * Clusters (0, the paper's), Alternatives (1) or Instances (2). Default: Instances.
   */
  vtkMEAMDeclareSettingMacro(Method, int);
  void SetMethodToClusters() { this->SetMethod(Clusters); }
  void SetMethodToAlternatives() { this->SetMethod(Alternatives); }
  void SetMethodToInstances() { this->SetMethod(Instances); }
  ///@}

  /**
   * Poses nearer than this are of one instance, in mm; 0: 10 % of the part's diameter. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(ClusterDistance, double);

  /**
   * Alternatives: poses kept of one instance. Default: 4.
   */
  vtkMEAMDeclareSettingMacro(PosesPerInstance, int);

  /**
   * Poses kept of all, the best ones; 0: no limit; of Alternatives the best 60, or all whose probability is above 3e-7
   * where these are more. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(MaximumNumberOfPoses, int);

  /**
   * Of what comes out, poses are dropped where a copy is less likely to be there, however it is turned, in [0, 1].
   * Default: 0.
   */
  vtkMEAMDeclareSettingMacro(MinimumProbability, double);

  /**
   * The minimum probability is that of the pose, its rotation included: poses of a nearly round part whose
   * rotation is unsure are dropped, too. Default: off.
   */
  vtkMEAMDeclareFlagMacro(RotationCounts);

  /**
   * Instances: surface of a pose that the sensor saw past speaks against it; false: it says nothing, as where nothing
   * was measured. Default: true.
   */
  vtkMEAMDeclareFlagMacro(FreeSpace);

  /**
   * Instances: poses that compete for an instance are compared on what one of them alone predicts; false: each on all
   * that it predicts, so that what it happens to be seen from decides, too. Default: true.
   */
  vtkMEAMDeclareFlagMacro(SameVisibility);

  /** The parameters of the paper, Section 6. Sensor and number of threads stay. */
  void SetParametersToPaper();
  /** The parameters that measure better: the defaults. Sensor and number of threads stay. */
  void SetParametersToRecommended();
  /** The recommended parameters of this step before refinement. Sensor and number of threads stay. */
  void SetParametersToCandidates();
  /** Those of the methods that rank poses by their votes, before refinement. Sensor and number of threads stay. */
  void SetParametersToVotes();

protected:
  vtkMEAMPoseSelection();
  ~vtkMEAMPoseSelection() override;
  void Process(Work& work) override;

private:
  std::unique_ptr<meam::PoseSelectionSettings> Settings;
};

#endif
