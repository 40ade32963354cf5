// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseVerification.h"

#include "base/Parallel.h"
#include "pose/selection/PoseClusters.h"
#include "pose/refinement/PoseRefinement.h"
#include "pose/verification/RotationSearch.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace meam
{
namespace
{
constexpr double ToleranceShare = 0.03; // of the diameter
constexpr double ClusterShare = 0.1;    // of the diameter
constexpr double SameShare = 0.4;       // of cluster distance and angle: poses this near are judged once
constexpr std::size_t PosesPerReport = 256; // between looks whether work is to stop
constexpr double LeastAtAGlance = 0.5;  // share of the surface; a pose with less is not looked at closely
constexpr std::size_t CandidateStride = 2; // of the points that judge more candidates than can stay
constexpr double LeastPlausible = 0.001; // of the best candidate's preference: those with less are not worth refining
constexpr int TurnIterations = 6;       // of the refinement of another turn, which is nearly right
constexpr double TurnDistanceShare = 0.04; // of the diameter, at its start
constexpr double SureAdvantage = 10.0;  // points that make a turn e times likelier than another
constexpr double Negligible = 9.0;      // times that: a turn so unlikely is one in ten thousand

/// Logistic regression of whether a pose is right, over poses in scenes with true ones, of the default weights of evidence
/// (examples/calibration.py).
struct Calibration
{
  double constant;
  double score;
  double certainty; ///< of its logarithm
};
constexpr Calibration WithSurface{ -18.9, 26.4, 5.8 };
constexpr Calibration EdgesAlone{ -4.1, 15.0, 1.7 };

/// Section 5.2 of the paper: share of the view's edge points that have a scene edge point near.
void scoreCoverage(Pose& pose, const Points& viewEdges, const EvidenceCollector& collector)
{
  const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
  const auto fitted = std::count_if(
    viewEdges.begin(), viewEdges.end(), [&](const auto& point) { return collector.nearEdge(T * point); });
  pose.score = viewEdges.empty() ? 0.0 : static_cast<double>(fitted) / viewEdges.size();
  pose.probability = pose.score;
  pose.visibleFraction = pose.score;
}

void scoreEvidence(
  Pose& pose, const PoseEvidence& evidence, const EvidenceSettings& settings, const SceneIndex& index)
{
  pose.viewId = index.view.view(pose.T_scene_model, index.scene.sensor);
  pose.visibleFraction = evidence.visibleFraction();
  pose.score = evidence.support(settings);
  const Calibration& known = index.hasSurfaces() ? WithSurface : EdgesAlone;
  pose.probability =
    1.0 / (1.0 + std::exp(-known.constant - known.score * pose.score) * std::pow(pose.certainty, -known.certainty));
}

/// Turns the pose about the axis of a nearly round part where another turn fits better. `asItIs` is the
/// pose as a contender, and follows it.
void settleTurn(Pose& pose, PoseComparison::Contender& asItIs, const PoseComparison& comparison, const RotationSearch& search,
  const SceneIndex& index)
{
  PoseRefinementSettings refinement;
  refinement.iterations = TurnIterations;
  refinement.maximumDistance = TurnDistanceShare * index.model.diameter;
  refinement.threads = 1; // poses are settled in parallel
  for (const Eigen::Isometry3d& T : search.better(pose.T_scene_model))
  {
    Pose turned = pose;
    turned.T_scene_model = T;
    turned = refineInFrame({ turned }, index, refinement)[0];
    if (comparison.advantage(turned.T_scene_model, asItIs, 0.0) > 0.0)
    {
      pose = turned;
      asItIs = comparison.contender(pose.T_scene_model);
    }
  }
}

/// Of the pose and its turns by the part's near-symmetries takes the one that the scene speaks for.
void settleNearSymmetry(
  Pose& pose, const PoseComparison::Contender& asItIs, const PoseComparison& comparison, const Symmetries& symmetries)
{
  const Eigen::Isometry3d T = pose.T_scene_model;
  std::vector<double> advantages{ 0.0 };
  for (const NearSymmetry& symmetry : symmetries.near)
  {
    advantages.push_back(comparison.advantage(T * symmetry.T, asItIs, -Negligible * SureAdvantage));
  }
  const auto best = std::max_element(advantages.begin(), advantages.end());
  double odds = 0.0; // of all turns against the best
  for (const double advantage : advantages)
  {
    odds += std::exp((advantage - *best) / SureAdvantage);
  }
  if (best != advantages.begin())
  {
    pose.T_scene_model = T * symmetries.near[best - advantages.begin() - 1].T;
  }
  pose.certainty = 1.0 / odds;
}

/// A first impression of each pose: how much of its surface is there.
std::vector<double> glances(const Poses& poses, const EvidenceCollector& collector, int threads)
{
  std::vector<double> shares(poses.size());
  parallelFor(static_cast<int>(poses.size()), threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        shares[i] = collector.glance(poses[i].T_scene_model);
      }
    });
  return shares;
}

