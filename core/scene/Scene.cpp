// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Scene.h"

#include "base/Error.h"
#include "base/Parallel.h"
#include "scene/edges/LongLines.h"

#include <algorithm>

namespace meam
{
namespace
{
// Cells of what is looked up in a scene, as shares of the part's diameter: about the distances that are asked for.
constexpr double EdgeCell = 0.08;           // of the edge index; refinement starts with correspondences of 10 %
constexpr double DepthCell = 0.02;          // of the depth map: some points of a usual scan each
constexpr double FinePitches = 1.5;         // point distances of the scan, of the fine depth map's,
constexpr double FinestCell = 0.005;        // and no less: finer than poses are right
constexpr double SurfaceCell = 0.05;        // of the measured surface's grid
constexpr double EnclosureTolerance = 0.03; // so near to a plane or line of the bin what was measured lies on it,
constexpr double EnclosureNoises = 3.0;     // and no less than so many times the noise of the scan
LocalCloud checked(LocalCloud edges)
{
  const PointCloud& cloud = edges.cloud;
  if (cloud.tangents.size() != cloud.size())
  {
    throw Error("The scene's edge points have no tangents: estimate them before poses are looked for.");
  }
  const std::vector<float>& weights = cloud.weights;
  if (!weights.empty() && weights.size() != cloud.size())
  {
    throw Error("The scene has " + std::to_string(cloud.size()) + " edge points, but " +
                std::to_string(weights.size()) + " weights of edge points.");
  }
  edges.cloud = finitePoints(std::move(edges.cloud));
  requirePoints(cloud.points, "The scene's edge cloud");
  const auto isWeight = [](float weight) { return weight >= 0.0f && weight <= 1.0f; };
  const auto wrong = std::find_if_not(weights.begin(), weights.end(), isWeight);
  if (wrong != weights.end())
  {
    throw Error("An edge point of the scene has the Weight " + std::to_string(*wrong) +
                ": weights go from 0 to 1. Rename the array, when it is something else.");
  }
  return edges;
}

Sensor moved(const Sensor& sensor, const Eigen::Isometry3d& motion)
{
  return { sensor.perspective, motion * sensor.position, motion.linear() * sensor.direction };
}
}

Scene::Scene(LocalCloud edgePoints, const Points& allMeasured, const Sensor& seenFrom, double diameter,
  const SceneSettings& settings, const ScanQuality& measuredQuality)
  : edges(checked(std::move(edgePoints)))
  , sensor(moved(seenFrom, edges.T_local_scene))
  , quality(measuredQuality)
  , measured(allMeasured)
  , partDiameter(diameter)
  , lines(measured, sensor, settings.threads)
  , depth(lines, DepthCell * diameter, settings.threads)
  , fineDepth(lines, std::max(FinePitches * depth.pitch(), FinestCell * diameter))
{
  inParallel(settings.threads, { [&] { this->surface = PointGrid(this->depth.means(), SurfaceCell * diameter); },
                                 [&] { this->edgeIndex = EdgeIndex(this->edges.cloud, EdgeCell * diameter); } });
  const double noise = settings.followsNoise ? EnclosureNoises * quality.noise : 0.0;
  const double tolerance = std::max(EnclosureTolerance * diameter, noise);
  if (settings.findsEnclosure)
  {
    this->enclosure = enclosingPlanes(this->depth, this->sensor, tolerance, diameter);
  }
  this->isOnLongLine.assign(this->edgePoints().size(), 0);
  if (settings.findsLongLines)
  {
    this->isOnLongLine = onLongLines(this->edgePoints(), this->edgeIndex, diameter, tolerance, settings.threads);
  }
  Points onLines;
  for (std::size_t i = 0; i < this->isOnLongLine.size(); ++i)
  {
    if (this->isOnLongLine[i])
    {
      onLines.push_back(this->edgePoints().points[i]);
    }
  }
  this->longLines = PointGrid(onLines, DepthCell * diameter);
  if (!measured.empty() && !this->hasSurface())
  {
    throw Error(
      "The scene has " + std::to_string(measured.size()) +
      " surface points, but the sensor looks away from all of them: turn the view direction round, or move the sensor "
      "position (a perspective sensor sees what lies before it).");
  }
}
}
