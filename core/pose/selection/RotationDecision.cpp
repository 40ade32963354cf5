// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/RotationDecision.h"

#include "pose/PoseTolerances.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double Step = 10.0 * M_PI / 180.0; // between the turns of a nearly round part that are asked about
constexpr double LeastOverlap = 0.8; // of its surface, that comes to lie on the surface when it is nearly round at one
constexpr double SureAdvantage = 13.0; // points that make a rotation e times likelier than another in simulated bins
constexpr double Hopeless = -6.0 * SureAdvantage; // a rotation so unlikely is one in four hundred
constexpr double WorthAsking = 0.02; // probability of a pose before: less, and only its near-symmetries are compared
constexpr int Rounds = 3;            // of turns that the scene speaks for more
constexpr double LeastShare = 0.01;  // of a rotation that is told of

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
  const EvidenceCollector& collector, const EvidenceRates& rates, const PoseRefinementSettings& rotated)
  : InScene(scene)
  , Model(model)
  , Comparison(comparison)
  , Collector(collector)
  , Rates(rates)
  , Rotated(rotated)
{
  for (const NearSymmetry& symmetry : model.symmetries.near)
  {
    this->Turns.push_back(symmetry.T);
  }
  const double tolerance = ExplainedDistance * model.diameter;
  const int steps = static_cast<int>(std::lround(2.0 * M_PI / Step));
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
      const Eigen::Isometry3d turn = turnAbout(axis.axis, k * Step, axis.point);
      const auto isSame = [&](const NearSymmetry& near)
      {
        const Eigen::Matrix3d between = near.T.linear().transpose() * turn.linear();
        return Eigen::AngleAxisd(between).angle() < 0.5 * Step;
      };
      const auto& near = model.symmetries.near;
      if (std::none_of(near.begin(), near.end(), isSame) &&
          overlapAfter(turn, surface, model.surfaceDistance, tolerance) >= LeastOverlap)
      {
        this->Turns.push_back(turn);
      }
    }
  }
}

void RotationDecision::decide(Pose& pose, PoseComparison::Contender asItIs) const
{
  const std::size_t nearSymmetries = this->Model.symmetries.near.size();
  const bool isLikely = claimOf(pose, false) >= WorthAsking;
  const std::size_t turns = isLikely ? this->Turns.size() : nearSymmetries;
  for (int round = 0; round < Rounds; ++round)
  {
    std::vector<double> advantages{ 0.0 };
    const double asItIsOdds = isLikely ? this->Collector.logOdds(pose.T_scene_model, this->Rates) : 0.0;
    for (std::size_t k = 0; k < turns; ++k)
    {
      const Eigen::Isometry3d turned = pose.T_scene_model * this->Turns[k];
      double advantage = this->Comparison.advantage(turned, asItIs, Hopeless);
      if (isLikely && advantage > Hopeless)
      {
        advantage += SureAdvantage * (this->Collector.logOdds(turned, this->Rates) - asItIsOdds);
      }
      advantages.push_back(advantage);
    }
    const auto best = std::max_element(advantages.begin(), advantages.end());
    double odds = 0.0; // of all turns against the best
    for (const double advantage : advantages)
    {
      odds += std::exp((advantage - *best) / SureAdvantage);
    }
    pose.certainty = 1.0 / odds;
    pose.alternatives.clear();
    for (std::size_t k = 0; k < advantages.size(); ++k)
    {
      const double share = std::exp((advantages[k] - *best) / SureAdvantage) / odds;
      if (share >= LeastShare && advantages.begin() + k != best)
      {
        pose.alternatives.push_back({ k == 0 ? pose.T_scene_model : pose.T_scene_model * this->Turns[k - 1], share });
      }
    }
    std::stable_sort(pose.alternatives.begin(), pose.alternatives.end(),
      [](const RotationAlternative& a, const RotationAlternative& b) { return a.share > b.share; });
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
      turned.alternatives = pose.alternatives;
    }
    asItIs = this->Comparison.contender(turned.T_scene_model);
    pose = turned;
  }
}
}
