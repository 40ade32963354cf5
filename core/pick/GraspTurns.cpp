// SPDX-License-Identifier: BSD-3-Clause
#include "pick/GraspTurns.h"

#include "base/sequences/Sequences.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double SameTurn = 0.02;   // radians
constexpr double SamePlace = 0.001; // of the part's size

/// The turns by a step about an axis, the identity first.
std::vector<Eigen::Isometry3d> turnsAbout(const Eigen::Vector3d& axis, const Eigen::Vector3d& centre, double step)
{
  const int count = std::max(1, static_cast<int>(std::lround(360.0 / step)));
  return ofIndices<Eigen::Isometry3d>(
    count, [&](int k) -> Eigen::Isometry3d { return turnAbout(axis, 2.0 * M_PI * k / count, centre); });
}

}

std::vector<Eigen::Isometry3d> turnsOf(const Symmetries& symmetries, double step)
{
  std::vector<Eigen::Isometry3d> turns{ Eigen::Isometry3d::Identity() };
  turns.insert(turns.end(), symmetries.discrete.begin(), symmetries.discrete.end());
  if (symmetries.continuous.empty())
  {
    return turns;
  }
  std::vector<Eigen::Isometry3d> result;
  const ContinuousSymmetry& round = symmetries.continuous.front();
  for (const auto& about : turnsAbout(round.axis, round.point, step))
  {
    for (const auto& turn : turns)
    {
      result.push_back(about * turn);
    }
  }
  return result;
}

std::vector<Eigen::Isometry3d> framesOf(
  const Grasp& grasp, const std::vector<Eigen::Isometry3d>& symmetric, double step, double size)
{
  std::vector<Eigen::Isometry3d> free{ Eigen::Isometry3d::Identity() };
  if (grasp.freeTurn != FreeTurn::None)
  {
    free = turnsAbout(grasp.freeTurn == FreeTurn::Approach ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX(),
      Eigen::Vector3d::Zero(), step);
  }
  std::vector<Eigen::Isometry3d> frames;
  for (const auto& turned : symmetric)
  {
    for (const auto& turn : free)
    {
      const Eigen::Isometry3d frame = turned * grasp.T_model_grasp * turn;
      const auto same = [&](const Eigen::Isometry3d& other)
      {
        return (frame.translation() - other.translation()).norm() <= SamePlace * size &&
               Eigen::AngleAxisd(frame.linear().transpose() * other.linear()).angle() <= SameTurn;
      };
      if (std::none_of(frames.begin(), frames.end(), same))
      {
        frames.push_back(frame);
      }
    }
  }
  return frames;
}
}