/// Of poses that are nearly the same, up to the symmetries, the one with most votes times the share of its surface that is
/// there, of equals the first; none with less than `leastShare`. In the order they come.
Poses distinctPoses(const Poses& poses, const std::vector<double>& shares, double leastShare,
  const Eigen::Vector3d& middle, const Symmetries& symmetries, double distance, double angle, const Progress& progress)
{
  std::vector<int> order(poses.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](int a, int b) { return shares[a] * poses[a].votes > shares[b] * poses[b].votes; });
  std::vector<int> kept;
  for (const int i : order)
  {
    const Eigen::Isometry3d& T = poses[i].T_scene_model;
    const bool known = std::any_of(kept.begin(), kept.end(),
      [&](int k)
      {
        const Eigen::Isometry3d& other = poses[k].T_scene_model;
        return translationError(T, other, middle) < distance &&
          rotationError(nearestEqual(T, other, symmetries), other) < angle;
      });
    if (!known && shares[i] >= leastShare)
    {
      kept.push_back(i);
      if (kept.size() % PosesPerReport == 0)
      {
        report(progress, 0.0); // each pose is compared with all that are kept: very many take long
      }
    }
  }
  std::sort(kept.begin(), kept.end());
  Poses distinct;
  for (const int i : kept)
  {
    distinct.push_back(poses[i]);
  }
  return distinct;
}
}

PoseVerificationSettings paperVerificationSettings()
{
  PoseVerificationSettings settings;
  settings.method = VerificationMethod::EdgeCoverage;
  settings.tolerance = 1.0;
  settings.posesPerView = 5;
  settings.posesPerInstance = 1;
  return settings;
}

