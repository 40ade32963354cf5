// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/ConflictResolution.h"

#include "base/Parallel.h"
#include "pose/verification/PoseEvidence.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace meam
{
namespace
{
// Shares of the diameter.
constexpr double VerifiedShare = 0.03;  // within which verification matches
constexpr double ExplainedShare = 0.02; // a point this far from a part is not explained
constexpr double ResolvedShare = 0.01;  // what the distance to a part's surface is known to

constexpr double MostProbable = 0.99;      // no pose is surer: 99 to 1

/// What the sensor measured, the same for all parts: the finest of the maps of its surface, or the scene's edges.
struct Measured
{
  explicit Measured(const SceneIndex& ofSmallest)
    : points(ofSmallest.scene.surface.empty() ? ofSmallest.scene.edges.points : ofSmallest.depth.means())
    , grid(ofSmallest.scene.surface.empty() ? ofSmallest.edges : ofSmallest.surface)
  {
  }

  const Points& points;
  const PointGrid& grid;
};

/// What a pose claims of the scene.
struct Claim
{
  PartPose pose;
  std::vector<int> points; ///< measured points that it explains, ascending
  double support = 0.0;
};

/// The measured points within `tolerance` (mm) of the part.
std::vector<int> explainedPoints(
  const Measured& measured, const SceneIndex& index, const Eigen::Isometry3d& T_scene_model, double tolerance)
{
  const DistanceField& distance = index.hasSurfaces() ? index.model.surfaceDistance : index.model.edgeDistance;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const Eigen::Isometry3f toModel = T.inverse();
  std::vector<int> explained;
  measured.grid.forEachWithin(T * distance.middle(), distance.radius() + tolerance,
    [&](int k, float)
    {
      if (distance.at(toModel * measured.points[k]) < tolerance)
      {
        explained.push_back(k);
      }
    });
  std::sort(explained.begin(), explained.end());
  return explained;
}

/// 1 when nothing that the pose predicts in sight is missing, 0 when as much is missing as is there. Missing is what the
/// sensor looked past, and, since another pose may do without it, what was not measured.
double soundShare(const std::vector<PointState>& states)
{
  const auto matched = std::count(states.begin(), states.end(), PointState::Matched);
  const auto missing = std::count(states.begin(), states.end(), PointState::Violated) +
    std::count(states.begin(), states.end(), PointState::Unknown);
  return matched > missing ? static_cast<double>(matched - missing) / matched : 0.0;
}

Claim claimOf(const PartPose& pose, const SceneIndex& index, const Measured& measured, double tolerance)
{
  const Pose inFrame = inFrameOf(index.scene, { pose.pose }, index.model.symmetries).front();
  const Eigen::Isometry3d& T = inFrame.T_scene_model;
  const EvidenceCollector collector(index, VerifiedShare * index.model.diameter);
  const PoseEvidence evidence = collector.collect(T);
  Claim claim{ pose, explainedPoints(measured, index, T, tolerance) };
  claim.pose.pose.viewId = index.viewOf(inFrame);
  const double probability = std::min(confidence(pose.pose), MostProbable);
  claim.support = probability / (1.0 - probability) * claim.points.size() *
    soundShare(evidence.surface.empty() ? evidence.edgeStates : evidence.surfaceStates);
  return claim;
}

bool betterSupported(const Claim& a, const Claim& b)
{
  const auto key = [](const Claim& claim)
  {
    const Pose& pose = claim.pose.pose;
    return std::make_tuple(claim.support, confidence(pose), pose.score, pose.visibleFraction);
  };
  return key(a) > key(b);
}

/// The larger share of what one of the two explains that the other explains, too.
double sharedPoints(const Claim& a, const Claim& b)
{
  std::vector<int> common;
  std::set_intersection(
    a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), std::back_inserter(common));
  const std::size_t fewer = std::min(a.points.size(), b.points.size());
  return fewer > 0 ? static_cast<double>(common.size()) / fewer : 0.0;
}

/// The part with the smallest diameter, after checks.
const SceneIndex& smallest(const std::vector<PartDetections>& parts)
{
  const SceneIndex* least = &parts.front().index;
  for (const PartDetections& part : parts)
  {
    if (part.index.scene.surface.empty() != least->scene.surface.empty())
    {
      throw Error("Some parts were looked for with the scene's surface and others without: use the same scene for all.");
    }
    least = part.index.model.diameter < least->model.diameter ? &part.index : least;
  }
  return *least;
}
}

std::vector<PartPose> resolveConflicts(
  const std::vector<PartDetections>& parts, const ConflictResolutionSettings& settings, const Progress& progress)
{
  if (!(settings.tolerance >= 0.0) || !(settings.shared >= 0.0 && settings.shared <= 1.0))
  {
    throw Error("The tolerance has to be 0 mm or more, and the shared surface from 0 to 1.");
  }
  std::vector<Claim> claims;
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    for (const Pose& pose : parts[part].poses)
    {
      claims.push_back({ { static_cast<int>(part), pose }, {} });
    }
  }
  if (claims.empty())
  {
    return {};
  }
  const SceneIndex& finest = smallest(parts);
  const Measured measured(finest);
  parallelFor(static_cast<int>(claims.size()), settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        const SceneIndex& index = parts[claims[i].pose.part].index;
        const double diameter = index.model.diameter;
        const double tolerance = settings.tolerance > 0.0
          ? std::min(settings.tolerance, ExplainedShare * diameter)
          : std::max(ExplainedShare * finest.model.diameter, ResolvedShare * diameter);
        claims[i] = claimOf(claims[i].pose, index, measured, tolerance);
      }
    });
  std::stable_sort(claims.begin(), claims.end(), betterSupported);
  std::vector<const Claim*> kept;
  for (const Claim& claim : claims)
  {
    const bool taken = std::any_of(
      kept.begin(), kept.end(), [&](const Claim* other) { return sharedPoints(claim, *other) > settings.shared; });
    if (!taken)
    {
      kept.push_back(&claim);
    }
  }
  std::stable_sort(kept.begin(), kept.end(),
    [](const Claim* a, const Claim* b) { return preference(a->pose.pose) > preference(b->pose.pose); });
  if (settings.maximumPoses > 0 && kept.size() > static_cast<std::size_t>(settings.maximumPoses))
  {
    kept.resize(settings.maximumPoses);
  }
  std::vector<PartPose> stay;
  for (const Claim* claim : kept)
  {
    stay.push_back(claim->pose);
  }
  report(progress, 1.0);
  return stay;
}
}
