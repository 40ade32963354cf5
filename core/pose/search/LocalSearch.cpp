// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/LocalSearch.h"

#include "model/SideSymmetries.h"
#include "pose/PoseTolerances.h"
#include "pose/refinement/FinalAlignment.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr int Iterations = 6;         // of refinement: what stays is aligned afterwards
constexpr double SmallTurn = 10.0;    // degrees,
constexpr double SmallerTurn = 6.0;   // and of likely poses: those of them that are wrong lie 5 to 8 off
constexpr double WorthTrying = 1e-3;  // probability of a pose before: less, and it is not refined again;
constexpr double Likely = 0.9;        // more, and it is from smaller turns;
constexpr double Sure = 0.999;        // more, and it is from half turns alone
constexpr double StepOfRound = 10.0;  // degrees, between the rotations of a nearly round part
constexpr double LeastOverlap = 0.8;  // of its surface, that comes to lie on the surface when it is nearly round at one
constexpr double TurnDistance = 0.04; // of the diameter: correspondences of another rotation, which is nearly right
constexpr double SureAdvantage = 13.0; // points that make a rotation e times likelier than another in simulated bins
constexpr double Hopeless = -6.0 * SureAdvantage; // a rotation so unlikely is one in four hundred
constexpr double WorthAsking = 0.02; // probability of a pose before: less, and only its near-symmetries are compared
constexpr double MuchEvidence = 1.5; // log odds between rotations, more of which grows by its logarithm: outline where
                                     // the part stands on something is of one line, and counts for all of it
constexpr float FromThatSide = 0.5f; // cosine between the line of sight and the one from where a side looks the same
constexpr int Rounds = 3;            // of rotations that the scene speaks for more
constexpr double LeastShare = 0.01;  // of a rotation that is told of

PoseRefinementSettings restartSettings()
{
  PoseRefinementSettings settings;
  settings.iterations = Iterations;
  settings.fullLastStep = false; // some points tell which start is best; the final alignment takes all
  settings.threads = 1;          // poses are worked on in parallel
  return settings;
}

PoseRefinementSettings settingsAfterTurn(const TrainedModel& model)
{
  PoseRefinementSettings settings;
  settings.iterations = Iterations;
  settings.maximumDistance = TurnDistance * model.diameter;
  settings.threads = 1; // the same
  return settings;
}

bool hasLess(const RotationAlternative& a, const RotationAlternative& b) { return a.share < b.share; }

/// As columns.
Eigen::Matrix3d principalAxes(const Points& points, const Eigen::Vector3d& middle)
{
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& point : points)
  {
    const Eigen::Vector3d d = point.cast<double>() - middle;
    scatter += d * d.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors();
}

/// Share of the part's surface that a turn takes to its surface.
double overlapAfter(const Eigen::Isometry3d& turn, const SoAPoints& surface, const DistanceField& distance, double near)
{
  std::vector<float> distances(surface.size());
  distance.at(turn.cast<float>(), surface, 0, static_cast<int>(surface.size()), distances.data());
  const auto fitting = std::count_if(
    distances.begin(), distances.end(), [&](float distance) { return distance < static_cast<float>(near); });
  return static_cast<double>(fitting) / static_cast<double>(surface.size());
}

/// Rotations of a nearly round part by a step about its axis that are none of its near-symmetries.
std::vector<Eigen::Isometry3d> stepsAboutAxes(const TrainedModel& model)
{
  constexpr double step = StepOfRound * M_PI / 180.0;
  const std::vector<ContinuousSymmetry> axes = nearlyRoundAxes(model.symmetries);
  SoAPoints surface;
  for (std::size_t k = 0; k < (axes.empty() ? 0 : model.surface.size()); ++k)
  {
    surface.add(model.surface.points[k]);
  }
  std::vector<Eigen::Isometry3d> steps;
  for (const ContinuousSymmetry& axis : axes)
  {
    for (int k = 1; k < std::lround(2.0 * M_PI / step) && surface.size() > 0; ++k)
    {
      const Eigen::Isometry3d turn = turnAbout(axis.axis, k * step, axis.point);
      const auto isSame = [&](const NearSymmetry& near)
      {
        const Eigen::Matrix3d between = near.T.linear().transpose() * turn.linear();
        return Eigen::AngleAxisd(between).angle() < 0.5 * step;
      };
      const auto& near = model.symmetries.near;
      if (std::none_of(near.begin(), near.end(), isSame) &&
          overlapAfter(turn, surface, model.surfaceDistance, ExplainedDistance * model.diameter) >= LeastOverlap)
      {
        steps.push_back(turn);
      }
    }
  }
  return steps;
}
}

