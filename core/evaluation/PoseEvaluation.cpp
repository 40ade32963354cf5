// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/PoseEvaluation.h"

#include "base/Range.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace meam
{
namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

void check(const Poses& poses, const std::string& what)
{
  for (const Pose& pose : poses)
  {
    if (!pose.T_scene_model.matrix().allFinite())
    {
      throw Error(what + " have a value that is not a number.");
    }
  }
}

void check(const PoseEvaluationSettings& settings)
{
  if (!(settings.diameter > 0.0) || !std::isfinite(settings.diameter))
  {
    throw Error("Poses can only be judged against the size of the part: give its diameter in mm.");
  }
  requireWithin("translation tolerance", settings.translationTolerance, 0.0, Unbounded, " %");
  requireWithin("rotation tolerance", settings.rotationTolerance, 0.0, Unbounded, " degrees");
  requireWithin("number of poses asked for", settings.posesAskedFor, 0, Unbounded);
  requirePositive("length of the axis", settings.axis.norm());
  requireWithin("size of the middle's coordinates", settings.middle.norm(), 0.0, Unbounded, " mm");
}

/// The turn from one pose to the other as a swing of the axis and a roll about it, degrees.
void splitRotation(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth, const Eigen::Vector3d& axis,
  PoseJudgement& judgement)
{
  const Eigen::Quaterniond turn(Eigen::Matrix3d(truth.linear().transpose() * estimate.linear()));
  const double along = turn.vec().dot(axis);
  // What is left of the quaternion across the axis is the sine of half the swing.
  const double swing = (turn.vec() - along * axis).norm();
  const double twist = std::hypot(turn.w(), along);
  judgement.axisError = 2.0 * std::atan2(swing, twist) * 180.0 / M_PI;
  judgement.rollError = 2.0 * std::atan2(std::abs(along), std::abs(turn.w())) * 180.0 / M_PI;
}

/// The symmetries with the near ones as if they were exact.
Symmetries withNear(const Symmetries& symmetries)
{
  Symmetries all = asIfRound(symmetries);
  std::transform(symmetries.near.begin(), symmetries.near.end(), std::back_inserter(all.discrete),
    [](const NearSymmetry& near) { return near.T; });
  return all;
}

/// The true instance that a pose is of, whichever way near-symmetries turn it; -1: none.
int copyAt(const Pose& estimate, const Poses& truths, const PoseEvaluationSettings& settings, const Symmetries& all)
{
  const double reach = settings.translationTolerance / 100.0 * settings.diameter;
  for (std::size_t i = 0; i < truths.size(); ++i)
  {
    const Eigen::Isometry3d equal = nearestEqual(estimate.T_scene_model, truths[i].T_scene_model, all);
    if (translationError(equal, truths[i].T_scene_model, settings.middle) < reach &&
        rotationError(equal, truths[i].T_scene_model) < settings.rotationTolerance)
    {
      return static_cast<int>(i);
    }
  }
  return -1;
}

PoseJudgement judge(const Pose& estimate, const Poses& truths, const PoseEvaluationSettings& settings)
{
  PoseJudgement judgement;
  const double reach = settings.translationTolerance / 100.0 * settings.diameter;
  double nearest = std::numeric_limits<double>::infinity();
  double leastTurn = settings.rotationTolerance;
  for (std::size_t i = 0; i < truths.size(); ++i)
  {
    const Eigen::Isometry3d equal = nearestEqual(estimate.T_scene_model, truths[i].T_scene_model, settings.symmetries);
    const double distance = translationError(equal, truths[i].T_scene_model, settings.middle);
    if (distance < nearest)
    {
      nearest = distance;
      judgement.nearest = static_cast<int>(i);
    }
    if (distance < reach)
    {
      const double turn = rotationError(equal, truths[i].T_scene_model);
      if (turn < leastTurn)
      {
        leastTurn = turn;
        judgement.instance = static_cast<int>(i);
      }
    }
  }
  judgement.outcome = judgement.instance >= 0 ? PoseOutcome::Hit
                      : nearest < reach       ? PoseOutcome::WrongTurn
                                              : PoseOutcome::WrongPlace;
  const int to = judgement.instance >= 0 ? judgement.instance : judgement.nearest;
  if (to < 0)
  {
    judgement.translationError = judgement.rotationError = NaN;
    judgement.axisError = judgement.rollError = NaN;
    return judgement;
  }
  const Eigen::Isometry3d& truth = truths[to].T_scene_model;
  const Eigen::Isometry3d equal = nearestEqual(estimate.T_scene_model, truth, settings.symmetries);
  judgement.translationError = translationError(equal, truth, settings.middle);
  judgement.rotationError = rotationError(equal, truth);
  splitRotation(equal, truth, settings.axis.normalized(), judgement);
  return judgement;
}

InstanceJudgement judgeInstance(
  const Pose& truth, const Poses& estimates, int pose, const PoseEvaluationSettings& settings)
{
  InstanceJudgement judgement;
  judgement.pose = pose;
  judgement.translationError = judgement.rotationError = NaN;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < estimates.size(); ++i)
  {
    const double distance =
      translationError(nearestEqual(estimates[i].T_scene_model, truth.T_scene_model, settings.symmetries),
        truth.T_scene_model, settings.middle);
    if (distance < nearest)
    {
      nearest = distance;
      judgement.nearest = static_cast<int>(i);
    }
  }
  const int of = pose >= 0 ? pose : judgement.nearest;
  if (of >= 0)
  {
    const Eigen::Isometry3d equal = nearestEqual(estimates[of].T_scene_model, truth.T_scene_model, settings.symmetries);
    judgement.translationError = translationError(equal, truth.T_scene_model, settings.middle);
    judgement.rotationError = rotationError(equal, truth.T_scene_model);
  }
  return judgement;
}

