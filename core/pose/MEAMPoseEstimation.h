// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "features/Preset.h"
#include "features/TangentEstimation.h"
#include "pose/Deadline.h"
#include "pose/refinement/PoseRefinement.h"
#include "pose/selection/PoseSelection.h"
#include "pose/verification/PoseScreening.h"
#include "pose/verification/PoseVerification.h"
#include "pose/voting/PoseDetection.h"
#include "scene/Scene.h"

#include <functional>
#include <memory>
#include <optional>

namespace meam
{
class SearchRegion;

struct DetectionSettings
{
  TangentEstimationSettings tangents;
  SceneSettings scene;
  PoseDetectionSettings detection;
  std::optional<PoseScreeningSettings> screening; ///< of the raw candidates; the paper has none
  PoseVerificationSettings candidateVerification;
  PoseSelectionSettings candidateSelection; ///< of those to be refined
  PoseRefinementSettings refinement;
  PoseVerificationSettings verification;      ///< of the refined poses
  PoseSelectionSettings selection;            ///< one for each instance
  Deadline deadline;                          ///< then the best come out that are found
  std::shared_ptr<const SearchRegion> region; ///< where middles of parts may be; null: everywhere
};

/// `maximumPoses` is the number of poses wanted, 0 for all, and `minimumProbability` that of each; `threads` 0 for one
/// for each processor.
DetectionSettings detectionSettings(
  Preset preset, int maximumPoses = 5, int threads = 0, double minimumProbability = 0.0);

/// Seconds spent in each stage of the online phase.
struct StageTimes
{
  double tangents = 0.0;
  double scene = 0.0; ///< what is looked up in the scene
  double detection = 0.0;
  double screening = 0.0;
  double verification = 0.0;
  double refinement = 0.0;
  double selection = 0.0; ///< with the final alignment and what follows

  StageTimes& operator+=(const StageTimes& other);
};

/// What the stages had to do, the same on any machine.
struct WorkCounts
{
  int references = 0; ///< reference points that voted
  int screened = 0;   ///< candidates
  int verified = 0;   ///< of them
  int refined = 0;    ///< poses
  int selected = 0;   ///< refined poses that instances were chosen from

  WorkCounts& operator+=(const WorkCounts& other);
};

/// What detection tells besides poses.
struct DetectionReport
{
  StageTimes times;
  WorkCounts work;
  std::optional<EvidenceRates> rates; ///< of the scan, by the candidates; none with the paper's verification
  bool isCutShort = false;            ///< by the deadline
  int maximumPoses = 0;               ///< that were asked for; 0: all
};

/// What a sensor says of a bin.
struct SceneInput
{
  LocalCloud edges;                ///< edge points, not thinned yet, with tangents where they are known
  Points measured;                 ///< all points that the sensor measured, in the frame of the edges; may be empty
  Sensor sensor;                   ///< in the scene's own coordinates
  ScanQuality quality{};           ///< how well it measures, where that is known
  bool isViewpointGuessed = false; ///< nothing tells where the sensor stood
};

/// The scene of an input, with its edges thinned as for the model. Of `times`, which may be null, it sets `tangents`.
Scene sceneOf(const TrainedModel& model, const SceneInput& input, const DetectionSettings& settings,
  StageTimes* times = nullptr, const Progress& progress = {});

/// The stages that return poses, in their order; without screening there is none of its kind.
enum class PoseStage
{
  Voting,
  Screening,
  CandidateVerification,
  CandidateSelection,
  Refinement,
  Verification,
  Selection
};

/// Called with what a stage returned, local frame.
using PoseObserver = std::function<void(PoseStage, const Poses&)>;

/// The stages after voting: ranked poses of raw candidates, all in the scene's local frame. `report` may be null.
Poses rankCandidates(Poses candidates, const Scene& scene, const TrainedModel& model, const DetectionSettings& settings,
  DetectionReport* report = nullptr, const Progress& progress = {}, const PoseObserver& observer = {});

/// All stages that return poses: ranked poses in the scene's local frame. `report` may be null.
Poses findPoses(const Scene& scene, const TrainedModel& model, const DetectionSettings& settings,
  DetectionReport* report = nullptr, const Progress& progress = {}, const PoseObserver& observer = {});

/// Whether a scan has no edges, or a few by chance, as a floor with nothing on it. Throws Error when its unit is
/// another one than the part's.
bool showsNothing(const SceneInput& input, double partDiameter);

/// The online phase: ranked poses in the scene's own coordinates (mm); none in a scan that shows no edges. Everything
/// happens in the frame of the edges.
/// `report` may be null.
Poses estimatePoses(const TrainedModel& model, const SceneInput& input, const DetectionSettings& settings,
  DetectionReport* report = nullptr, const Progress& progress = {});
}