Poses verifyPoses(
  const Poses& candidates, const SceneIndex& index, const PoseVerificationSettings& settings, const Progress& progress)
{
  const bool byEvidence = settings.method == VerificationMethod::VisibleEvidence;
  if (byEvidence)
  {
    requireWeights(settings.evidence);
  }
  const TrainedModel& model = index.model;
  const Poses poses = inFrameOf(index.scene, candidates, model.symmetries);
  const EvidenceCollector collector(
    index, settings.tolerance > 0.0 ? settings.tolerance : ToleranceShare * model.diameter, settings.evidence);
  std::vector<Points> viewEdges; // asked for by coverage alone
  for (std::size_t v = 0; !byEvidence && v < model.viewDirections.size(); ++v)
  {
    viewEdges.push_back(index.view.viewEdges(static_cast<int>(v)).points);
  }
  const double clusterDistance =
    settings.clusterDistance > 0.0 ? settings.clusterDistance : ClusterShare * model.diameter;
  // Several poses of an instance are candidates: they will be refined, turned to where they fit best, and judged again.
  // Turns that this finds anyway would take the places of other alternatives.
  const bool areCandidates = byEvidence && settings.posesPerInstance > 1;
  Symmetries same = areCandidates ? asIfRound(model.symmetries) : model.symmetries;
  if (!areCandidates)
  {
    same.near.clear();
  }
  const bool someMustGo = settings.maximumPoses > 0 && static_cast<int>(poses.size()) > settings.maximumPoses;
  Poses scored = poses;
  if (byEvidence)
  {
    const std::vector<double> shares = index.hasSurfaces() ? glances(poses, collector, settings.threads)
                                                           : std::vector<double>(poses.size(), 1.0);
    scored = distinctPoses(poses, shares, someMustGo ? LeastAtAGlance : 0.0, index.view.middle().cast<double>(), same,
      SameShare * clusterDistance, SameShare * settings.clusterAngle, progress);
  }
  const std::size_t stride = someMustGo && areCandidates ? CandidateStride : 1;
  const RotationSearch search(index);
  std::vector<PoseEvidence> evidence(byEvidence ? scored.size() : 0);
  parallelFor(static_cast<int>(scored.size()), settings.threads, subProgress(progress, 0.0, 0.75),
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        if (areCandidates && someMustGo)
        {
          scored[i].T_scene_model = search.likeliest(scored[i].T_scene_model);
        }
        if (byEvidence)
        {
          evidence[i] = collector.collect(scored[i].T_scene_model, stride);
          scoreEvidence(scored[i], evidence[i], settings.evidence, index);
        }
        else
        {
          scored[i].viewId = index.viewOf(scored[i]);
          scoreCoverage(scored[i], viewEdges[scored[i].viewId], collector);
        }
      }
    });
  std::vector<int> order(scored.size());
  std::iota(order.begin(), order.end(), 0);
  const auto better = [&](int a, int b) { return preference(scored[a]) > preference(scored[b]); };
  std::stable_sort(order.begin(), order.end(), better);

  std::optional<PoseComparison> comparison;
  if (byEvidence && !areCandidates)
  {
    comparison.emplace(index, settings.evidence);
  }
  PoseClusters clusters(scored, evidence, same, index, collector, comparison ? &*comparison : nullptr, settings,
    clusterDistance, 0.5 * model.diameter);
  std::vector<int> ofView(TrainedModel::MaximumViews, 0);
  std::vector<int> ranked;
  for (const int i : order)
  {
    if (scored[i].score >= settings.minimumScore &&
      (settings.posesPerView == 0 || ++ofView[scored[i].viewId] <= settings.posesPerView))
    {
      ranked.push_back(i);
    }
  }
  std::vector<int> selected = clusters.select(ranked, subProgress(progress, 0.75, 0.8));
  if (comparison)
  {
    parallelFor(static_cast<int>(selected.size()), settings.threads, subProgress(progress, 0.8, 1.0),
      [&](int begin, int end, int)
      {
        for (int k = begin; k < end; ++k)
        {
          const int i = selected[k];
          if (!model.symmetries.near.empty())
          {
            PoseComparison::Contender asItIs = clusters.contender(i);
            settleTurn(scored[i], asItIs, *comparison, search, index);
            settleNearSymmetry(scored[i], asItIs, *comparison, model.symmetries);
          }
          scored[i] = settlePose(scored[i], index);
          scoreEvidence(scored[i], collector.collect(scored[i].T_scene_model), settings.evidence, index);
        }
      });
  }
  std::stable_sort(selected.begin(), selected.end(), better);
  const auto middle = [&](int i) { return (scored[i].T_scene_model * index.view.middle().cast<double>()).eval(); };
  const double plausible =
    areCandidates && someMustGo && !selected.empty() ? LeastPlausible * preference(scored[selected[0]]) : 0.0;
  std::vector<int> kept;
  for (const int i : selected)
  {
    // Poses that were settled may have come to the same place.
    const bool known = comparison &&
      std::any_of(kept.begin(), kept.end(), [&](int k) { return (middle(i) - middle(k)).norm() < clusterDistance; });
    const bool full = settings.maximumPoses > 0 && static_cast<int>(kept.size()) >= settings.maximumPoses;
    if (!known && !full && scored[i].probability >= settings.minimumProbability && preference(scored[i]) >= plausible)
    {
      kept.push_back(i);
    }
  }
  Poses best;
  for (const int i : kept)
  {
    best.push_back(moved(scored[i], index.scene.frame.inverse()));
    Eigen::Isometry3d& T = best.back().T_scene_model;
    T = nearestEqual(T, Eigen::Isometry3d::Identity(), model.symmetries);
  }
  report(progress, 1.0);
  return best;
}
}
