// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseEstimation
 * @brief The whole method in one filter: CAD and scan in, ranked poses out.
 *
 * Trains the model of the part (paper, Section 4) unless it gets one, extracts the scene's edges from
 * its image unless it gets them, and finds, verifies, refines and selects poses (paper, Section 5) with
 * the parameters of the preset. The steps are those of the single filters, which have all the
 * parameters, and return the same poses. The trained model is kept until the CAD or a setting that it depends on
 * changes. The outputs have the time steps of the scene.
 *
 * A scene and edge points in double precision may lie anywhere: a rigid motion of both, and of the sensor, moves the
 * poses and changes nothing else.
 *
 * Input ports: as vtkMEAMEstimationAlgorithm has them. Of several types of part, of poses that claim the same surface
 * the best supported stays (vtkMEAMConflictResolution).
 *
 * Output port 0: the poses, best first, a vtkPolyData with one vertex each, amid what is visible of the part, and the
 * point arrays
 * `Transform` (16, row-major T_scene_model), `Quaternion` (x y z w), `Score`, `PlaceProbability`, `Probability`,
 * `Certainty` and `VisibleFraction` in [0, 1], `Votes`, `ViewId`, `Rank`, `Label` (rank and probability of those on
 * port 2), and those that vtkMEAMPoseRefinement adds; field data: `Diameter` (mm), `Report` (in a sentence whether
 * parts were found and how sure that is, and which lengths of the part the scan leaves open; where nothing is found, a
 * warning says so, too), `ScanReport` and `ScanQuality` (of an organized scan, as vtkMEAMSceneEdgeExtraction has them),
 * `SceneId` and `ImageId` (of a scan that has them),
 * `EdgesFound` and `EdgesByChance` (share of the edge points of a part that a scene edge lies on, where the part is and
 * anywhere: how far this scan's edges can be trusted), `SecondsTraining`, `SecondsSceneEdges`, `SecondsScene`,
 * `SecondsTangents`, `SecondsDetection`, `SecondsScreening`, `SecondsVerification`, `SecondsRefinement`,
 * `SecondsSelection`, `SecondsOutput` (to fill the outputs), which add up to `SecondsTotal`, and the counts
 * `ScenePoints`, `SceneEdgePoints` and `ModelEdgePoints`; what the stages had to do, the same on any machine:
 * `WorkReferences` (points that voted), `WorkScreened` (candidates), `WorkVerified`, `WorkRefined`, `WorkSelected`;
 * `PartName`, of the part (its field data `Name`, which readers set, or its file's). Of several types of part the point
 * array `PartId` (index of the connection), `PartName` and `Diameter` with a value for each, labels with the name, no
 * `PartBounds`, and port 2 with the array `PartId` (active scalars). Output port 1: the scene's edge points as
 * extracted, a vtkPolyData; with `EdgeSource`, and of the preset Recommended `Tangent`, unless they came in, and `Rank`
 * (active scalars): of the first pose that has an edge of the part there, 0 of edge points that no pose explains.
 * Output port 2: the part at each pose that is likely enough to be shown (ShownProbability), as vtkMEAMPoseInstances
 * has it; of a trained model points of its surface. Output port 3: a vtkTable with a row for each pose, to plot: `Pose`
 * (its rank), `PlaceProbability`, `Probability`, `Score`, `VisibleFraction`, `Certainty`. Output port 4: a vtkTable
 * with a row for each stage: `Stage`, `Seconds`. Output port 5: a vtkTable with one row, `Text`: that no part was
 * found, or how many poses are not shown, and what to change first in the scan or the settings (the field data `Advice`
 * of the poses), to show in a view; empty when all are shown and nothing stands out. Output port 6: the trained model
 * as vtkMEAMHashing returns it, to be saved; empty of several types of part.
 */
#ifndef vtkMEAMPoseEstimation_h
#define vtkMEAMPoseEstimation_h

#include "ppfmeamDetectionModule.h"
#include "vtkMEAMEstimationAlgorithm.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <string>

class vtkPartitionedDataSetCollection;

namespace vtkMEAMConversion
{
struct TrainedPart;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMPoseEstimation : public vtkMEAMEstimationAlgorithm
{
public:
  static vtkMEAMPoseEstimation* New();
  vtkTypeMacro(vtkMEAMPoseEstimation, vtkMEAMEstimationAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Poses where a copy is less likely to be there, [0, 1], have neither a part on port 2 nor a `Label`; they stay among
   * the poses. Default: 0.5, those that are there more likely than not are shown.
   */
  vtkMEAMClampedMemberMacro(ShownProbability, double, 0.0, 1.0);

  /**
   * What the last scan suggests to change first, and in a second line what that rests on: pixels on the part, noise,
   * edges that are found, and how many candidates were left at which stage. Empty before the first update, or after one
   * that failed.
   */
  const char* GetSuggestion() const { return this->Suggestion.c_str(); }

protected:
  vtkMEAMPoseEstimation();
  ~vtkMEAMPoseEstimation() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  double ShownProbability = 0.5;
  std::string Suggestion;
  std::shared_ptr<const vtkMEAMConversion::TrainedPart> Given; ///< the part whose model GivenData is
  vtkSmartPointer<vtkPartitionedDataSetCollection> GivenData;
};

#endif
