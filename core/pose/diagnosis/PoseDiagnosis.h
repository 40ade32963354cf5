// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/diagnosis/DetectionTrace.h"
#include "pose/diagnosis/PlaceEvidence.h"
#include "pose/voting/VoteSupport.h"

namespace meam
{
// Which pose a picked point asks about.
inline constexpr double OnSurface = 0.025; ///< of the diameter: a point this near to a pose's surface lies on it
inline constexpr double LikelyFound = 0.5; ///< a pose that is there more likely than not: it is drawn

/// How far a point is from a part, mm: from its surface, and 0 at its origin, where the translation of its pose is.
double distanceFrom(const TrainedModel& model, const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& point);

/// Why a part did not come out, or came out as it did.
enum class LossCause
{
  None,           ///< it was found
  NothingShown,   ///< the scan shows no edges, or a few by chance, as a floor with nothing on it
  NoPose,         ///< no pose of the part has its surface at the picked point
  Outside,        ///< its middle lies outside of the region
  NotThere,       ///< the sensor saw past most of the surface
  NotMeasured,    ///< nothing was measured where most of the surface is
  Enclosed,       ///< some of it would be behind the bin's floor or a wall
  Hidden,         ///< something lies in front of it
  FewEdges,       ///< no more edges on it than anywhere
  NoReference,    ///< points on it would have elected it, but are no reference points
  Outvoted,       ///< other poses got more votes at every reference point on it
  SurfaceMissing, ///< screening found too little of its surface
  Duplicate,      ///< screening took it for a duplicate of a better candidate
  LowScore,       ///< verification dropped it
  OtherRotation,  ///< turned by an approximate symmetry
  Taken,          ///< another pose of the same instance was preferred
  NotRefined,     ///< too unlikely for refinement
  MovedAway,      ///< refinement led elsewhere
  Inaccurate,     ///< it came out, but turned too far
  NotWanted       ///< found, but not among the best that were wanted, or less likely
};

/// How many poses of a stage are at the place.
struct StageCount
{
  PoseStage stage;
  int poses;
  int here;
  int bestRank; ///< of those here in the stage's order, from 1; 0: none
};

struct Diagnosis
{
  LossCause cause = LossCause::None;
  std::optional<PoseStage> lostIn; ///< none when it was found
  std::optional<Pose> place;       ///< scored as if voting had found it, the scene's own coordinates; none: NoPose
  PlaceEvidence evidence;          ///< at the place
  PrecisePoints edgePoints;        ///< those of the evidence in the scene's own coordinates
  PrecisePoints surfacePoints;     ///< the same
  PrecisePoints unexplained;       ///< measured surface that goes on beside the part, the scene's own coordinates
  double continuing = 0.0;         ///< patches of it that no other likely pose explains
  double surfaceShare = 0.0;       ///< as screening finds it
  double candidateShare = 0.0;     ///< lost in screening: the best of the candidates here
  int placeRank = 0;               ///< the place's among all refined poses, by evidence, from 1; 0: it was dropped
  double bestEvidence = 0.0;       ///< of these
  std::vector<PointVotes> votes;   ///< of points on the part
  std::vector<StageCount> stages;
  int rank = 0;                   ///< of what came out here, from 1; 0: nothing did
  PoseOffset offset{ 0.0, 0.0 };  ///< of what came out here, or of where refinement led to
  double probability = 0.0;       ///< of a copy where it came out, or would without limits
  std::optional<Pose> found;      ///< what came out here, or would without limits, local frame
  bool isOfFound = false;         ///< it is asked about a pose that came out, right or wrong
  PlaceOdds odds;                 ///< what speaks for it and against it; nothing with the paper's verification
  double penalty = 0.0;           ///< log odds that it was searched for by lack, for a pattern search moved it there
  double moreByCalibration = 0.0; ///< log odds by what the model's calibration has taught
  double lessByOthers = 0.0;      ///< log odds that what came out has less than by these terms, for the set it is in
  int cutsInto = 0;               ///< rank without limits of the likeliest pose whose body its own cuts into; 0: none
  int otherRank = 0;              ///< without limits, from 1, of the nearest other pose of another place; 0: none near
  double otherProbability = 0.0;  ///< of a copy there
  PoseOffset otherOffset{ 0.0, 0.0 }; ///< of it
  int rankWithoutLimits = 0;          ///< the same if all poses came out
  int takenBy = 0;            ///< rank without limits, from 1, of the pose that explains most of the place's points
  double takenShare = 0.0;    ///< of the measured points that the place explains, those that this pose explains, too
  double takenEvidence = 0.0; ///< of that pose
  bool isFoundByAllPoints = false; ///< lost before refinement, it comes out when all points about it vote
};

/// Runs the detection of parts in a scene once, and then tells of places what became of a part there. Keeps references.
class PoseDiagnosis
{
public:
  /// `fit`: a place given as a pose is fitted to the scene first where that leaves it nearby.
  PoseDiagnosis(const Scene& scene, const TrainedModel& model, const DetectionSettings& detection, bool fit = true,
    const Progress& progress = {});
  PoseDiagnosis(const PoseDiagnosis&) = delete;
  void operator=(const PoseDiagnosis&) = delete;

