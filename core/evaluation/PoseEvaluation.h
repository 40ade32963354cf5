// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "mesh/Symmetries.h"
#include "pose/Pose.h"

#include <utility>
#include <vector>

namespace meam
{
struct PoseEvaluationSettings
{
  double diameter = 0.0;              ///< mm, d_max of the part; has to be given
  double translationTolerance = 10.0; ///< % of the diameter; a right pose is nearer to a true one
  double rotationTolerance = 5.0;     ///< degrees; and is turned by less
  int posesAskedFor = 5;              ///< best ones of a scene that are judged; 0: all there are
  /// Point of the part, model frame, mm, whose displacement is the translation error. An origin far from the part
  /// would turn the least rotation into one.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(); ///< of the part, model frame, for axis and roll
  Symmetries symmetries;               ///< of the part; the equal pose that is nearest to the true one is judged
  double minimumVisibleFraction = 0.5; ///< of a true instance that has to be found, for the recall
};

/// What an estimated pose is.
enum class PoseOutcome
{
  Hit,        ///< right, and the first for its instance
  Duplicate,  ///< right, but a better pose has found the same instance
  WrongTurn,  ///< near enough to a true pose, but turned too far
  WrongPlace, ///< too far from every true pose
};

/// How one estimated pose compares with the true ones. Errors are those to the matched instance or,
/// without one, to the nearest; NaN when there is no true pose at all.
struct PoseJudgement
{
  int instance = -1;      ///< index of the true instance it matches, or -1: a wrong pose
  int nearest = -1;       ///< index of the true instance whose middle is nearest
  bool duplicate = false; ///< a better pose has matched the same instance
  /// A true instance is here, if need be turned by one of the part's near-symmetries, and no better pose has it.
  bool isThere = false;
  double translationError; ///< mm
  double rotationError;    ///< degrees
  double axisError;        ///< degrees between the axes
  double rollError;        ///< degrees of the turn about the axis that is left
  PoseOutcome outcome = PoseOutcome::WrongPlace;
};

/// What became of a true instance. Errors are those of the pose that found it or, without one, of the pose that is
/// nearest to it; NaN when there is no pose.
struct InstanceJudgement
{
  int pose = -1;           ///< index of the first estimate that found it, or -1: missed
  int nearest = -1;        ///< index of the estimate whose middle is nearest
  bool counts = false;     ///< visible enough that it has to be found
  double translationError; ///< mm
  double rotationError;    ///< degrees
};

/// Confidences of poses, and whether each is the first for an instance that has to be found.
using Ranking = std::vector<std::pair<double, bool>>;

/// In %: the mean over the recalls 0, 0.01, ..., 1 of the best precision at that recall or more; NaN without instances.
double averagePrecision(Ranking ranking, int instances);

struct SceneEvaluation
{
  std::vector<PoseJudgement> judgements;    ///< of each estimate, in its order
  std::vector<InstanceJudgement> instances; ///< of each true pose, in its order
  int asked = 0;                            ///< poses that count for the rates below
  int visibleInstances = 0;                 ///< true instances that have to be found
  Ranking ranking;                          ///< without poses of instances that are too hidden to count
};

/// Compares the poses of a scene, best first, with the true ones (paper, Section 6.3). A true pose
/// whose visibleFraction is too small need not be found; where no true pose has one, all count.
/// Throws Error without a diameter, for settings out of range and for poses that are not finite.
SceneEvaluation evaluatePoses(const Poses& estimates, const Poses& truths, const PoseEvaluationSettings& settings);

/// Counts over scenes; the errors are those of the right poses.
struct EvaluationTotals
{
  int scenes = 0;
  int asked = 0;      ///< poses asked for, over all scenes
  int poses = 0;      ///< poses judged: what came out, no more than was asked for
  int right = 0;      ///< of those, duplicates included
  int distinct = 0;   ///< of those, each true instance once
  int firstRight = 0; ///< scenes whose first pose is right
  int visibleInstances = 0;
  std::vector<double> translationErrors;
  std::vector<double> rotationErrors;
  std::vector<double> axisErrors;
  std::vector<double> rollErrors;
  Ranking ranking;

  void add(const SceneEvaluation& scene);
};

/// Rates in %; a figure that nothing speaks for is NaN.
struct EvaluationFigures
{
  double paperRate;            ///< right poses / poses that came out
  double strictRate;           ///< distinct right poses / poses asked for: a missing pose is wrong
  double top1Rate;             ///< scenes whose first pose is right
  double recall;               ///< visible instances found by any pose, also beyond those asked for
  double averagePrecision;     ///< over all poses by score, interpolated at 101 recalls
  double recallAtPrecision99;  ///< visible instances found by the most likely poses, as long as 99 % of them are right
  double meanTranslationError; ///< mm, and the next
  double medianTranslationError;
  double meanRotationError; ///< degrees, and all that follow
  double medianRotationError;
  double medianAxisError;
  double medianRollError;
};

EvaluationFigures evaluationFigures(const EvaluationTotals& totals);
}