double percent(double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : NaN; }

double mean(const std::vector<double>& values)
{
  return values.empty() ? NaN : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values)
{
  if (values.empty())
  {
    return NaN;
  }
  const std::size_t half = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// In %: instances found by the most likely poses, as many of these as may be with 99 of 100 right.
double recallAtPrecision99(Ranking ranking, int instances)
{
  std::stable_sort(ranking.begin(), ranking.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  int right = 0, most = 0;
  for (std::size_t i = 0; i < ranking.size(); ++i)
  {
    right += ranking[i].second ? 1 : 0;
    most = 100 * right >= 99 * static_cast<int>(i + 1) ? right : most;
  }
  return percent(most, instances);
}
}

double averagePrecision(Ranking ranking, int instances)
{
  if (instances == 0)
  {
    return NaN;
  }
  std::stable_sort(ranking.begin(), ranking.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  // Precision when the k-th instance was found, then the best from there on.
  std::vector<double> precisions;
  for (std::size_t i = 0; i < ranking.size(); ++i)
  {
    if (ranking[i].second)
    {
      precisions.push_back(static_cast<double>(precisions.size() + 1) / static_cast<double>(i + 1));
    }
  }
  for (std::size_t i = precisions.size(); i > 1; --i)
  {
    precisions[i - 2] = std::max(precisions[i - 2], precisions[i - 1]);
  }
  double sum = 0.0;
  for (int step = 0; step <= 100; ++step)
  {
    // The number of found instances that makes this recall; at least one.
    const std::size_t found = std::max((step * instances + 99) / 100, 1);
    sum += found <= precisions.size() ? precisions[found - 1] : 0.0;
  }
  return 100.0 * sum / 101.0;
}

SceneEvaluation evaluatePoses(const Poses& estimates, const Poses& truths, const PoseEvaluationSettings& settings)
{
  check(settings);
  check(estimates, "The estimated poses");
  check(truths, "The true poses");

  const bool visibilityKnown =
    std::any_of(truths.begin(), truths.end(), [](const Pose& truth) { return truth.visibleFraction > 0.0; });
  const auto counts = [&](int instance)
  { return !visibilityKnown || truths[instance].visibleFraction >= settings.minimumVisibleFraction; };

  SceneEvaluation evaluation;
  evaluation.asked = settings.posesAskedFor > 0 ? settings.posesAskedFor : static_cast<int>(estimates.size());
  for (int i = 0; i < static_cast<int>(truths.size()); ++i)
  {
    evaluation.visibleInstances += counts(i) ? 1 : 0;
  }
  std::vector<int> found(truths.size(), -1); // by which estimate
  std::vector<char> isClaimed(truths.size(), 0);
  const Symmetries all = withNear(settings.symmetries);
  for (const Pose& estimate : estimates)
  {
    PoseJudgement judgement = judge(estimate, truths, settings);
    const int instance = judgement.instance;
    if (instance >= 0)
    {
      judgement.duplicate = found[instance] >= 0;
      judgement.outcome = judgement.duplicate ? PoseOutcome::Duplicate : PoseOutcome::Hit;
      found[instance] = judgement.duplicate ? found[instance] : static_cast<int>(evaluation.judgements.size());
    }
    const int copy = instance >= 0 ? instance : copyAt(estimate, truths, settings, all);
    judgement.isThere = copy >= 0 && !isClaimed[copy];
    if (copy >= 0)
    {
      isClaimed[copy] = 1;
    }
    if (instance < 0 || counts(instance))
    {
      evaluation.ranking.emplace_back(probabilityOrScore(estimate), instance >= 0 && !judgement.duplicate);
    }
    evaluation.judgements.push_back(judgement);
  }
  for (int i = 0; i < static_cast<int>(truths.size()); ++i)
  {
    evaluation.instances.push_back(judgeInstance(truths[i], estimates, found[i], settings));
    evaluation.instances.back().counts = counts(i);
  }
  return evaluation;
}

void EvaluationTotals::add(const SceneEvaluation& scene)
{
  ++this->scenes;
  this->asked += scene.asked;
  this->visibleInstances += scene.visibleInstances;
  this->ranking.insert(this->ranking.end(), scene.ranking.begin(), scene.ranking.end());
  const int judged = std::min(scene.asked, static_cast<int>(scene.judgements.size()));
  this->poses += judged;
  for (int i = 0; i < judged; ++i)
  {
    const PoseJudgement& judgement = scene.judgements[i];
    if (judgement.instance < 0)
    {
      continue;
    }
    ++this->right;
    this->distinct += judgement.duplicate ? 0 : 1;
    this->firstRight += i == 0 ? 1 : 0;
    this->translationErrors.push_back(judgement.translationError);
    this->rotationErrors.push_back(judgement.rotationError);
    this->axisErrors.push_back(judgement.axisError);
    this->rollErrors.push_back(judgement.rollError);
  }
}

EvaluationFigures evaluationFigures(const EvaluationTotals& totals)
{
  const auto found =
    std::count_if(totals.ranking.begin(), totals.ranking.end(), [](const auto& entry) { return entry.second; });
  EvaluationFigures figures;
  figures.paperRate = percent(totals.right, totals.poses);
  figures.strictRate = percent(totals.distinct, totals.asked);
  figures.top1Rate = percent(totals.firstRight, totals.scenes);
  figures.recall = percent(static_cast<double>(found), totals.visibleInstances);
  figures.averagePrecision = averagePrecision(totals.ranking, totals.visibleInstances);
  figures.recallAtPrecision99 = recallAtPrecision99(totals.ranking, totals.visibleInstances);
  figures.meanTranslationError = mean(totals.translationErrors);
  figures.medianTranslationError = median(totals.translationErrors);
  figures.meanRotationError = mean(totals.rotationErrors);
  figures.medianRotationError = median(totals.rotationErrors);
  figures.medianAxisError = median(totals.axisErrors);
  figures.medianRollError = median(totals.rollErrors);
  return figures;
}
}
