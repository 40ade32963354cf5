// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/CommonDifferences.h"

#include "base/Parallel.h"
#include "model/body/SurroundingPatches.h"
#include "pose/objective/BodyOverlap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meam
{
namespace
{
constexpr double OnPart = 0.02;          // of the diameter: surface so near to the part is the part's,
constexpr double OnPartNoises = 2.0;     // or so near in standard deviations of the scan's noise
constexpr double LeastFacing = 0.35;     // cosine towards the sensor: flatter surface is measured badly
constexpr int PointsOfPatch = 2;         // and no fewer show it on a copy
constexpr int CopiesOfPatch = 4;         // show it: fewer may be wrong at the same place,
constexpr double ShareOfCopies = 0.25;   // and fewer of all of them lie in one way
constexpr double MostOfCopies = 0.5;     // of them, on which a patch differs
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
  CopiesInSight(const Poses& poses, const Poses& beside, const Scene& scene, const TrainedModel& model, int threads)
    : Copies(poses)
    , Others(beside)
    , InScene(scene)
    , Model(model)
    , Noise(static_cast<float>(OnPartNoises * scene.quality.noise))
    , Face(std::max(SameFace * static_cast<float>(model.diameter), this->Noise))
    , OfPart(model.surroundings->of(model, SmearedPixels * scene.depth.pitch(), threads))
  {
  }

  void collect(int copy, Patches& ofPart, Patches& beside, Patches& before) const
  {
    for (Patches* patches : { &ofPart, &beside, &before })
    {
      patches->resize(this->OfPart->count);
    }
    const Pose& pose = this->Copies[copy];
    const std::vector<Eigen::Isometry3f> others = this->lyingBeside(pose.T_scene_model);
    const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
    const Eigen::Vector3f towards = this->Model.visibility->towards(pose.T_scene_model, this->InScene.sensor);
    const float onPart = std::max(static_cast<float>(OnPart * this->Model.diameter), this->Noise);
    for (const int i : this->Model.visibility->samplesInSight(pose.T_scene_model, this->InScene.sensor, LeastFacing))
    {
      const float facing = this->Model.surface.normals[i].dot(towards);
      const int patch = this->OfPart->ofSamples[i];
      this->addPart(T * this->Model.surface.points[i], T.linear() * towards, onPart / facing, ofPart[patch]);
      if (this->OfPart->isRing[patch])
      {
        this->addBefore(T * this->Model.surface.points[i], others, onPart / facing, before[patch]);
      }
      if (this->Face / facing <= MostSameFace * static_cast<float>(this->Model.diameter))
      {
        for (int k = this->OfPart->begins[i]; k < this->OfPart->begins[i + 1]; ++k)
        {
          this->addBeside(T * this->OfPart->beside[k], others, this->Face / facing, beside[this->OfPart->ofBeside[k]]);
        }
      }
    }
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

  const Poses& Copies;
  const Poses& Others;
  const Scene& InScene;
  const TrainedModel& Model;
  float Noise, Face; ///< mm
  std::shared_ptr<const PartPatches> OfPart;
};

/// Patches that differ on most copies, beyond chance.
int differentOnMost(const std::vector<Patches>& ofCopies, const std::vector<char>& isRing)
{
  struct Copies
  {
    int showing = 0;
    double different = 0.0;
  };
  std::vector<Copies> patches(ofCopies.front().size());
  for (const Patches& ofCopy : ofCopies)
  {
    for (std::size_t k = 0; k < patches.size(); ++k)
    {
      const PatchPoints& points = ofCopy[k];
      const int seen = points.asPart + points.different;
      if (seen >= PointsOfPatch && seen > points.hidden)
      {
        ++patches[k].showing;
        patches[k].different += static_cast<double>(points.different) / seen;
      }
    }
  }
  const double all = static_cast<double>(ofCopies.size());
  int told = 0, different = 0;
  for (std::size_t k = 0; k < patches.size(); ++k)
  {
    const Copies& copies = patches[k];
    const bool isTold = copies.showing >= std::max<double>(CopiesOfPatch, ShareOfCopies * all);
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
  const CopiesInSight copies(poses, mayBeThere, scene, model, threads);
  std::vector<Patches> ofPart(poses.size()), beside(poses.size()), before(poses.size());
  parallelForEach(
    static_cast<int>(poses.size()), threads, {}, [&](int i) { copies.collect(i, ofPart[i], beside[i], before[i]); });
  return { differentOnMost(ofPart, copies.isRing()),
    differentOnMost(beside, copies.isRing()) + differentOnMost(before, copies.isRing()) };
}
}
