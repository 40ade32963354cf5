// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/CommonDifferences.h"

#include "base/Parallel.h"
#include "base/sequences/Sequences.h"
#include "model/body/SurroundingPatches.h"
#include "pose/objective/BodyOverlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

namespace meam
{
namespace
{
constexpr double OnPart = 0.02;          // of the diameter: surface so near to the part is the part's,
constexpr double OnPartNoises = 2.0;     // or so near in standard deviations of the scan's noise
constexpr double LeastFacing = 0.35;     // cosine towards the sensor: flatter surface is measured badly
constexpr int PointsOfPatch = 2;         // and no fewer show it on a copy
constexpr double CopiesOfPatch = 4.0;    // show it: fewer may be wrong at the same place,
constexpr double ShareOfCopies = 0.25;   // and of all of them what is beside it: anything may lie beside fewer
constexpr double MostOfCopies = 0.5;     // of them, on which a patch differs
constexpr std::size_t MostTurns = 2;     // under which a part looks the same: more would find one for any difference
constexpr int PatchesOfRing = 2;         // at least, and what chance makes does not go around a part
constexpr int DifferentByChance = 1;     // and one more of so many that are told of:
constexpr int ToldOfEachDifferent = 100; // of right parts two of four hundred were, at most

// Beside the part, in diameters
constexpr double SmearedPixels = 5.0; // off the part at least: so far sensors carry a face beyond its rim
constexpr float SameFace = 0.01f;     // off a face: on what goes on from it, or so near by the noise,
constexpr float MostSameFace = 0.04f; // and no more along the line of sight: else what lies behind may seem to be on it
constexpr double MostApart = 1.2;     // from middle to middle of a copy that may lie beside
constexpr float OfBin = 0.03f;        // off the bin's floor or a wall

/// Points of a patch on one copy.
struct PatchPoints
{
  int asPart = 0; ///< or measured at a rim
  int different = 0, hidden = 0;
};

using Patches = std::vector<PatchPoints>; ///< by their numbers

/// What a copy shows.
struct PatchesOfCopy
{
  Patches ofPart, beside, before; ///< the last of rings alone
};

using KindOfPatches = Patches PatchesOfCopy::*;

/// Whether the sensor saw past a point in all cells about its own, too. `behind`: mm along the line of sight.
bool isClearAbout(const Eigen::Vector3f& point, const Eigen::Vector3f& towards, float behind, const FineDepth& depth)
{
  const std::array<int, 4> cells = depth.neighboursOf(depth.cellAt(point));
  return std::all_of(cells.begin(), cells.end(),
    [&](int cell)
    {
      const Eigen::Vector3f* mean = cell < 0 ? nullptr : depth.meanIn(cell);
      return !mean || (point - *mean).dot(towards) > behind;
    });
}

/// What copies show of the part, and beside it.
class CopiesInSight
{
public:
  CopiesInSight(const Poses& beside, const Scene& scene, const TrainedModel& model, int threads)
    : Others(beside)
    , InScene(scene)
    , Model(model)
    , Noise(static_cast<float>(OnPartNoises * scene.quality.noise))
    , Face(std::max(SameFace * static_cast<float>(model.diameter), this->Noise))
    , OfPart(model.surroundings->of(model, SmearedPixels * scene.depth.pitch(), threads))
  {
  }

  /// `others`: what lies beside, of lyingBeside().
  PatchesOfCopy at(const Eigen::Isometry3d& T_scene_model, const std::vector<Eigen::Isometry3f>& others) const
  {
    const Patches none(this->OfPart->count);
    PatchesOfCopy patches{ none, none, none };
    const Eigen::Isometry3f T = T_scene_model.cast<float>();
    const Eigen::Vector3f towards = this->Model.visibility->towards(T_scene_model, this->InScene.sensor);
    const float onPart = std::max(static_cast<float>(OnPart * this->Model.diameter), this->Noise);
    for (const int i : this->Model.visibility->samplesInSight(T_scene_model, this->InScene.sensor, LeastFacing))
    {
      const float facing = this->Model.surface.normals[i].dot(towards);
      const int patch = this->OfPart->ofSamples[i];
      this->addPart(T * this->Model.surface.points[i], T.linear() * towards, onPart / facing, patches.ofPart[patch]);
      if (this->OfPart->isRing[patch])
      {
        this->addBefore(T * this->Model.surface.points[i], others, onPart / facing, patches.before[patch]);
      }
      if (this->Face / facing <= MostSameFace * static_cast<float>(this->Model.diameter))
      {
        for (int k = this->OfPart->begins[i]; k < this->OfPart->begins[i + 1]; ++k)
        {
          this->addBeside(
            T * this->OfPart->beside[k], others, this->Face / facing, patches.beside[this->OfPart->ofBeside[k]]);
        }
      }
    }
    return patches;
  }

