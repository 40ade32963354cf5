// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseDetection
 * @brief Finds raw candidates of the part's poses by voting.
 *
 * Section 5.1 of the paper. A share of the scene's edge points, and of its surface's, are reference points. Each is
 * paired with the referred points within the part's diameter; the pairs of the model with the same feature vote for
 * which point of the model the reference point is, and for the turn about its tangent or normal. The peak of the votes
 * gives one candidate for each reference point. Candidates are not verified: many are wrong.
 *
 * Input port 0: vtkPolyData, edge points of the scene in mm with `Tangent` (vtkMEAMTangentEstimation); those found in a
 * scan have `EdgeSource` (vtkMEAMSceneEdgeExtraction). Input port 1: vtkPartitionedDataSetCollection, the trained model
 * (vtkMEAMHashing). Input port 2, optional: vtkPointSet, all points the sensor measured, in mm: an organized cloud
 * (vtkStructuredGrid, invalid points NaN or blanked) or any cloud. Without it only edges vote.
 *
 * Output port 0: vtkPolyData, one vertex for each candidate where the part's origin lies, in the order of the
 * reference points, those of edges first: `Transform` (16, row-major T_scene_model), `Quaternion` (x y z w), `Votes`,
 * `ViewId` (the appearance model), `Rank` (from 1); `Score` and `VisibleFraction` stay 0 until the poses are verified.
 * Field data `Diameter` (mm, of the part).
 */
#ifndef vtkMEAMPoseDetection_h
#define vtkMEAMPoseDetection_h

#include "ppfmeamDetectionModule.h"
#include "vtkMEAMSensorAlgorithm.h"

#include <memory>

namespace meam
{
struct PoseDetectionSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMPoseDetection : public vtkMEAMSensorAlgorithm
{
public:
  static vtkMEAMPoseDetection* New();
  vtkTypeMacro(vtkMEAMPoseDetection, vtkMEAMSensorAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum FeatureChoices
  {
    Edges = 0,
    Surface = 1,
    Both = 2
  };

  ///@{
  /**
   * Which points of the scene vote, of those that the model holds pairs of (vtkMEAMHashing). Default: Both.
   */
  vtkMEAMDeclareSettingMacro(Features, int);
  void SetFeaturesToEdges() { this->SetFeatures(Edges); }
  void SetFeaturesToSurface() { this->SetFeatures(Surface); }
  void SetFeaturesToBoth() { this->SetFeatures(Both); }
  ///@}

  /**
   * Share of the scene's edge points, and of its surface points, that are reference points, in [0, 1] (P_ref). More
   * finds more of the hidden copies and takes longer. 0: by how many copies the edges would make: in a scan (edges with
   * `EdgeSource`) 40 edge points for each copy, at least 3000, and 0.07 of the surface, at least 300; of an exact
   * boundary 10 for each copy, at least 100, and 0.01 of the surface beside it, at least 50.
   * Default: 0.
   */
  vtkMEAMDeclareSettingMacro(ReferenceShare, double);

  /**
   * Share of the scene's edge points that are referred points, in (0, 1] (P_referred); of those in a cube of the
   * model's LeafSize (vtkMEAMHashing) one. Default: 1. The paper: 0.2.
   */
  vtkMEAMDeclareSettingMacro(ReferredShare, double);

  /** Candidates of one reference point, 1 to 100: more find more hidden copies. Default: 1. */
  vtkMEAMDeclareSettingMacro(PeaksPerReference, int);

  /**
   * The sense in which a pair runs along its tangents tells which way round these lie; false: their stored signs are
   * taken for right, which is wrong for half of the reference points. For comparison. Default: true.
   */
  vtkMEAMDeclareFlagMacro(SignedTangents);

  /** The peak of the votes is that of three neighbouring turns together; false: of single ones. Default: true. */
  vtkMEAMDeclareFlagMacro(SmoothPeaks);

  /** Seed of the choice of both: the same seed gives the same poses. Default: 1. */
  vtkMEAMDeclareSettingMacro(Seed, int);

  /** The parameters of the paper, Section 6. The number of threads stays. */
  void SetParametersToPaper();
  /** The parameters that measure better: the defaults. The number of threads stays. */
  void SetParametersToRecommended();
  /** The parameters of the original pair feature (Drost et al. 2010). The number of threads stays. */
  void SetParametersToOriginalPPF();

protected:
  vtkMEAMPoseDetection();
  ~vtkMEAMPoseDetection() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  struct SharedData;
  std::unique_ptr<SharedData> Shared; ///< what other filters find as long as this one holds it
  std::unique_ptr<meam::PoseDetectionSettings> Settings;
};

#endif
