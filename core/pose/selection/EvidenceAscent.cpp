// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/EvidenceAscent.h"

#include "base/Error.h"
#include "mesh/Symmetries.h"
#include "pose/Pose.h"

#include <utility>

namespace meam
{
EvidenceAscent::EvidenceAscent(const EvidenceCollector& collector, const EvidenceRates& rates,
  const TrainedModel& model, const EvidenceAscentSettings& settings)
  : Collector(collector)
  , Rates(rates)
  , Model(model)
  , Settings(settings)
{
  if (settings.pointStride < 1)
  {
    throw Error("The stride of the points that an ascent looks at must be 1 or more.");
  }
  const std::vector<ContinuousSymmetry> round = asIfRound(model.symmetries).continuous; // none, one or three
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (!round.empty())
  {
    axes = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), round.front().axis).toRotationMatrix();
  }
  std::vector<Motion> motions;
  for (int k = 0; k < 3; ++k)
  {
    motions.push_back({ axes.col(k), false });
  }
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

EvidenceAscent::Result EvidenceAscent::at(const Eigen::Isometry3d& T_scene_model) const
{
  Result result{ T_scene_model, this->Collector.collect(T_scene_model), 0.0, 0.0, false };
  result.logOdds = result.logOddsBefore = this->Collector.logOdds(result.evidence.counts, this->Rates);
  return result;
}

EvidenceAscent::Result EvidenceAscent::best(const Eigen::Isometry3d& T_scene_model) const
{
  Result best = this->at(T_scene_model);
  if (this->isContradicted(best))
  {
    for (const std::vector<Motion>& motions : this->Orders)
    {
      Result moved = this->at(this->climb(T_scene_model, motions));
      moved.logOdds -= this->Settings.price;
      moved.logOddsBefore = best.logOddsBefore;
      moved.isMoved = true;
      if (moved.logOdds > best.logOdds)
      {
        best = std::move(moved);
      }
    }
  }
  return best;
}

bool EvidenceAscent::isContradicted(const Result& pose) const
{
  const double probability = probabilityOf(pose.logOdds);
  if (probability < this->Settings.worthTrying || probability >= this->Settings.sure)
  {
    return false;
  }
  const EvidenceCounts& counts = pose.evidence.counts;
  return (this->Settings.ifPast && counts.past + counts.farPast >= this->Settings.leastPast) ||
         (this->Settings.ifClose && probability < this->Settings.covered &&
           this->Collector.closelyHidden(pose.T_scene_model) >= this->Settings.leastClose);
}

Eigen::Isometry3d EvidenceAscent::moved(const Eigen::Isometry3d& T, const Motion& motion, double step) const
{
  const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
  return motion.isTurn ? T * turnAbout(motion.axis, step / (0.5 * this->Model.diameter), middle)
                       : T * Eigen::Translation3d(step * motion.axis);
}

bool EvidenceAscent::isNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
{
  const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
  return translationError(a, b, middle) <= this->Settings.farthest * this->Model.diameter &&
         rotationError(a, b) <= this->Settings.mostTurned;
}

Eigen::Isometry3d EvidenceAscent::climb(
  const Eigen::Isometry3d& T_scene_model, const std::vector<Motion>& motions) const
{
  const auto logOdds = [&](const Eigen::Isometry3d& T)
  { return this->Collector.logOdds(T, this->Rates, this->Settings.pointStride); };
  Eigen::Isometry3d best = T_scene_model;
  double most = logOdds(best);
  const auto climbs = [&](const Motion& motion, double step)
  {
    const Eigen::Isometry3d next = this->moved(best, motion, step);
    const double odds = this->isNear(next, T_scene_model) ? logOdds(next) : most;
    const bool isHigher = odds > most;
    best = isHigher ? next : best;
    most = isHigher ? odds : most;
    return isHigher;
  };
  double step = this->Settings.firstStep * this->Model.diameter;
  const double lastStep = this->Settings.lastStep * this->Model.diameter;
  for (int round = 0; round < this->Settings.rounds && step >= lastStep; ++round)
  {
    bool hasClimbed = false;
    for (const Motion& motion : motions)
    {
      hasClimbed |= climbs(motion, step) || climbs(motion, -step);
    }
    step *= hasClimbed ? 1.0 : 0.5;
  }
  return best;
}
}
