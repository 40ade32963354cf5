// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseVerification.h"

#include "Parallel.h"
#include "pose/PoseEvidence.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace meam
{
namespace
{
constexpr double ToleranceShare = 0.03; // of the diameter
constexpr double ClusterShare = 0.1;    // of the diameter
constexpr double SharedByOne = 0.5;        // share of the matched surface from which on two poses are of one instance
constexpr double VisibilityExponent = 0.5; // parts that nothing hides come first: they can be grasped

/// Section 5.2 of the paper: share of the view's edge points that have a scene edge point near.
void scoreCoverage(Pose& pose, const Points& viewEdges, const EvidenceCollector& collector)
{
  const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
  const auto fitted = std::count_if(
    viewEdges.begin(), viewEdges.end(), [&](const auto& point) { return collector.nearEdge(T * point); });
  pose.score = viewEdges.empty() ? 0.0 : static_cast<double>(fitted) / viewEdges.size();
  pose.visibleFraction = pose.score;
}

/// Indices of the poses that stay, best first.
class Clusters
{
public:
  Clusters(const Poses& poses, const std::vector<PoseEvidence>& evidence, const EvidenceCollector& collector,
    const PoseVerificationSettings& settings, double distance, double reach)
    : InPoses(poses)
    , Evidence(evidence)
    , Collector(collector)
    , Settings(settings)
    , Distance(distance)
    , Reach(reach)
  {
  }

  void add(int candidate)
  {
    const auto isOfInstance = [&](int kept) { return this->sameInstance(candidate, kept); };
    std::vector<int> alternatives;
    std::copy_if(this->Kept.begin(), this->Kept.end(), std::back_inserter(alternatives), isOfInstance);
    for (const int kept : alternatives)
    {
      if (rotationError(this->InPoses[candidate].T_scene_model, this->InPoses[kept].T_scene_model) <
        this->Settings.clusterAngle)
      {
        return;
      }
    }
    if (static_cast<int>(alternatives.size()) >= this->Settings.posesPerInstance)
    {
      const bool best = this->Settings.posesPerInstance == 1 && !this->Evidence.empty() &&
        std::all_of(alternatives.begin(), alternatives.end(),
          [&](int kept) { return this->Collector.compare(this->Evidence[candidate], this->Evidence[kept]) > 0.0; });
      if (!best)
      {
        return;
      }
      this->Kept.erase(std::remove_if(this->Kept.begin(), this->Kept.end(), isOfInstance), this->Kept.end());
    }
    this->Kept.push_back(candidate);
  }

  std::vector<int> Kept;

private:
  bool sameInstance(int a, int b) const
  {
    const double apart = (this->middle(a) - this->middle(b)).norm();
    if (apart < this->Distance || this->Settings.posesPerInstance > 1 || this->Evidence.empty())
    {
      return apart < this->Distance;
    }
    // Two parts do not have their surface in the same place.
    return apart < this->Reach && this->Collector.shared(this->Evidence[a], this->Evidence[b]) > SharedByOne;
  }

  Eigen::Vector3d middle(int index) const
  {
    return this->InPoses[index].T_scene_model * this->Collector.view().middle().cast<double>();
  }

  const Poses& InPoses;
  const std::vector<PoseEvidence>& Evidence;
  const EvidenceCollector& Collector;
  const PoseVerificationSettings& Settings;
  double Distance;
  double Reach; ///< middles farther apart are of two instances
};
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

Poses verifyPoses(const Poses& poses, const TrainedModel& model, const Scene& scene,
  const PoseVerificationSettings& settings, const Progress& progress)
{
  requirePoints(scene.edges.points, "The scene's edge cloud");
  const bool byEvidence = settings.method == VerificationMethod::VisibleEvidence;
  const EvidenceCollector collector(
    model, scene, settings.tolerance > 0.0 ? settings.tolerance : ToleranceShare * model.diameter);
  std::vector<Points> viewEdges;
  for (std::size_t v = 0; v < model.viewDirections.size(); ++v)
  {
    viewEdges.push_back(collector.view().viewEdges(static_cast<int>(v)).points);
  }
  Poses scored = poses;
  std::vector<PoseEvidence> evidence(byEvidence ? scored.size() : 0);
  parallelFor(static_cast<int>(scored.size()), settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        if (!byEvidence)
        {
          scoreCoverage(scored[i], viewEdges.at(scored[i].viewId), collector);
          continue;
        }
        evidence[i] = collector.collect(scored[i].T_scene_model);
        scored[i].viewId = collector.view().view(scored[i].T_scene_model, scene.sensor);
        scored[i].visibleFraction = evidence[i].visibleFraction();
        scored[i].score = evidence[i].support() * std::pow(scored[i].visibleFraction, VisibilityExponent);
      }
    });
  std::vector<int> order(scored.size());
  std::iota(order.begin(), order.end(), 0);
  const auto better = [&](int a, int b) { return scored[a].score > scored[b].score; };
  std::stable_sort(order.begin(), order.end(), better);

  Clusters clusters(scored, evidence, collector, settings,
    settings.clusterDistance > 0.0 ? settings.clusterDistance : ClusterShare * model.diameter, 0.5 * model.diameter);
  std::vector<int> ofView(TrainedModel::MaximumViews, 0);
  for (const int i : order)
  {
    if (scored[i].score >= settings.minimumScore &&
      (settings.posesPerView == 0 || ++ofView[scored[i].viewId] <= settings.posesPerView))
    {
      clusters.add(i);
    }
  }
  std::stable_sort(clusters.Kept.begin(), clusters.Kept.end(), better);
  Poses best;
  for (const int i : clusters.Kept)
  {
    if (settings.maximumPoses == 0 || static_cast<int>(best.size()) < settings.maximumPoses)
    {
      best.push_back(scored[i]);
    }
  }
  report(progress, 1.0);
  return best;
}
}
