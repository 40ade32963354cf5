// SPDX-License-Identifier: BSD-3-Clause
#include "model/body/SurroundingPatches.h"

#include "base/Parallel.h"
#include "base/sequences/Sequences.h"
#include "model/body/BodyInterior.h"
#include "model/TrainedModel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace meam
{
namespace
{
constexpr double PatchSide = 0.06;     // of the diameter: about ten samples of the surface
constexpr int Ways = 8;                // from a sample along its face
constexpr int Steps = 4;               // in each
constexpr float Step = 0.01f;          // of the diameter, from where the distance field ends
constexpr double FurtherStep = 0.0025; // of the diameter: about what scans of one sensor differ by
constexpr std::size_t MostMade = 8;    // a megabyte each, for steps beside each other, as parts lie nearer and farther

using Cell = std::array<int, 3>;

/// The cell of a point: of a round part a ring, for its copies are turned by any angle.
Cell cellOf(const Eigen::Vector3f& point, const Symmetries& symmetries, double side)
{
  Eigen::Vector3d place = point.cast<double>();
  if (!symmetries.continuous.empty())
  {
    const auto& [axis, foot] = symmetries.continuous.front();
    const double along = (place - foot).dot(axis);
    place = Eigen::Vector3d(along, (place - foot - along * axis).norm(), 0.0);
  }
  const Eigen::Array3i cell = (place.array() / side).floor().cast<int>();
  return { cell.x(), cell.y(), cell.z() };
}

/// Along the face of a sample.
std::array<Eigen::Vector3f, Ways> waysFrom(const Eigen::Vector3f& normal)
{
  const Eigen::Vector3f across = normal.unitOrthogonal(), other = normal.cross(across);
  std::array<Eigen::Vector3f, Ways> ways;
  for (int way = 0; way < Ways; ++way)
  {
    const float angle = static_cast<float>(2.0 * M_PI * way / Ways);
    ways[way] = std::cos(angle) * across + std::sin(angle) * other;
  }
  return ways;
}

bool isBeside(const TrainedModel& model, const Eigen::Vector3f& point)
{
  return model.surfaceDistance.at(point) > NearlyFarthest * static_cast<float>(FieldReach * model.diameter);
}

/// mm along the face of a sample.
float distanceOf(int step, const TrainedModel& model)
{
  return (static_cast<float>(FieldReach) + static_cast<float>(step) * Step) * static_cast<float>(model.diameter);
}

std::vector<std::uint8_t> findSteps(const TrainedModel& model, int threads)
{
  std::vector<std::uint8_t> steps(Ways * model.surface.size());
  parallelForEach(static_cast<int>(model.surface.size()), threads, {},
    [&](int i)
    {
      const std::array<Eigen::Vector3f, Ways> ways = waysFrom(model.surface.normals[i]);
      for (int way = 0; way < Ways; ++way)
      {
        int step = 0;
        while (step < Steps && !isBeside(model, model.surface.points[i] + distanceOf(step, model) * ways[way]))
        {
          ++step;
        }
        steps[static_cast<std::size_t>(i) * Ways + way] = static_cast<std::uint8_t>(step);
      }
    });
  return steps;
}

/// Places beside each sample, `further` (mm) than its face ends.
std::vector<Points> besideSamples(
  const TrainedModel& model, const std::vector<std::uint8_t>& steps, float further, int threads)
{
  std::vector<Points> beside(model.surface.size());
  parallelForEach(static_cast<int>(beside.size()), threads, {},
    [&](int i)
    {
      const std::array<Eigen::Vector3f, Ways> ways = waysFrom(model.surface.normals[i]);
      for (int way = 0; way < Ways; ++way)
      {
        const int step = steps[static_cast<std::size_t>(i) * Ways + way];
        const Eigen::Vector3f point = model.surface.points[i] + (distanceOf(step, model) + further) * ways[way];
        if (step < Steps && isBeside(model, point) && !model.interior->isDeep(point))
        {
          beside[i].push_back(point);
        }
      }
    });
  return beside;
}

PartPatches patchesOf(const TrainedModel& model, const std::vector<std::uint8_t>& steps, float further, int threads)
{
  PartPatches patches;
  std::map<Cell, int> numbers;
  const auto numberOf = [&](const Eigen::Vector3f& point)
  {
    const Cell cell = cellOf(point, model.symmetries, PatchSide * model.diameter);
    const auto [place, isNew] = numbers.emplace(cell, static_cast<int>(numbers.size()));
    if (isNew)
    {
      patches.isRing.push_back(!model.symmetries.continuous.empty() && cell[1] > 0);
    }
    return place->second;
  };
  patches.ofSamples = mapped<int>(model.surface.points, numberOf);
  patches.begins.push_back(0);
  for (const Points& places : besideSamples(model, steps, further, threads))
  {
    patches.beside.insert(patches.beside.end(), places.begin(), places.end());
    patches.begins.push_back(static_cast<int>(patches.beside.size()));
  }
  patches.ofBeside = mapped<int>(patches.beside, numberOf);
  patches.count = static_cast<int>(numbers.size());
  return patches;
}
}

SurroundingPatches::SurroundingPatches(std::vector<std::uint8_t> steps)
  : Found(std::move(steps))
{
}

const std::vector<std::uint8_t>& SurroundingPatches::steps(const TrainedModel& model, int threads) const
{
  const std::lock_guard<std::mutex> lock(this->Finding);
  if (this->Found.size() != Ways * model.surface.size())
  {
    this->Found = findSteps(model, threads);
  }
  return this->Found;
}

std::shared_ptr<const PartPatches> SurroundingPatches::of(const TrainedModel& model, double distance, int threads) const
{
  const double step = FurtherStep * model.diameter;
  const int farther = static_cast<int>(std::ceil(std::max(distance - FieldReach * model.diameter, 0.0) / step));
  const std::lock_guard<std::mutex> lock(this->Making);
  const auto made = this->Made.find(farther);
  if (made != this->Made.end())
  {
    return made->second;
  }
  if (this->Made.size() >= MostMade)
  {
    this->Made.clear();
  }
  return this->Made[farther] = std::make_shared<const PartPatches>(
           patchesOf(model, this->steps(model, threads), static_cast<float>(farther * step), threads));
}
}
