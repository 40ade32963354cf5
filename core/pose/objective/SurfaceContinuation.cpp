// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/SurfaceContinuation.h"

#include "pose/PoseTolerances.h"
#include "pose/verification/EvidenceCounts.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace meam
{
namespace
{
constexpr double Farthest = 0.12;   // of the diameter: what lies farther may be another body
constexpr int Margin = 2;           // cells beside the part that do not count: sensors smooth across edges
constexpr float SmoothTurn = 0.97f; // cosine between the normals of neighbours on one face: 14 degrees
// How far they lie off each other's plane: so much of the distance between them, 14 degrees, and standard deviations.
constexpr float SmoothSlope = 0.25f;
constexpr float Noises = 2.0f;
constexpr float EdgeReach = 0.03f; // of the diameter: thinned edge points stand up to twice as far apart
static_assert(FitDistance <= FieldReach, "what lies farther off the part than its field reaches is not on it");
}

SurfaceContinuation::SurfaceContinuation(const Scene& scene, const TrainedModel& model)
  : InScene(scene)
  , Model(model)
  , Tolerance(static_cast<float>(FitDistance * model.diameter))
  , Noise(static_cast<float>(scene.quality.noise))
  , IsSheet(model.sheetThickness() < ThickSheet)
  , Reach(static_cast<int>(Farthest * model.diameter / scene.depth.cellSize()))
{
  const double inPatch = scene.depth.cellSize() / (PatchSize * model.diameter);
  this->PatchesOfPoint = inPatch * inPatch;
}

double SurfaceContinuation::unexplained(const Points& beyond, const std::vector<Eigen::Isometry3f>& others) const
{
  const auto isLeft = [&](const Eigen::Vector3f& point)
  { return std::none_of(others.begin(), others.end(), [&](const auto& other) { return this->isOn(point, other); }); };
  return static_cast<double>(std::count_if(beyond.begin(), beyond.end(), isLeft)) * this->PatchesOfPoint;
}

bool SurfaceContinuation::isOfBin(const Eigen::Vector3f& point) const
{
  const std::vector<Plane>& planes = this->InScene.enclosure;
  return std::any_of(planes.begin(), planes.end(),
    [&](const Plane& plane) { return std::abs(plane.signedDistance(point)) < this->Tolerance; });
}

bool SurfaceContinuation::isAtEdge(const Eigen::Vector3f& point) const
{
  return this->IsSheet && this->InScene.edgeGrid().nearest(point, EdgeReach * this->Model.diameter) >= 0;
}

bool SurfaceContinuation::isSmooth(int from, int to) const
{
  const DepthMap& depth = this->InScene.depth;
  const Eigen::Vector3f& a = depth.normalIn(from);
  const Eigen::Vector3f& b = depth.normalIn(to);
  const Eigen::Vector3f between = depth.meanIn(to) - depth.meanIn(from);
  const float most = SmoothSlope * between.norm() + Noises * this->Noise;
  return a.dot(b) > SmoothTurn && std::abs(a.dot(between)) < most && std::abs(b.dot(between)) < most;
}

Points SurfaceContinuation::beyond(const Eigen::Isometry3d& T_scene_model) const
{
  const TrainedModel& model = this->Model;
  const DepthMap& depth = this->InScene.depth;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const Eigen::Isometry3f toModel = T.inverse();
  const auto visible = model.visibility->visible(T_scene_model, this->InScene.sensor, depth.pitch());
  struct Reached
  {
    int steps; // from the part; 0: on it
    int from;  // where the way left the part
  };
  std::unordered_map<int, Reached> cells;
  std::vector<int> reached;
  for (const int i : visible->surface)
  {
    const Eigen::Vector3f point = T * model.surface.points[i];
    const int cell = depth.cellAt(point);
    if (cell >= 0 && depth.isMeasured(cell) && this->isOn(depth.meanIn(cell), toModel) &&
        depth.normalIn(cell).dot(T.linear() * model.surface.normals[i]) >= FacingSurface &&
        cells.emplace(cell, Reached{ 0, cell }).second)
    {
      reached.push_back(cell);
    }
  }
  // Breadth first: what lies on the part, between the points that are looked at, and then what lies beside it.
  Points beyond;
  for (const bool isBeside : { false, true })
  {
    for (std::size_t next = 0; next < reached.size(); ++next)
    {
      const int from = reached[next];
      const Reached before = cells[from];
      const int steps = isBeside ? before.steps + 1 : 0;
      for (const int to : depth.neighboursOf(from))
      {
        if (steps > this->Reach || to < 0 || !depth.isMeasured(to) || cells.count(to) > 0 ||
            !this->isSmooth(from, to) || (isBeside && !this->isSmooth(before.from, to)) ||
            this->isOn(depth.meanIn(to), toModel) == isBeside || (isBeside && this->isOfBin(depth.meanIn(to))) ||
            this->isAtEdge(depth.meanIn(to)))
        {
          continue;
        }
        cells.emplace(to, Reached{ steps, isBeside ? before.from : to });
        reached.push_back(to);
        if (isBeside && steps > Margin)
        {
          beyond.push_back(depth.meanIn(to));
        }
      }
    }
  }
  return beyond;
}
}
