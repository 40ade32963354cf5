// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/MEAMPoseEstimation.h"
#include "pose/PoseMemory.h"
#include "pose/selection/InstanceSelection.h"
#include "pose/verification/PoseVerification.h"

#include <functional>
#include <map>
#include <optional>

namespace meam
{
/// The stages from reference points to ranked poses of one type of part, which can go on with more reference points and
/// for more copies: what was found out of candidates stays known. All poses are in the scene's local frame.
class PoseSearch
{
public:
  /// Keeps references to all of these. The settings' deadline is the caller's.
  PoseSearch(const Scene& scene, const TrainedModel& model, const DetectionSettings& settings, DetectionReport& told,
    const PoseObserver& observer = {});

  /// Takes the candidates of reference points up to a share of them, [0, 1], as far as refined poses with their scores,
  /// in place of those before: where a number of copies is wanted (0: all) no more than it takes, else until further
  /// ones find no place more.
  void upTo(double share, int wanted, const Progress& progress = {});
  /// The same with candidates from elsewhere.
  void rank(Poses candidates, int wanted, const Progress& progress = {});

  /// How many copies in the region are as good as found.
  int sure() const;

  /// Whether its middle lies in the region that is searched.
  bool isWanted(const Pose& pose) const;

  /// Takes one pose of each instance to where it lies, by the scan's own rates. Those that tell what the scan holds.
  Poses finish(PoseSelectionSettings selection, const Progress& progress = {});
  /// Of these ranked poses, with those outside of the region that compete with the others. `onOthers`: which of the
  /// telling ones are on copies of other types; empty: none.
  Poses ranked(const std::vector<bool>& onOthers = {});
  /// Both.
  Poses select(const PoseSelectionSettings& selection, const Progress& progress = {});
  /// Without those.
  Poses selectWanted(const PoseSelectionSettings& selection, const Progress& progress = {});

private:
  /// How many places in the region have a refined pose with so much log odds.
  int places(double leastLogOdds) const;

  void returned(PoseStage stage, const Poses& poses);
  Eigen::Vector3d middleInScan(const Pose& pose) const;

  const Scene& InScene;
  const TrainedModel& Model;
  const DetectionSettings& Settings;
  DetectionReport& Told;
  PoseObserver Observer;
  std::optional<CandidateSearch> Search; ///< from when reference points vote
  EvidenceMemory Candidates;             ///< of those that lots before had, too
  PoseMemory<Pose> Refined;              ///< by what they were before
  EvidenceMemory OfRefined;
  std::optional<EvidenceRates> Rates; ///< of the scan, by the candidates
  Poses Verified;
  PoseSelectionSettings Selection;
  std::optional<InstanceSelection> Instances;
  std::map<PoseStage, Poses> Returned; ///< in the order of the stages
};

/// Calls `search` with more and more of the reference points, as a share of all, until it returns that they were
/// enough. `wanted`: so many copies that are sure are enough; 0: all points vote. `ofVotes`: when refined poses have to
/// be there.
void searchByShares(const DetectionSettings& settings, const Progress& progress,
  const std::function<bool(double share, int wanted, const Deadline& ofVotes, const Progress& progress)>& search);
}