  /// Of the part at a pose, in the scene's own coordinates. Throws Error for a pose that is not finite.
  Diagnosis atPose(const Eigen::Isometry3d& T_scene_model, const Progress& progress = {});
  /// Of a pose that came out of a search as this rank, from 1, in the scene's own coordinates: right or wrong, it was
  /// found. Another search, as this one of all parts, may have another pose there.
  Diagnosis ofFound(const Pose& pose, int rank, const Progress& progress = {});
  /// Of the part that a point of the scan (the scene's own coordinates) lies on: at the pose that came out there, or
  /// else at the best of those that limits kept back and those that are found where all points about it vote. `found`:
  /// poses that came out of a search and have these ranks; the nearest that has its surface there comes before all
  /// others where it is likely.
  Diagnosis atPoint(const Eigen::Vector3d& point, const Progress& progress = {}, const Poses& found = {},
    const std::vector<int>& ranks = {});

  const DetectionTrace& trace() const { return this->Trace; }

private:
  /// `found`: the pose, where it came out of a search as that rank.
  Diagnosis at(
    const Eigen::Isometry3d& T_local_model, const Progress& progress, const Pose* found = nullptr, int rank = 0);
  /// The pose, or what it is fitted to the scene as, when that is near.
  Eigen::Isometry3d fitted(const Eigen::Isometry3d& T_local_model) const;
  void score(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model) const;
  void count(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model) const;
  /// Sets which pose has the place's points.
  void findTaker(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model);
  /// Sets the surface that goes on beside it.
  void continueSurface(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model) const;
  void takeFound(Diagnosis& diagnosis, const Pose& found, int rank) const;
  LossCause causeOf(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model, const Progress& progress);
  /// Whether it comes out, without limits, when all points about it vote.
  bool isFoundByAllPoints(const Eigen::Isometry3d& T_local_model, const Progress& progress) const;
  static LossCause causeInVoting(const Diagnosis& diagnosis);
  LossCause causeInScreening(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model) const;
  /// Sets what speaks for it and against it, and which other pose is near.
  void explain(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model);
  /// Found as this pose without limits.
  LossCause notWanted(Diagnosis& diagnosis, int rank, const Eigen::Isometry3d& T_local_model);
  /// As the refined poses were verified.
  PoseVerificationSettings verification() const;
  bool isTurnedAmong(const Poses& poses, const Eigen::Isometry3d& T_local_model) const;
  PlaceTolerance tolerance() const;

  const Scene& InScene;
  const TrainedModel& Model;
  DetectionSettings Detection;
  bool Fit;
  DetectionTrace Trace;
};
}
