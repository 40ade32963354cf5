// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/RotationSearch.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
SoAPoints everyOf(const SoAPoints& points, std::size_t stride)
{
  SoAPoints result;
  for (std::size_t k = 0; k < points.size(); k += stride)
  {
    result.add(points[k]);
  }
  return result;
}
}

RotationSearch::RotationSearch(const Scene& scene, const TrainedModel& model, const RotationSearchSettings& settings)
  : InScene(scene)
  , Model(model)
  , Settings(settings)
  , Unexplained(static_cast<float>(settings.lengths.unexplained * model.diameter))
  , Axes(nearlyRoundAxes(model.symmetries))
{
}

SoAPoints RotationSearch::edgesOn(const Eigen::Isometry3d& T_scene_model) const
{
  const TrainedModel& model = this->Model;
  const DistanceField& whole = model.surface.empty() ? model.edgeDistance : model.surfaceDistance;
  const Eigen::Isometry3f toModel = T_scene_model.inverse().cast<float>();
  const PointGrid& measured = this->InScene.edgeGrid();
  SoAPoints edges;
  measured.forEachBlock(T_scene_model.cast<float>() * whole.middle(), whole.radius(),
    [&](int begin, int count)
    {
      float distances[SoABlock];
      whole.at(toModel, measured.sorted(), begin, count, distances);
      for (int k = 0; k < count; ++k)
      {
        if (model.surface.empty() || distances[k] < this->Unexplained)
        {
          const Eigen::Vector3f point = toModel * measured.sorted()[begin + k];
          if ((point - whole.middle()).norm() <= whole.radius()) // blocks reach beyond the ball about the part
          {
            edges.add(point);
          }
        }
      }
    });
  return everyOf(edges, (edges.size() + this->Settings.points - 1) / this->Settings.points);
}

double RotationSearch::explained(const SoAPoints& edges, const Eigen::Isometry3d& turn) const
{
  thread_local std::vector<float> distances; // for hundreds of turns
  distances.resize(edges.size());
  this->Model.edgeDistance.at(turn.inverse().cast<float>(), edges, 0, static_cast<int>(edges.size()), distances.data());
  double sum = 0.0;
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    sum += std::max(0.0f, 1.0f - distances[k] / this->Unexplained);
  }
  return sum;
}

Eigen::Isometry3d RotationSearch::likeliest(const Eigen::Isometry3d& T_scene_model) const
{
  if (this->Model.symmetries.near.empty())
  {
    return T_scene_model;
  }
  const SoAPoints edges = this->edgesOn(T_scene_model);
  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  double most = this->explained(edges, best);
  for (const NearSymmetry& symmetry : this->Model.symmetries.near)
  {
    const double sum = this->explained(edges, symmetry.T);
    if (sum > most)
    {
      most = sum;
      best = symmetry.T;
    }
  }
  return T_scene_model * best;
}

std::vector<Eigen::Isometry3d> RotationSearch::better(const Eigen::Isometry3d& T_scene_model) const
{
  std::vector<Eigen::Isometry3d> found;
  if (this->Axes.empty())
  {
    return found;
  }
  const SoAPoints some = this->edgesOn(T_scene_model);
  const int steps = this->Settings.steps;
  const SoAPoints few = everyOf(some, this->Settings.coarseStride);
  for (const ContinuousSymmetry& axis : this->Axes)
  {
    const auto turn = [&](int step) { return turnAbout(axis.axis, 2.0 * M_PI * step / steps, axis.point); };
    const auto explained = [&](int step, const SoAPoints& edges) { return this->explained(edges, turn(step)); };
    // Maxima by some of the points, which then all are asked about.
    std::vector<double> coarse(steps);
    for (int step = 0; step < steps; ++step)
    {
      coarse[step] = explained(step, few);
    }
    std::vector<int> maxima;
    for (int step = 2; step < steps - 1; ++step)
    {
      if (coarse[step] > coarse[step - 1] && coarse[step] >= coarse[(step + 1) % steps])
      {
        maxima.push_back(step);
      }
    }
    std::stable_sort(maxima.begin(), maxima.end(), [&](int a, int b) { return coarse[a] > coarse[b]; });
    maxima.resize(std::min<std::size_t>(maxima.size(), this->Settings.maxima));
    const double asItIs = std::max({ explained(-1, some), explained(0, some), explained(1, some) });
    const double least = asItIs + this->Settings.leastGain + this->Settings.leastGainShare * asItIs;
    std::vector<std::pair<double, int>> better;
    for (const int peak : maxima)
    {
      std::pair<double, int> best{ 0.0, peak };
      for (const int step : { peak - 1, peak, peak + 1 })
      {
        best = std::max(best, { explained(step, some), step });
      }
      if (best.first > least)
      {
        better.push_back(best);
      }
    }
    std::stable_sort(better.begin(), better.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<int> taken;
    for (const auto& [gain, step] : better)
    {
      const bool known =
        std::any_of(taken.begin(), taken.end(), [step = step](int other) { return std::abs(step - other) <= 1; });
      if (!known && static_cast<int>(taken.size()) < this->Settings.rotations)
      {
        taken.push_back(step);
        found.push_back(T_scene_model * turn(step));
      }
    }
  }
  return found;
}
}