LocalSearch::LocalSearch(const Scene& scene, const TrainedModel& model, const PoseComparison& comparison,
  const EvidenceCollector& collector, const EvidenceRates& rates, const LocalSearchSettings& settings)
  : InScene(scene)
  , Model(model)
  , Comparison(comparison)
  , Collector(collector)
  , Rates(rates)
  , Settings(settings)
  , Search(scene, model)
  , AfterTurn(settingsAfterTurn(model))
  , Pattern(collector, rates, model, settings.pattern)
{
  if (settings.nearSymmetries && !model.symmetries.near.empty())
  {
    for (const NearSymmetry& symmetry : model.symmetries.near)
    {
      this->Rotations.push_back(symmetry.T);
    }
    this->NearSymmetries = this->Rotations.size();
    const std::vector<Eigen::Isometry3d> steps = stepsAboutAxes(model);
    this->Rotations.insert(this->Rotations.end(), steps.begin(), steps.end());
  }
  if (settings.nearSymmetries && settings.depthFit && DepthFit::tells(scene, model))
  {
    this->Depth.emplace(scene, model);
  }
  if (model.surface.empty())
  {
    return;
  }
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  const Eigen::Matrix3d axes = principalAxes(model.surface.points, middle);
  const Symmetries same = asIfRound(model.symmetries);
  std::vector<Eigen::Isometry3d> known{ Eigen::Isometry3d::Identity() };
  const auto add = [&](int axis, double degrees, std::vector<Eigen::Isometry3d>& starts)
  {
    const Eigen::Isometry3d turn = turnAbout(axes.col(axis), degrees * M_PI / 180.0, middle);
    const auto isKnown = [&](const Eigen::Isometry3d& other)
    { return rotationError(nearestEqual(turn, other, same), other) < 0.5 * std::min(std::abs(degrees), SmallTurn); };
    if (std::none_of(known.begin(), known.end(), isKnown))
    {
      known.push_back(turn);
      starts.push_back(turn);
    }
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    if (settings.halfTurns)
    {
      add(axis, 180.0, this->HalfTurns);
    }
    if (settings.smallTurns)
    {
      add(axis, -SmallTurn, this->SmallTurns);
      add(axis, SmallTurn, this->SmallTurns);
      add(axis, -SmallerTurn, this->SmallerTurns);
      add(axis, SmallerTurn, this->SmallerTurns);
    }
  }
}

LocalSearch::Result LocalSearch::best(Pose pose) const
{
  Contender current = this->Comparison.contender(pose.T_scene_model);
  this->restart(pose, current);
  if (this->Settings.aboutAxis)
  {
    this->turnAboutAxis(pose, current);
  }
  if (this->Settings.nearSymmetries)
  {
    this->decide(pose, current);
  }
  const Eigen::Isometry3d T_decided = pose.T_scene_model;
  if (this->Settings.aligns)
  {
    pose = alignRobustly(pose, this->InScene, this->Model);
  }
  else
  {
    pose.fit = fitInPlace(pose, pose.T_scene_model, this->InScene, this->Model);
  }
  const Eigen::Isometry3d T_aligned = pose.T_scene_model;
  const PatternSearch::Result moved =
    this->Settings.maximizes ? this->Pattern.best(T_aligned) : this->Pattern.at(T_aligned);
  pose.T_scene_model = moved.T_scene_model;
  pose.penalty = moved.penalty;
  if (moved.isMoved)
  {
    pose.fit = fitInPlace(pose, T_aligned, this->InScene, this->Model);
  }
  for (RotationAlternative& other : pose.alternatives) // turned as before against where the pose is now
  {
    other.T_scene_model = pose.T_scene_model * T_decided.inverse() * other.T_scene_model;
  }
  return { pose, moved.evidence, this->Collector.placeOdds(moved.evidence.counts, this->Rates, moved.logOdds).sum() };
}

double LocalSearch::placeLogOdds(const Eigen::Isometry3d& T_scene_model) const
{
  const EvidenceCounts counts = this->Collector.collect(T_scene_model).counts;
  return this->Collector.placeOdds(counts, this->Rates, this->Collector.logOdds(counts, this->Rates)).sum();
}

void LocalSearch::restart(Pose& pose, Contender& current) const
{
  const double probability = claimOf(pose, false);
  if (probability < WorthTrying)
  {
    return;
  }
  const Pose start = pose;
  const auto tryFrom = [&](const Eigen::Isometry3d& T_scene_model)
  {
    Pose other = start;
    other.T_scene_model = T_scene_model;
    other = refinePoses({ other }, this->InScene, this->Model, restartSettings())[0];
    if (this->Comparison.advantage(other.T_scene_model, current, 0.0) > 0.0)
    {
      pose = other;
      current = this->Comparison.contender(pose.T_scene_model);
    }
  };
  const double hopeless = -current.explained.byDistance;
  for (const Eigen::Isometry3d& turn : this->HalfTurns)
  {
    const Eigen::Isometry3d turned = start.T_scene_model * turn;
    if (this->Comparison.advantage(turned, current, hopeless) > hopeless)
    {
      tryFrom(turned);
    }
  }
  for (const Eigen::Isometry3d& turn : probability < Likely ? this->SmallTurns : this->SmallerTurns)
  {
    if (probability < Sure)
    {
      tryFrom(start.T_scene_model * turn);
    }
  }
}

