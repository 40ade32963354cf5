// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/PatternSearch.h"

#include "base/sequences/Sequences.h"
#include "mesh/Symmetries.h"
#include "pose/Pose.h"
#include "pose/verification/ProbabilityCalibration.h"

#include <utility>

namespace meam
{
namespace
{
constexpr double LeastPast = 1.0;    // patches that the sensor saw past,
constexpr double LeastClose = 0.2;   // or that a surface hides which is close before them; fewer, and a pose stays
constexpr double Covered = 0.9;      // probability from which on what is close before a pose is another object
constexpr double WorthTrying = 1e-3; // probability; less, and a pose stays,
constexpr double Sure = 0.99;        // and so it does if it has more: least squares are more exact
constexpr double FirstStep = 0.02;  // of the diameter: a shift along an axis; a turn moves so much half a diameter away
constexpr double LastStep = 0.0025; // steps are halved down to this one
constexpr double Farthest = 0.1;    // of the diameter, from where the pose was,
constexpr double MostTurned = 15.0; // and degrees
constexpr int Rounds = 16;          // over all axes, at most
constexpr int PointStride = 2;      // of the predicted points one of so many is looked at on the way
constexpr double Penalty = 1.0;     // off the log odds of a moved pose: the best of so many has as much by chance
}

PatternSearch::PatternSearch(const EvidenceCollector& collector, const EvidenceRates& rates, const TrainedModel& model,
  const PatternSearchSettings& settings)
  : Collector(collector)
  , Rates(rates)
  , Model(model)
  , Settings(settings)
{
  const std::vector<ContinuousSymmetry> round = asIfRound(model.symmetries).continuous; // none, one or three
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (!round.empty())
  {
    axes = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), round.front().axis).toRotationMatrix();
  }
  auto motions = ofIndices<Motion>(3, [&](int k) { return Motion{ axes.col(k), false }; });
  for (int k = static_cast<int>(round.size()); k < 3; ++k)
  {
    motions.push_back({ axes.col(k), true });
  }
  this->Orders.push_back(motions);
  if (settings.bothOrders)
  {
    this->Orders.emplace_back(motions.rbegin(), motions.rend());
  }
}

PatternSearch::Result PatternSearch::at(const Eigen::Isometry3d& T_scene_model) const
{
  Result result{ T_scene_model, this->Collector.collect(T_scene_model), 0.0, false };
  result.logOdds = this->Collector.logOdds(result.evidence.counts, this->Rates);
  return result;
}

PatternSearch::Result PatternSearch::best(const Eigen::Isometry3d& T_scene_model) const
{
  Result best = this->at(T_scene_model);
  if (this->isContradicted(best))
  {
    for (const std::vector<Motion>& motions : this->Orders)
    {
      Result moved = this->at(this->maximum(T_scene_model, motions));
      moved.penalty = this->Settings.penalizes ? Penalty : 0.0;
      moved.logOdds -= moved.penalty;
      moved.isMoved = true;
      if (moved.logOdds > best.logOdds)
      {
        best = std::move(moved);
      }
    }
  }
  return best;
}

bool PatternSearch::isContradicted(const Result& pose) const
{
  const double probability = probabilityOf(pose.logOdds);
  if (probability < WorthTrying || probability >= Sure)
  {
    return false;
  }
  const EvidenceCounts& counts = pose.evidence.counts;
  return (this->Settings.ifPast && counts.past + counts.farPast >= LeastPast) ||
         (this->Settings.ifClose && (!this->Settings.leavesLikely || probability < Covered) &&
           this->Collector.closelyHidden(pose.T_scene_model) >= LeastClose);
}

Eigen::Isometry3d PatternSearch::moved(const Eigen::Isometry3d& T, const Motion& motion, double step) const
{
  const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
  return motion.isTurn ? T * turnAbout(motion.axis, step / (0.5 * this->Model.diameter), middle)
                       : T * Eigen::Translation3d(step * motion.axis);
}

bool PatternSearch::isNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
{
  const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
  return translationError(a, b, middle) <= Farthest * this->Model.diameter && rotationError(a, b) <= MostTurned;
}

Eigen::Isometry3d PatternSearch::maximum(
  const Eigen::Isometry3d& T_scene_model, const std::vector<Motion>& motions) const
{
  const auto logOdds = [&](const Eigen::Isometry3d& T) { return this->Collector.logOdds(T, this->Rates, PointStride); };
  Eigen::Isometry3d best = T_scene_model;
  double most = logOdds(best);
  const auto improves = [&](const Motion& motion, double step)
  {
    const Eigen::Isometry3d next = this->moved(best, motion, step);
    const double odds = this->isNear(next, T_scene_model) ? logOdds(next) : most;
    const bool isMore = odds > most;
    best = isMore ? next : best;
    most = isMore ? odds : most;
    return isMore;
  };
  double step = FirstStep * this->Model.diameter;
  const double lastStep = LastStep * this->Model.diameter;
  for (int round = 0; round < Rounds && step >= lastStep; ++round)
  {
    bool hasImproved = false;
    for (const Motion& motion : motions)
    {
      hasImproved |= improves(motion, step) || improves(motion, -step);
    }
    step *= hasImproved ? 1.0 : 0.5;
  }
  return best;
}
}