  /// Of the others, T_model_scene.
  std::vector<Eigen::Isometry3f> lyingBeside(const Eigen::Isometry3d& T_scene_model) const
  {
    const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
    std::vector<Eigen::Isometry3f> beside;
    for (const Pose& other : this->Others)
    {
      const Eigen::Isometry3d& T = other.T_scene_model;
      if (translationError(T, T_scene_model, middle) < MostApart * this->Model.diameter &&
          !bodiesOverlap(this->Model, T, T_scene_model))
      {
        beside.push_back(T.inverse().cast<float>());
      }
    }
    return beside;
  }

  const std::vector<char>& isRing() const { return this->OfPart->isRing; }

private:
  void addPart(const Eigen::Vector3f& point, const Eigen::Vector3f& towards, float behind, PatchPoints& patch) const
  {
    const DepthGrid::Relation relation = this->InScene.fineDepth.relation(point, behind);
    const bool isInFront = relation == DepthGrid::Relation::InFront;
    const bool isPast = isInFront && isClearAbout(point, towards, behind, this->InScene.fineDepth);
    patch.different += isPast;
    patch.asPart += relation == DepthGrid::Relation::OnSurface || (isInFront && !isPast);
    patch.hidden += relation == DepthGrid::Relation::Hidden;
  }

  void addBeside(const Eigen::Vector3f& point, const std::vector<Eigen::Isometry3f>& others, float tolerance,
    PatchPoints& patch) const
  {
    const DepthGrid::Relation relation = this->InScene.fineDepth.relation(point, tolerance);
    const bool isSurface = relation == DepthGrid::Relation::OnSurface;
    const bool isExplained = isSurface && this->isOfOther(point, others, tolerance);
    patch.different += isSurface && !isExplained;
    patch.asPart += relation == DepthGrid::Relation::InFront;
    patch.hidden += relation == DepthGrid::Relation::Hidden || isExplained;
  }

  void addBefore(
    const Eigen::Vector3f& point, const std::vector<Eigen::Isometry3f>& others, float behind, PatchPoints& patch) const
  {
    const FineDepth& depth = this->InScene.fineDepth;
    const DepthGrid::Relation relation = depth.relation(point, behind);
    const bool isHidden = relation == DepthGrid::Relation::Hidden;
    const int cell = isHidden ? depth.cellAt(point) : -1;
    const Eigen::Vector3f* mean = cell < 0 ? nullptr : depth.meanIn(cell);
    const bool isExplained = isHidden && (!mean || this->isOfOther(*mean, others, behind));
    patch.different += isHidden && !isExplained;
    patch.asPart += relation == DepthGrid::Relation::OnSurface || relation == DepthGrid::Relation::InFront;
    patch.hidden += isExplained;
  }

  /// Whether a point is of the bin or lies on another copy. `tolerance`: mm, what was measured may be off it.
  bool isOfOther(const Eigen::Vector3f& point, const std::vector<Eigen::Isometry3f>& others, float tolerance) const
  {
    const float diameter = static_cast<float>(this->Model.diameter);
    const float near = std::min(std::max(static_cast<float>(OnPart) * diameter, tolerance),
      NearlyFarthest * static_cast<float>(FieldReach) * diameter);
    const auto& planes = this->InScene.enclosure;
    return std::any_of(planes.begin(), planes.end(),
             [&](const Plane& plane) { return std::abs(plane.signedDistance(point)) < OfBin * diameter; }) ||
           std::any_of(others.begin(), others.end(),
             [&](const Eigen::Isometry3f& other) { return this->Model.surfaceDistance.at(other * point) < near; });
  }

