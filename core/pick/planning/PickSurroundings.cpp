// SPDX-License-Identifier: BSD-3-Clause
#include "pick/planning/PickSurroundings.h"

#include <algorithm>

namespace meam
{
namespace
{
// Shares of the part's size, the diagonal of its box.
constexpr double ToleranceOfPart = 0.01; // the tolerance without noise, and the smallest voxel
constexpr double NoiseInTolerance = 3.0; // standard deviations: all but 3 of 1,000 points
constexpr double PointsInVoxel = 4.0;  // point distances in the side of a voxel, so that a slanted surface has no holes
constexpr double ThinnedInVoxel = 2.0; // of the points along that side so many are taken: more say no more

/// Every so-manieth finite point of the scan, so that a few of them are in the side of a voxel.
Points thinned(const OrganizedCloud& cloud, double pointDistance, double voxelSize)
{
  const int step = cloud.height > 1 && pointDistance > 0.0
                     ? std::max(1, static_cast<int>(voxelSize / (ThinnedInVoxel * pointDistance)))
                     : 1;
  return everyNth(cloud, step);
}
}

double confidence(const Pose& pose, bool needsRotation)
{
  const double known = needsRotation ? probabilityOrScore(pose) : placeOrScore(pose);
  return known > 0.0 ? known : 1.0;
}

PickSurroundings surroundingsOf(const Poses& poses, const std::vector<const PartSurface*>& surfaces,
  const OrganizedCloud& cloud, const GridScale& scale, const std::optional<Bin>& bin, double partSize,
  const PlanSettings& settings)
{
  PickSurroundings around;
  const double ofPart = ToleranceOfPart * partSize;
  around.tolerance = settings.tolerance > 0.0 ? settings.tolerance : ofPart + NoiseInTolerance * scale.noise;
  around.tolerance = std::min(around.tolerance, MostTolerance * partSize);
  around.voxelSize = std::max(ofPart, PointsInVoxel * scale.pointDistance);
  around.points = thinned(cloud, scale.pointDistance, around.voxelSize);
  if (bin)
  {
    around.up = bin->T_scene_bin.linear().col(2);
    around.top = around.up.dot(bin->T_scene_bin * Eigen::Vector3d(0.0, 0.0, bin->size.z()));
  }
  else if (!around.points.empty())
  {
    const auto height = [&](const Eigen::Vector3f& point) { return around.up.dot(point.cast<double>()); };
    around.top = height(*std::max_element(
      around.points.begin(), around.points.end(), [&](const auto& a, const auto& b) { return height(a) < height(b); }));
  }

  std::vector<bool> explained(around.points.size(), false);
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    if (confidence(poses[k], false) < settings.minimumProbability)
    {
      continue;
    }
    around.copies.push_back(static_cast<int>(k));
    around.pointsOf.push_back(surfaces[k]->pointsAt(poses[k].T_scene_model, around.points, around.tolerance));
    for (const int index : around.pointsOf.back())
    {
      explained[index] = true;
    }
  }
  for (std::size_t k = 0; k < around.points.size(); ++k)
  {
    if (!explained[k] && !(bin && distanceFrom(*bin, around.points[k].cast<double>()) <= around.tolerance))
    {
      around.unexplained.push_back(around.points[k]);
    }
  }
  return around;
}

double coveredShare(const Pose& pose, int copy, const PartSurface& surface, const PickSurroundings& around)
{
  std::vector<bool> own(around.points.size(), false);
  for (const int index : around.pointsOf[copy])
  {
    own[index] = true;
  }
  const Eigen::Vector3d middle = pose.T_scene_model * surface.middle();
  Points others;
  for (std::size_t k = 0; k < around.points.size(); ++k)
  {
    const Eigen::Vector3d from = around.points[k].cast<double>() - middle;
    if (!own[k] && (from - from.dot(around.up) * around.up).norm() <= surface.radius())
    {
      others.push_back(around.points[k]);
    }
  }
  return surface.covered(pose.T_scene_model, around.up, others, around.voxelSize, around.tolerance);
}
}