void LocalSearch::turnAboutAxis(Pose& pose, Contender& current) const
{
  for (const Eigen::Isometry3d& T_scene_model : this->Search.better(pose.T_scene_model))
  {
    Pose turned = pose;
    turned.T_scene_model = T_scene_model;
    turned = refinePoses({ turned }, this->InScene, this->Model, this->AfterTurn)[0];
    if (this->Comparison.advantage(turned.T_scene_model, current, 0.0) > 0.0)
    {
      pose = turned;
      current = this->Comparison.contender(pose.T_scene_model);
    }
  }
}

std::vector<Eigen::Isometry3d> LocalSearch::rotationsOf(const Eigen::Isometry3d& T_scene_model, bool all) const
{
  std::vector<Eigen::Isometry3d> rotations(this->Rotations.begin(),
    all ? this->Rotations.end() : this->Rotations.begin() + static_cast<std::ptrdiff_t>(this->NearSymmetries));
  if (all)
  {
    const Eigen::Vector3f towards = this->Model.visibility->towards(T_scene_model, this->InScene.sensor);
    for (const SideSymmetry& side : this->Model.sides->of(this->Model))
    {
      if (side.towards.dot(towards) > FromThatSide)
      {
        rotations.insert(rotations.end(), side.turns.begin(), side.turns.end());
      }
    }
  }
  for (Eigen::Isometry3d& rotation : rotations)
  {
    rotation = T_scene_model * rotation;
  }
  return rotations;
}

void LocalSearch::decide(Pose& pose, Contender current) const
{
  const bool isLikely = claimOf(pose, false) >= WorthAsking;
  for (int round = 0; round < Rounds; ++round)
  {
    const std::vector<Eigen::Isometry3d> others = this->rotationsOf(pose.T_scene_model, isLikely);
    if (others.empty())
    {
      return;
    }
    std::vector<RotationAlternative> rotations{ { pose.T_scene_model, 0.0 } }; // their advantages, and then shares
    double least = Hopeless;                                                   // against the best of them
    for (const Eigen::Isometry3d& other : others)
    {
      rotations.push_back({ other, this->Comparison.advantageOfTurn(other, current, least) });
      least = std::max(least, rotations.back().share + Hopeless);
    }
    if (isLikely)
    {
      this->addEvidence(rotations, least);
      this->addDepth(rotations);
    }
    const std::size_t best = std::max_element(rotations.begin(), rotations.end(), hasLess) - rotations.begin();
    const double most = rotations[best].share;
    double odds = 0.0; // of all rotations against the best
    for (RotationAlternative& rotation : rotations)
    {
      rotation.share = std::exp((rotation.share - most) / SureAdvantage);
      odds += rotation.share;
    }
    pose.certainty = 1.0 / odds;
    pose.alternatives.clear();
    for (std::size_t k = 0; k < rotations.size(); ++k)
    {
      rotations[k].share /= odds;
      if (k != best && rotations[k].share >= LeastShare)
      {
        pose.alternatives.push_back(rotations[k]);
      }
    }
    std::stable_sort(pose.alternatives.begin(), pose.alternatives.end(),
      [](const RotationAlternative& a, const RotationAlternative& b) { return hasLess(b, a); });
    pose.T_scene_model = rotations[best].T_scene_model;
    if (best <= this->NearSymmetries) // nothing to refine, and the others are the same as seen from it
    {
      return;
    }
    pose = refinePoses({ pose }, this->InScene, this->Model, this->AfterTurn)[0];
    current = this->Comparison.contender(pose.T_scene_model);
  }
}

void LocalSearch::addEvidence(std::vector<RotationAlternative>& rotations, double least) const
{
  const double logOdds = this->Collector.logOdds(rotations.front().T_scene_model, this->Rates);
  for (auto other = rotations.begin() + 1; other != rotations.end(); ++other)
  {
    other->share =
      other->share > least
        ? other->share +
            SureAdvantage *
              logSaturated(this->Collector.logOdds(other->T_scene_model, this->Rates) - logOdds, MuchEvidence)
        : -std::numeric_limits<double>::infinity();
  }
}

void LocalSearch::addDepth(std::vector<RotationAlternative>& rotations) const
{
  if (!this->Depth)
  {
    return;
  }
  const double least = std::max_element(rotations.begin(), rotations.end(), hasLess)->share + Hopeless;
  std::optional<DepthFit::Rendered> first; // as most poses have no other rotation that is not hopeless
  for (auto other = rotations.begin() + 1; other != rotations.end(); ++other)
  {
    if (other->share > least)
    {
      if (!first)
      {
        first = this->Depth->render(rotations.front().T_scene_model);
      }
      other->share += SureAdvantage * this->Depth->logOdds(this->Depth->render(other->T_scene_model), *first);
    }
  }
}
}
