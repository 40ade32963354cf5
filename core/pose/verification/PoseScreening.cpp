// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseScreening.h"

#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "base/sequences/Sequences.h"
#include "pose/PoseTolerances.h"
#include "pose/verification/PoseEvidence.h"
#include "pose/verification/RotationSearch.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace meam
{
namespace
{
constexpr double Unmeasured = 0.5;         // of a point that is there: what one counts where nothing was measured
constexpr double DuplicateDistance = 0.04; // of the diameter: candidates nearer to each other are duplicates,
constexpr double DuplicateAngle = 6.0;     // and those turned less than this (degrees)
constexpr int PointStride = 3;             // of the verification points one of so many is looked at

/// Looks at the surface of poses alone, at few points.
class SurfaceScreening
{
public:
  SurfaceScreening(const Scene& scene, const TrainedModel& model, const PoseScreeningSettings& settings)
    : InScene(scene)
    , Model(model)
    , Tolerance(static_cast<float>(FitDistance * model.diameter))
    , FreeSpace(settings.freeSpace)
  {
    const std::vector<int>& points = model.verificationPoints;
    for (std::size_t k = 0; k < points.size(); k += PointStride)
    {
      this->Points.add(model.surface.points[points[k]], model.surface.normals[points[k]]);
    }
  }

  /// Of the surface points that face the sensor and that nothing hides the share that is there, [0, 1]; those where
  /// nothing was measured count in part.
  double share(const Eigen::Isometry3d& T_scene_model) const
  {
    const Eigen::Isometry3f T = T_scene_model.cast<float>();
    const Eigen::Vector3f towards = this->Model.visibility->towards(T_scene_model, this->InScene.sensor);
    const auto& [x, y, z] = this->Points.directions;
    const int size = static_cast<int>(this->Points.size());
    DepthMap::Relation relations[SoABlock];
    int matched = 0, violated = 0, unknown = 0;
    for (int begin = 0; begin < size; begin += SoABlock)
    {
      const int count = std::min(SoABlock, size - begin);
      this->InScene.depth.relations(T, this->Points.points, begin, count, this->Tolerance, relations);
      for (int k = 0; k < count; ++k)
      {
        const bool isFacing =
          x[begin + k] * towards.x() + y[begin + k] * towards.y() + z[begin + k] * towards.z() > 0.0f;
        const DepthMap::Relation relation = relations[k];
        matched += isFacing & (relation == DepthMap::Relation::OnSurface);
        violated += isFacing & (relation == DepthMap::Relation::InFront);
        unknown += isFacing & (relation == DepthMap::Relation::NoSurface);
      }
    }
    if (!this->FreeSpace)
    {
      unknown += std::exchange(violated, 0);
    }
    const int inSight = matched + violated + unknown;
    return inSight > 0 ? (matched + Unmeasured * unknown) / inSight : 0.0;
  }

private:
  const Scene& InScene;
  const TrainedModel& Model;
  float Tolerance;
  bool FreeSpace;
  SoAOrientedPoints Points;
};
}

std::vector<double> surfaceShares(
  const Poses& poses, const Scene& scene, const TrainedModel& model, const PoseScreeningSettings& settings)
{
  std::vector<double> shares(poses.size(), 1.0);
  if (haveSurfaces(scene, model))
  {
    const SurfaceScreening screening(scene, model, settings);
    parallelForEach(static_cast<int>(poses.size()), settings.threads, {},
      [&](int i) { shares[i] = screening.share(poses[i].T_scene_model); });
  }
  return shares;
}

Poses screenPoses(const Poses& candidates, const Scene& scene, const TrainedModel& model,
  const PoseScreeningSettings& settings, const Progress& progress)
{
  constexpr std::size_t posesPerReport = 256; // each is compared with those near by, which may be many
  const std::vector<double> shares = surfaceShares(candidates, scene, model, settings);
  const double least = static_cast<int>(candidates.size()) > settings.enough ? settings.leastSurface : 0.0;
  const double distance = DuplicateDistance * model.diameter;
  const Symmetries same = asIfRound(model.symmetries);
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  std::vector<int> order(candidates.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](int a, int b) { return shares[a] * candidates[a].votes > shares[b] * candidates[b].votes; });
  Points middles; // of the part
  float farthest = 0.0f;
  for (const Pose& candidate : candidates)
  {
    middles.push_back((candidate.T_scene_model * middle).cast<float>());
    farthest = middles.back().allFinite() ? std::max(farthest, middles.back().cwiseAbs().maxCoeff()) : farthest;
  }
  // Of the grid, in single precision, which rounds a millionth of a coordinate: what it finds is looked at exactly.
  const double reach = distance + 1e-6 * farthest + 1e-6 * model.diameter;
  const PointGrid grid(middles, reach);
  std::vector<char> isKept(candidates.size(), 0);
  std::vector<int> kept;
  for (std::size_t looked = 0; looked < order.size(); ++looked)
  {
    if (looked % posesPerReport == 0)
    {
      report(progress, 0.0);
    }
    const int i = order[looked];
    if (shares[i] < least)
    {
      continue;
    }
    const Eigen::Isometry3d& T = candidates[i].T_scene_model;
    bool isDuplicate = false;
    grid.forEachWithin(middles[i], reach,
      [&](int k, float)
      {
        const Eigen::Isometry3d& other = candidates[k].T_scene_model;
        isDuplicate = isDuplicate || (isKept[k] && translationError(T, other, middle) < distance &&
                                       rotationError(nearestEqual(T, other, same), other) < DuplicateAngle);
      });
    if (!isDuplicate)
    {
      isKept[i] = 1;
      kept.push_back(i);
    }
  }
  std::sort(kept.begin(), kept.end());
  auto screened = mapped<Pose>(kept, [&](const int i) { return candidates[i]; });
  const RotationSearch search(scene, model);
  parallelForEach(static_cast<int>(screened.size()), settings.threads, progress,
    [&](int i) { screened[i].T_scene_model = search.likeliest(screened[i].T_scene_model); });
  report(progress, 1.0);
  return screened;
}
}
