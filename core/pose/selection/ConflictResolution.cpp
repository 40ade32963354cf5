// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/ConflictResolution.h"

#include "base/Parallel.h"
#include "base/Range.h"
#include "pose/PoseTolerances.h"
#include "pose/verification/PoseVerification.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace meam
{
namespace
{
constexpr double Resolved = 0.01;     // of the diameter, what the distance to a part's surface is known to
constexpr double MostProbable = 0.99; // no pose is surer: 99 to 1

/// What the sensor measured, the same for all parts: the finest of the maps of its surface, or the scene's edges.
struct Measured
{
  explicit Measured(const Scene& ofSmallest)
    : points(ofSmallest.hasSurface() ? ofSmallest.depth.means() : ofSmallest.edgePoints().points)
    , grid(ofSmallest.hasSurface() ? ofSmallest.surface : ofSmallest.edgeGrid())
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
  const Measured& measured, const PartDetections& part, const Eigen::Isometry3d& T_scene_model, double tolerance)
{
  const DistanceField& distance =
    haveSurfaces(part.scene, part.model) ? part.model.surfaceDistance : part.model.edgeDistance;
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

/// 1 when nothing that the pose predicts in sight is missing, 0 when as much is missing as is there. Missing is what
/// the sensor saw past, and, since another pose may do without it, what was not measured.
double soundShare(const std::vector<PointState>& states)
{
  const auto matched = std::count(states.begin(), states.end(), PointState::Matched);
  const auto missing = std::count(states.begin(), states.end(), PointState::Violated) +
                       std::count(states.begin(), states.end(), PointState::Unknown);
  return matched > missing ? static_cast<double>(matched - missing) / matched : 0.0;
}

Claim claimOf(const PartPose& pose, const PartDetections& part, const Measured& measured, double tolerance)
{
  const Eigen::Isometry3d& T = pose.pose.T_scene_model;
  const EvidenceCollector collector(part.scene, part.model);
  const PoseEvidence evidence = collector.collect(T);
  Claim claim{ pose, explainedPoints(measured, part, T, tolerance) };
  claim.pose.pose.viewId = viewOf(pose.pose, part.scene, part.model);
  const double probability = std::min(placeOrScore(pose.pose), MostProbable);
  claim.support = probability / (1.0 - probability) * claim.points.size() *
                  soundShare(evidence.surface.empty() ? evidence.edgeStates : evidence.surfaceStates);
  return claim;
}

bool betterSupported(const Claim& a, const Claim& b)
{
  const auto key = [](const Claim& claim)
  {
    const Pose& pose = claim.pose.pose;
    return std::make_tuple(claim.support, placeOrScore(pose), pose.score, pose.visibleFraction);
  };
  return key(a) > key(b);
}

/// The larger share of what one of the two explains that the other explains, too.
double sharedPoints(const Claim& a, const Claim& b)
{
  std::vector<int> common;
  std::set_intersection(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), std::back_inserter(common));
  const std::size_t fewer = std::min(a.points.size(), b.points.size());
  return fewer > 0 ? static_cast<double>(common.size()) / fewer : 0.0;
}

/// The part with the smallest diameter, after checks.
const PartDetections& smallest(const std::vector<PartDetections>& parts)
{
  const PartDetections* least = &parts.front();
  for (const PartDetections& part : parts)
  {
    if (part.scene.hasSurface() != least->scene.hasSurface())
    {
      throw Error(
        "Some parts were looked for with the scene's surface and others without: use the same scene for all.");
    }
    least = part.model.diameter < least->model.diameter ? &part : least;
  }
  return *least;
}
}

std::vector<PartPose> resolveConflicts(
  const std::vector<PartDetections>& parts, const ConflictResolutionSettings& settings, const Progress& progress)
{
  requireWithin("share of the surface that is claimed twice", settings.shared, 0.0, 1.0);
  std::vector<Claim> claims;
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    for (std::size_t i = 0; i < parts[part].poses.size(); ++i)
    {
      claims.push_back({ { static_cast<int>(part), static_cast<int>(i), parts[part].poses[i] }, {} });
    }
  }
  if (claims.empty())
  {
    return {};
  }
  const PartDetections& finest = smallest(parts);
  const Measured measured(finest.scene);
  parallelFor(static_cast<int>(claims.size()), settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        const PartDetections& part = parts[claims[i].pose.part];
        const double tolerance = std::max(UnexplainedDistance * finest.model.diameter, Resolved * part.model.diameter);
        claims[i] = claimOf(claims[i].pose, part, measured, tolerance);
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
  std::stable_sort(
    kept.begin(), kept.end(), [](const Claim* a, const Claim* b) { return isBetter(a->pose.pose, b->pose.pose); });
  if (settings.maximumPoses > 0 && kept.size() > static_cast<std::size_t>(settings.maximumPoses))
  {
    kept.resize(settings.maximumPoses);
  }
  std::vector<PartPose> stay;
  stay.reserve(kept.size());
  for (const Claim* claim : kept)
  {
    stay.push_back(claim->pose);
  }
  report(progress, 1.0);
  return stay;
}
}
