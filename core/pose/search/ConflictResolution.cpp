// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/ConflictResolution.h"

#include "base/Parallel.h"
#include "base/Range.h"
#include "pose/PoseTolerances.h"
#include "pose/search/Suppression.h"
#include "pose/verification/PoseVerification.h"
#include "pose/verification/ProbabilityCalibration.h"

#include <algorithm>
#include <tuple>

namespace meam
{
namespace
{
constexpr double Resolved = 0.01;     // of the diameter, what the distance to a part's surface is known to
constexpr double MostProbable = 0.99; // no pose is surer: 99 to 1
constexpr double MuchMore = 4.0;      // times the support: what lies there is that part, and not one that looks alike
constexpr double LeastByRates = 0.5;  // the usual rates lower no pose below this

/// What a pose claims of the scene.
struct Claim
{
  PartPose pose;
  ExplainedPoints points;
  double support = 0.0;
};

/// 1 when nothing that the pose predicts in sight is missing, 0 when as much is missing as is there. Missing is what
/// the sensor saw past, and, since another pose may do without it, what was not measured.
double soundShare(const std::vector<PointState>& states)
{
  const auto matched = std::count(states.begin(), states.end(), PointState::Matched);
  const auto missing = std::count(states.begin(), states.end(), PointState::Violated) +
                       std::count(states.begin(), states.end(), PointState::Unknown);
  return matched > missing ? static_cast<double>(matched - missing) / matched : 0.0;
}

Claim claimOf(const PartPose& pose, const PartDetections& part, const Scene& measured, double tolerance)
{
  const Eigen::Isometry3d& T = pose.pose.T_scene_model;
  const EvidenceCollector collector(part.scene, part.model);
  const PoseEvidence evidence = collector.collect(T);
  Claim claim{ pose, explainedPoints(measured, part.model, T, tolerance) };
  claim.pose.pose.viewId = viewOf(pose.pose, part.scene, part.model);
  // Rates of its own make a type of which little is seen likelier than by the usual ones, which are the same for all.
  const double byUsualRates = std::max(probabilityOf(collector.logOdds(evidence.counts, {})), LeastByRates);
  const double probability = std::min({ placeOrScore(pose.pose), byUsualRates, MostProbable });
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

/// Of all poses, type after type.
std::vector<Claim> claimsOf(
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
  parallelForEach(static_cast<int>(claims.size()), settings.threads, progress,
    [&](int i)
    {
      const PartDetections& part = parts[claims[i].pose.part];
      const double tolerance = std::max(UnexplainedDistance * finest.model.diameter, Resolved * part.model.diameter);
      claims[i] = claimOf(claims[i].pose, part, finest.scene, tolerance);
    });
  return claims;
}

bool areInConflict(const Claim& a, const Claim& b, double shared)
{
  return sharedPoints(a.points, b.points) > shared * std::min(a.points.size(), b.points.size());
}
}

std::vector<std::vector<bool>> onOtherParts(
  const std::vector<PartDetections>& parts, const ConflictResolutionSettings& settings, const Progress& progress)
{
  std::vector<std::vector<bool>> result;
  for (const PartDetections& part : parts)
  {
    result.emplace_back(part.poses.size(), false);
  }
  const std::vector<Claim> claims = claimsOf(parts, settings, progress);
  for (const Claim& one : claims)
  {
    result[one.pose.part][one.pose.index] = std::any_of(claims.begin(), claims.end(),
      [&](const Claim& other)
      {
        return other.pose.part != one.pose.part && other.support > MuchMore * one.support &&
               areInConflict(one, other, settings.shared);
      });
  }
  return result;
}

std::vector<PartPose> resolveConflicts(
  const std::vector<PartDetections>& parts, const ConflictResolutionSettings& settings, const Progress& progress)
{
  std::vector<Claim> claims = claimsOf(parts, settings, progress);
  std::stable_sort(claims.begin(), claims.end(), betterSupported);
  std::vector<PartPose> stay;
  for (const int k : suppress(
         static_cast<int>(claims.size()),
         [&](int a, int b) { return areInConflict(claims[a], claims[b], settings.shared); },
         [](int, int) { return false; }))
  {
    stay.push_back(claims[k].pose);
  }
  std::stable_sort(
    stay.begin(), stay.end(), [](const PartPose& a, const PartPose& b) { return isBetter(a.pose, b.pose); });
  if (settings.maximumPoses > 0 && stay.size() > static_cast<std::size_t>(settings.maximumPoses))
  {
    stay.resize(settings.maximumPoses);
  }
  report(progress, 1.0);
  return stay;
}
}
