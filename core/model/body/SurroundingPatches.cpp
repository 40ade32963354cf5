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

/// Places beside each sample, `further` (mm) than its face ends.
std::vector<Points> besideSamples(const TrainedModel& model, float further, int threads)
{
  const float diameter = static_cast<float>(model.diameter);
  const float reach = static_cast<float>(FieldReach) * diameter;
  const auto isBeside = [&](const Eigen::Vector3f& point)
  { return model.surfaceDistance.at(point) > NearlyFarthest * reach; };
  std::vector<Points> beside(model.surface.size());
  parallelForEach(static_cast<int>(beside.size()), threads, {},
    [&](int i)
    {
      const Eigen::Vector3f& normal = model.surface.normals[i];
      const Eigen::Vector3f across = normal.unitOrthogonal(), other = normal.cross(across);
      for (int way = 0; way < Ways; ++way)
      {
        const float angle = static_cast<float>(2.0 * M_PI * way / Ways);
        const Eigen::Vector3f along = std::cos(angle) * across + std::sin(angle) * other;
        float distance = reach;
        int step = 0;
        for (; step < Steps && !isBeside(model.surface.points[i] + distance * along); ++step)
        {
          distance += Step * diameter;
        }
        const Eigen::Vector3f point = model.surface.points[i] + (distance + further) * along;
        if (step < Steps && isBeside(point) && !model.interior->isDeep(point))
        {
          beside[i].push_back(point);
        }
      }
    });
  return beside;
}

PartPatches patchesOf(const TrainedModel& model, float further, int threads)
{
  PartPatches patches;
  std::map<Cell, int> numbers;
  const auto numberOf = [&](const Eigen::Vector3f& point)
  {
    const Cell cell = cellOf(point, model.symmetries, PatchSide * model.diameter);
    return numbers.emplace(cell, static_cast<int>(numbers.size())).first->second;
  };
  patches.ofSamples = mapped<int>(model.surface.points, numberOf);
  patches.begins.push_back(0);
  for (const Points& places : besideSamples(model, further, threads))
  {
    patches.beside.insert(patches.beside.end(), places.begin(), places.end());
    patches.begins.push_back(static_cast<int>(patches.beside.size()));
  }
  patches.ofBeside = mapped<int>(patches.beside, numberOf);
  patches.count = static_cast<int>(numbers.size());
  return patches;
}
}

std::shared_ptr<const PartPatches> SurroundingPatches::of(const TrainedModel& model, double distance, int threads) const
{
  const double step = FurtherStep * model.diameter;
  const double further = std::max(distance - FieldReach * model.diameter, 0.0);
  const std::lock_guard<std::mutex> lock(this->Making);
  const int steps = static_cast<int>(std::ceil(further / step));
  const auto made = this->Made.find(steps);
  if (made != this->Made.end())
  {
    return made->second;
  }
  if (this->Made.size() >= MostMade)
  {
    this->Made.clear();
  }
  return this->Made[steps] =
           std::make_shared<const PartPatches>(patchesOf(model, static_cast<float>(steps * step), threads));
}
}