  const Poses& Others;
  const Scene& InScene;
  const TrainedModel& Model;
  float Noise, Face; ///< mm
  std::shared_ptr<const PartPatches> OfPart;
};

/// How much of a patch is told to differ by the points of it that a copy shows; nothing where it shows too few.
std::optional<double> differenceIn(const PatchPoints& points)
{
  const int seen = points.asPart + points.different;
  return seen >= PointsOfPatch && seen > points.hidden ? std::optional(static_cast<double>(points.different) / seen)
                                                       : std::nullopt;
}

/// By the numbers of the patches, one kind behind another.
std::vector<double> differencesOf(const PatchesOfCopy& patches)
{
  std::vector<double> differences;
  for (const KindOfPatches kind : { &PatchesOfCopy::ofPart, &PatchesOfCopy::beside, &PatchesOfCopy::before })
  {
    for (const PatchPoints& points : patches.*kind)
    {
      differences.push_back(differenceIn(points).value_or(0.0));
    }
  }
  return differences;
}

/// By copies the patches as they are turned.
using TurnsOfCopies = std::vector<std::vector<PatchesOfCopy>>;

/// Of each copy the turn in which it differs where those before it do.
std::vector<PatchesOfCopy> turnedAlike(const TurnsOfCopies& copies)
{
  std::vector<PatchesOfCopy> alike;
  std::vector<double> sum(differencesOf(copies.front().front()).size());
  for (const std::vector<PatchesOfCopy>& turns : copies)
  {
    const auto differences = mapped<std::vector<double>>(turns, differencesOf);
    const auto agreements = mapped<double>(differences,
      [&](const std::vector<double>& one) { return std::inner_product(one.begin(), one.end(), sum.begin(), 0.0); });
    const auto best = std::max_element(agreements.begin(), agreements.end()) - agreements.begin();
    std::transform(sum.begin(), sum.end(), differences[best].begin(), sum.begin(), std::plus<>());
    alike.push_back(turns[best]);
  }
  return alike;
}

/// Patches of a kind that differ on most of the copies that show them, so many at least, beyond chance.
int differentOnMost(
  const std::vector<PatchesOfCopy>& ofCopies, KindOfPatches kind, double least, const std::vector<char>& isRing)
{
  struct Copies
  {
    int showing = 0;
    double different = 0.0;
  };
  std::vector<Copies> patches(isRing.size());
  for (const PatchesOfCopy& ofCopy : ofCopies)
  {
    for (std::size_t k = 0; k < patches.size(); ++k)
    {
      if (const std::optional<double> difference = differenceIn((ofCopy.*kind)[k]))
      {
        ++patches[k].showing;
        patches[k].different += *difference;
      }
    }
  }
  int told = 0, different = 0;
  for (std::size_t k = 0; k < patches.size(); ++k)
  {
    const Copies& copies = patches[k];
    const bool isTold = copies.showing >= least;
    told += isTold;
    if (isTold && copies.different > MostOfCopies * copies.showing)
    {
      different += isRing[k] ? PatchesOfRing : 1;
    }
  }
  return std::max(different - DifferentByChance - (told + ToldOfEachDifferent / 2) / ToldOfEachDifferent, 0);
}
}

CommonDifferences commonDifferences(
  const Poses& poses, const Poses& mayBeThere, const Scene& scene, const TrainedModel& model, int threads)
{
  if (poses.size() < CopiesOfPatch)
  {
    return {};
  }
  const CopiesInSight copies(mayBeThere, scene, model, threads);
  std::vector<Eigen::Isometry3d> turns{ Eigen::Isometry3d::Identity() };
  if (model.symmetries.discrete.size() < MostTurns)
  {
    turns.insert(turns.end(), model.symmetries.discrete.begin(), model.symmetries.discrete.end());
  }
  TurnsOfCopies ofCopies(poses.size());
  parallelForEach(static_cast<int>(poses.size()), threads, {},
    [&](int i)
    {
      const Eigen::Isometry3d& T = poses[i].T_scene_model;
      const std::vector<Eigen::Isometry3f> others = copies.lyingBeside(T);
      ofCopies[i] =
        mapped<PatchesOfCopy>(turns, [&](const Eigen::Isometry3d& turn) { return copies.at(T * turn, others); });
    });
  const auto asFound =
    mapped<PatchesOfCopy>(ofCopies, [](const std::vector<PatchesOfCopy>& turns) { return turns.front(); });
  const std::vector<PatchesOfCopy> alike = turns.size() > 1 ? turnedAlike(ofCopies) : std::vector<PatchesOfCopy>();
  const auto different = [&](KindOfPatches kind, double least)
  {
    const double leastAlike = least * static_cast<double>(turns.size());
    return std::max(differentOnMost(asFound, kind, least, copies.isRing()),
      differentOnMost(alike, kind, leastAlike, copies.isRing()));
  };
  const double leastBeside = std::max(CopiesOfPatch, ShareOfCopies * static_cast<double>(poses.size()));
  return { different(&PatchesOfCopy::ofPart, CopiesOfPatch),
    different(&PatchesOfCopy::beside, leastBeside) + different(&PatchesOfCopy::before, leastBeside) };
}
}
