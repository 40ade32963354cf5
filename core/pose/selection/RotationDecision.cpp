// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/RotationDecision.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
/// Share of the part's surface that a turn takes to its surface.
double overlapAfter(const Eigen::Isometry3d& turn, const SoAPoints& surface, const DistanceField& distance, double near)
{
  std::vector<float> distances(surface.size());
  distance.at(turn.cast<float>(), surface, 0, static_cast<int>(surface.size()), distances.data());
  const auto fitting = std::count_if(
    distances.begin(), distances.end(), [&](float distance) { return distance < static_cast<float>(near); });
  return static_cast<double>(fitting) / static_cast<double>(surface.size());
}
}

RotationDecision::RotationDecision(const Scene& scene, const TrainedModel& model, const PoseComparison& comparison,
  const EvidenceCollector& collector, const EvidenceRates& rates, const PoseRefinementSettings& rotated,
  const RotationDecisionSettings& settings)
  : InScene(scene)
  , Model(model)
  , Comparison(comparison)
  , Collector(collector)
  , Rates(rates)
  , Rotated(rotated)
  , Settings(settings)
{
  for (const NearSymmetry& symmetry : model.symmetries.near)
  {
    this->Turns.push_back(symmetry.T);
  }
  const double tolerance = FitLengths{}.explained * model.diameter;
  const double step = settings.step * M_PI / 180.0;
  const int steps = static_cast<int>(std::lround(2.0 * M_PI / step));
  const std::vector<ContinuousSymmetry> axes = nearlyRoundAxes(model.symmetries);
  SoAPoints surface;
  surface.resize(axes.empty() ? 0 : model.surface.size());
  for (std::size_t k = 0; k < surface.size(); ++k)
  {
    surface.set(k, model.surface.points[k]);
  }
  for (const ContinuousSymmetry& axis : axes)
  {
    for (int k = 1; k < steps && surface.size() > 0; ++k)
    {
      const Eigen::Isometry3d turn = turnAbout(axis.axis, k * step, axis.point);
      const auto isSame = [&](const NearSymmetry& near)
      {
        const Eigen::Matrix3d between = near.T.linear().transpose() * turn.linear();
        return Eigen::AngleAxisd(between).angle() < 0.5 * step;
      };
      const auto& near = model.symmetries.near;
      if (std::none_of(near.begin(), near.end(), isSame) &&
          overlapAfter(turn, surface, model.surfaceDistance, tolerance) >= settings.overlap)
      {
        this->Turns.push_back(turn);
      }
    }
  }
}

void RotationDecision::decide(Pose& pose, PoseComparison::Contender asItIs) const
{
  const double sure = this->Settings.sureAdvantage;
  const double hopeless = -this->Settings.negligible * sure;
  const std::size_t nearSymmetries = this->Model.symmetries.near.size();
  const bool isLikely = pose.probability >= this->Settings.worthAsking;
  const std::size_t turns = isLikely ? this->Turns.size() : nearSymmetries;
  for (int round = 0; round < this->Settings.rounds; ++round)
  {
    std::vector<double> advantages{ 0.0 };
    const double asItIsOdds = isLikely ? this->Collector.logOdds(pose.T_scene_model, this->Rates) : 0.0;
    for (std::size_t k = 0; k < turns; ++k)
    {
      const Eigen::Isometry3d turned = pose.T_scene_model * this->Turns[k];
      double advantage = this->Comparison.advantage(turned, asItIs, hopeless);
      if (isLikely && advantage > hopeless)
      {
        advantage += sure * (this->Collector.logOdds(turned, this->Rates) - asItIsOdds);
      }
      advantages.push_back(advantage);
    }
    const auto best = std::max_element(advantages.begin(), advantages.end());
    double odds = 0.0; // of all turns against the best
    for (const double advantage : advantages)
    {
      odds += std::exp((advantage - *best) / sure);
    }
    pose.certainty = 1.0 / odds;
    if (best == advantages.begin())
    {
      return;
    }
    const std::size_t turn = best - advantages.begin() - 1;
    Pose turned = pose;
    turned.T_scene_model = pose.T_scene_model * this->Turns[turn];
    if (turn >= nearSymmetries)
    {
      turned = refinePoses({ turned }, this->InScene, this->Model, this->Rotated)[0];
      turned.certainty = pose.certainty;
    }
    asItIs = this->Comparison.contender(turned.T_scene_model);
    pose = turned;
  }
}
}
