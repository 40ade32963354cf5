// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/RotationSearch.h"

#include "base/sequences/Sequences.h"
#include "pose/PoseTolerances.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr int Steps = 180;              // of a full turn about an axis: 2 degrees, less than a notch
constexpr double LeastGain = 1.0;       // scene edge points that a better rotation explains more, and
constexpr double LeastGainShare = 0.02; // of what the pose as it is explains
constexpr int MostPoints = 200;         // of the scene's edges on the part that are looked at
constexpr int CoarseStride = 4;         // of these one of so many is looked at first
constexpr int MostMaxima = 10;          // of the coarse search that all points are asked about
constexpr int MostRotations = 2;        // that come out of an axis

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

RotationSearch::RotationSearch(const Scene& scene, const TrainedModel& model)
  : InScene(scene)
  , Model(model)
  , Unexplained(static_cast<float>(UnexplainedDistance * model.diameter))
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
  return everyOf(edges, (edges.size() + MostPoints - 1) / MostPoints);
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
  const SoAPoints few = everyOf(some, CoarseStride);
  for (const ContinuousSymmetry& axis : this->Axes)
  {
    const auto turn = [&](int step) { return turnAbout(axis.axis, 2.0 * M_PI * step / Steps, axis.point); };
    const auto explained = [&](int step, const SoAPoints& edges) { return this->explained(edges, turn(step)); };
    // Maxima by some of the points, which then all are asked about.
    const auto coarse = ofIndices<double>(Steps, [&](int step) { return explained(step, few); });
    std::vector<int> maxima;
    for (int step = 2; step < Steps - 1; ++step)
    {
      if (coarse[step] > coarse[step - 1] && coarse[step] >= coarse[(step + 1) % Steps])
      {
        maxima.push_back(step);
      }
    }
    std::stable_sort(maxima.begin(), maxima.end(), [&](int a, int b) { return coarse[a] > coarse[b]; });
    maxima.resize(std::min<std::size_t>(maxima.size(), MostMaxima));
    const double asItIs = std::max({ explained(-1, some), explained(0, some), explained(1, some) });
    const double least = asItIs + LeastGain + LeastGainShare * asItIs;
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
      if (!known && static_cast<int>(taken.size()) < MostRotations)
      {
        taken.push_back(step);
        found.push_back(T_scene_model * turn(step));
      }
    }
  }
  return found;
}
}
