// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/EvidenceAscent.h"

#include "mesh/Symmetries.h"

namespace meam
{
namespace
{
/// Of the part, in mm along an axis (0 to 2) or about it (3 to 5): a turn counts as what it moves `radius` away.
Eigen::Isometry3d motionAlong(int coordinate, double step, const Eigen::Vector3d& middle, double radius)
{
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(coordinate % 3);
  return coordinate < 3 ? Eigen::Isometry3d(Eigen::Translation3d(step * axis)) : turnAbout(axis, step / radius, middle);
}
}

EvidenceAscent::EvidenceAscent(const EvidenceCollector& collector, const EvidenceRates& rates,
  const TrainedModel& model, const EvidenceAscentSettings& settings)
  : Collector(collector)
  , Rates(rates)
  , Model(model)
  , Settings(settings)
{
}

EvidenceAscent::Place EvidenceAscent::at(const Eigen::Isometry3d& T_scene_model) const
{
  Place place{ T_scene_model, this->Collector.collect(T_scene_model), 0.0, false };
  place.logOdds = this->Collector.logOdds(place.evidence.counts, this->Rates);
  return place;
}

EvidenceAscent::Place EvidenceAscent::best(const Pose& pose) const
{
  Place asItIs = this->at(pose.T_scene_model);
  const EvidenceCounts& counts = asItIs.evidence.counts;
  if (pose.probability < this->Settings.worthTrying || counts.past + counts.farPast < this->Settings.leastPast)
  {
    return asItIs;
  }
  Place moved = this->at(this->search(pose.T_scene_model));
  moved.logOdds -= this->Settings.price;
  moved.isMoved = true;
  return moved.logOdds > asItIs.logOdds ? moved : asItIs;
}

Eigen::Isometry3d EvidenceAscent::search(const Eigen::Isometry3d& T_scene_model) const
{
  const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
  const double diameter = this->Model.diameter;
  const auto logOdds = [&](const Eigen::Isometry3d& T)
  { return this->Collector.logOdds(this->Collector.collect(T, this->Settings.pointStride).counts, this->Rates); };
  Eigen::Isometry3d best = T_scene_model;
  double most = logOdds(best);
  const auto climbs = [&](int coordinate, double step)
  {
    const Eigen::Isometry3d moved = best * motionAlong(coordinate, step, middle, 0.5 * diameter);
    const double odds = logOdds(moved);
    const bool isHigher = odds > most;
    best = isHigher ? moved : best;
    most = isHigher ? odds : most;
    return isHigher;
  };
  double step = this->Settings.firstStep * diameter;
  for (int round = 0; round < this->Settings.rounds && step >= this->Settings.lastStep * diameter; ++round)
  {
    bool hasClimbed = false;
    for (int coordinate = 0; coordinate < 6; ++coordinate)
    {
      hasClimbed |= climbs(coordinate, step) || climbs(coordinate, -step);
    }
    step *= hasClimbed ? 1.0 : 0.5;
  }
  return best;
}
}
