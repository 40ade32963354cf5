// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/EvidenceAscent.h"

#include "base/Error.h"
#include "mesh/Symmetries.h"
#include "pose/Pose.h"

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
  for (int k = 0; k < 3; ++k)
  {
    this->Motions.push_back({ axes.col(k), false });
  }
  for (int k = static_cast<int>(round.size()); k < 3; ++k)
  {
    this->Motions.push_back({ axes.col(k), true });
  }
}

EvidenceAscent::Result EvidenceAscent::at(const Eigen::Isometry3d& T_scene_model) const
{
  Result result{ T_scene_model, this->Collector.collect(T_scene_model), 0.0, false };
  result.logOdds = this->Collector.logOdds(result.evidence.counts, this->Rates);
  return result;
}

EvidenceAscent::Result EvidenceAscent::best(const Eigen::Isometry3d& T_scene_model) const
{
  Result asItIs = this->at(T_scene_model);
  const EvidenceCounts& counts = asItIs.evidence.counts;
  if (probabilityOf(asItIs.logOdds) >= this->Settings.worthTrying &&
      counts.past + counts.farPast >= this->Settings.leastPast)
  {
    Result moved = this->at(this->search(T_scene_model));
    moved.logOdds -= this->Settings.price;
    moved.isMoved = true;
    if (moved.logOdds > asItIs.logOdds)
    {
      return moved;
    }
  }
  return asItIs;
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

Eigen::Isometry3d EvidenceAscent::search(const Eigen::Isometry3d& T_scene_model) const
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
    for (const Motion& motion : this->Motions)
    {
      hasClimbed |= climbs(motion, step) || climbs(motion, -step);
    }
    step *= hasClimbed ? 1.0 : 0.5;
  }
  return best;
}
}
