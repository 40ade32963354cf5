// SPDX-License-Identifier: BSD-3-Clause
#include "pick/proposal/GraspSpread.h"

#include "base/sequences/Sequences.h"
#include "pick/GraspTurns.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double TurnApart = 40.0; // degrees, between grasps at one place; less than the step between approaches
constexpr double Crowding = 0.8;   // times its worth for each grasp taken at its place, and for each with its way in
/// The frames at which a grasp is as good.
std::vector<Eigen::Isometry3d> equalFrames(
  const Grasp& grasp, const std::vector<Eigen::Isometry3d>& symmetric, double step, double size)
{
  std::vector<Eigen::Isometry3d> frames = framesOf(grasp, symmetric, step, size);
  if (grasp.kind == GraspKind::Parallel) // the jaws have changed places
  {
    const std::size_t count = frames.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      frames.push_back(frames[k] * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));
    }
  }
  return frames;
}

/// A grasp that may be taken.
struct Candidate
{
  const Grasp* grasp;
  double worth;
};

/// How a grasp lies to those that are as good as one that was taken.
struct Nearness
{
  bool same = false;  ///< near, and facing the same way
  bool place = false; ///< near
  bool wayIn = false; ///< with nearly the same approach
};

Nearness nearnessOf(
  const Eigen::Isometry3d& frame, const std::vector<Eigen::Isometry3d>& taken, double spread, double angle)
{
  const double leastTrace = 1.0 + 2.0 * std::cos(angle);
  const double leastCosine = std::cos(angle);
  Nearness result;
  for (const Eigen::Isometry3d& other : taken)
  {
    const bool near = (other.translation() - frame.translation()).squaredNorm() < spread * spread;
    result.place = result.place || near;
    result.wayIn = result.wayIn || other.linear().col(2).dot(frame.linear().col(2)) > leastCosine;
    result.same = result.same || (near && other.linear().cwiseProduct(frame.linear()).sum() > leastTrace);
  }
  return result;
}
}

Grasps spreadOut(const Grasps& all, const Symmetries& symmetries, double spread, double size, int most,
  const std::function<FreeTurn(const Grasp&)>& freeTurnOf, const Progress& progress)
{
  const std::vector<Eigen::Isometry3d> symmetric = turnsOf(symmetries, GraspTurnStep);
  const double angle = TurnApart * M_PI / 180.0;
  auto open = mapped<Candidate>(all, [&](const Grasp& grasp) { return Candidate{ &grasp, grasp.quality }; });
  Grasps taken;
  while (!open.empty() && static_cast<int>(taken.size()) < most)
  {
    report(progress, static_cast<double>(taken.size()) / most);
    const auto best = std::max_element(
      open.begin(), open.end(), [](const Candidate& a, const Candidate& b) { return a.worth < b.worth; }); // the first
    taken.push_back(*best->grasp);
    taken.back().freeTurn = freeTurnOf(taken.back());
    const std::vector<Eigen::Isometry3d> frames = equalFrames(taken.back(), symmetric, GraspTurnStep, size);
    std::vector<Candidate> rest;
    for (const Candidate& candidate : open)
    {
      const Nearness near = nearnessOf(candidate.grasp->T_model_grasp, frames, spread, angle);
      if (!near.same && candidate.grasp != best->grasp)
      {
        const double worth = candidate.worth * (near.place ? Crowding : 1.0) * (near.wayIn ? Crowding : 1.0);
        rest.push_back({ candidate.grasp, worth });
      }
    }
    open.swap(rest);
  }
  std::stable_sort(taken.begin(), taken.end(), [](const Grasp& a, const Grasp& b) { return a.quality > b.quality; });
  return taken;
}
}
