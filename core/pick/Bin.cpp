// SPDX-License-Identifier: BSD-3-Clause
#include "pick/Bin.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>

namespace meam
{
std::vector<PlacedBox> boxesOf(const Bin& bin)
{
  const Eigen::Vector3d& in = bin.size;
  const double wall = bin.wall;
  std::vector<PlacedBox> boxes;
  const auto add = [&](const Eigen::Vector3d& middle, const Eigen::Vector3d& size) {
    boxes.push_back({ bin.T_scene_bin * Eigen::Translation3d(middle), size });
  };
  add({ 0.0, 0.0, -0.5 * wall }, { in.x() + 2.0 * wall, in.y() + 2.0 * wall, wall });
  for (const double side : { -1.0, 1.0 })
  {
    add({ 0.5 * side * (in.x() + wall), 0.0, 0.5 * in.z() }, { wall, in.y() + 2.0 * wall, in.z() });
    add({ 0.0, 0.5 * side * (in.y() + wall), 0.5 * in.z() }, { in.x(), wall, in.z() });
  }
  return boxes;
}

double distanceFrom(const Bin& bin, const Eigen::Vector3d& point)
{
  // By symmetry of the walls one corner is enough; a point within them is nearest to the nearer wall or the floor.
  const Eigen::Vector3d local = bin.T_scene_bin.inverse() * point;
  const Eigen::Vector3d at(std::abs(local.x()), std::abs(local.y()), local.z());
  const Eigen::Vector3d half(0.5 * bin.size.x(), 0.5 * bin.size.y(), bin.size.z());
  const auto from = [&at](const Eigen::Vector3d& low, const Eigen::Vector3d& high)
  { return (low - at).cwiseMax(at - high).cwiseMax(0.0).norm(); };
  const double w = bin.wall;
  return std::min({ from({ 0.0, 0.0, -w }, { half.x() + w, half.y() + w, 0.0 }),
    from({ half.x(), 0.0, 0.0 }, { half.x() + w, half.y() + w, half.z() }),
    from({ 0.0, half.y(), 0.0 }, { half.x(), half.y() + w, half.z() }) });
}

void requireBin(const Bin& bin)
{
  const Eigen::Matrix3d R = bin.T_scene_bin.linear();
  if (!bin.T_scene_bin.matrix().allFinite() || !(R.transpose() * R).isIdentity(1e-6) || R.determinant() < 0.0)
  {
    throw Error("The bin's frame is not a rotation and a translation.");
  }
  if (!bin.size.allFinite() || !(bin.size.minCoeff() > 0.0) || !(bin.wall > 0.0) || !std::isfinite(bin.wall))
  {
    throw Error("The bin's length, width, height and wall must be larger than 0 mm.");
  }
}
}
