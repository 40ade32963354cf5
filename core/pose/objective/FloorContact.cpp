// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/FloorContact.h"

#include "base/Bounds.h"
#include "pose/refinement/PartSize.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace meam
{
namespace
{
constexpr double Thinnest = 0.7, ThicknessStep = 0.02; // times as thick
constexpr int Thicknesses = 36, AsInFile = 15;         // up to 1.4
constexpr double UpTo = 0.5;                           // cosine towards the sensor: steeper planes are walls
// Shares of the diameter
constexpr double Placed = 0.002;   // a pose lies so well on its part, one standard deviation
constexpr double Highest = 0.5;    // above the floor parts lie up to, evenly
constexpr double OfNoise = 1.5;    // the scan's: poses and floor move with it
constexpr double Touching = 0.5;   // of the copies
constexpr double Outlying = 0.05;  // of them, for poses may be wrong
constexpr int LeastTouching = 3;   // copies: two may lie at the same height by chance
constexpr double ClearlyOff = 4.0; // log odds against the CAD file's thickness
constexpr double OfPixel = 0.5;    // is the least that tells: sensors measure parts and floor no better

/// The floor: of the planes towards the sensor that with the most points.
const Plane* floorOf(const Scene& scene)
{
  const Eigen::Vector3f towards = scene.sensor.towards(Eigen::Vector3d::Zero()).cast<float>();
  const auto found = std::find_if(scene.enclosure.begin(), scene.enclosure.end(),
    [&](const Plane& plane) { return plane.normal().dot(towards) > UpTo; });
  return found == scene.enclosure.end() ? nullptr : &*found;
}

using Heights = Eigen::Array<double, Thicknesses, 1>;

Heights thicknesses() { return Thinnest + ThicknessStep * Heights::LinSpaced(0.0, Thicknesses - 1.0); }

/// mm above the floor of a part's lowest point, for each thickness; what is seen of it stays where it is.
Heights lowestPoints(const Pose& pose, const Scene& scene, const TrainedModel& model, const Plane& floor, int axis)
{
  const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
  const Plane inModel(T.linear().transpose() * floor.normal(), floor.signedDistance(T.translation()));
  const auto visible = model.visibility->visible(pose.T_scene_model, scene.sensor, scene.depth.pitch());
  float seen = 0.0f;
  for (const int i : visible->surface)
  {
    seen += model.surface.points[i][axis];
  }
  seen /= static_cast<float>(std::max<std::size_t>(visible->surface.size(), 1));
  const Eigen::ArrayXf thicker = (thicknesses() - 1.0).cast<float>() * inModel.normal()[axis];
  Eigen::ArrayXf lowest = Eigen::ArrayXf::Constant(Thicknesses, std::numeric_limits<float>::infinity());
  for (const Eigen::Vector3f& point : model.surface.points)
  {
    lowest = lowest.min(inModel.signedDistance(point) + (point[axis] - seen) * thicker);
  }
  return lowest.cast<double>();
}
}

double thicknessByFloor(const Poses& poses, const Scene& scene, const TrainedModel& model)
{
  const Plane* floor = floorOf(scene);
  const Eigen::Array3d extent = bounds(model.surface.points).sizes().cast<double>();
  const auto isThin = (extent < LeastLength * model.diameter).eval();
  if (!floor || isThin.count() != 1)
  {
    return 1.0;
  }
  Eigen::Index axis;
  isThin.cast<int>().maxCoeff(&axis);
  const double deviation = std::hypot(Placed * model.diameter, OfNoise * scene.quality.noise);
  Heights logLikelihood = Heights::Zero(), touching = Heights::Zero();
  for (const Pose& pose : poses)
  {
    const Heights height = lowestPoints(pose, scene, model, *floor, static_cast<int>(axis));
    const Heights onFloor = (-0.5 * (height / deviation).square()).exp();
    const Heights above = (height > 0.0).select(Heights::Ones(), onFloor) / (Highest * model.diameter);
    logLikelihood +=
      (Touching / (std::sqrt(2.0 * M_PI) * deviation) * onFloor + (1.0 - Touching) * above + Outlying / model.diameter)
        .log();
    touching += (height.abs() < 2.0 * deviation).cast<double>();
  }
  Eigen::Index best;
  const double gained = logLikelihood.maxCoeff(&best) - logLikelihood[AsInFile];
  const double factor = thicknesses()[best];
  const bool isClear = gained >= ClearlyOff && touching[best] >= LeastTouching &&
                       std::abs(factor - 1.0) * extent[axis] > OfPixel * scene.depth.pitch();
  return isClear ? factor : 1.0;
}

std::string thicknessWords(double factor)
{
  if (factor == 1.0)
  {
    return "";
  }
  char times[16];
  std::snprintf(times, sizeof times, "%.2f", factor);
  return "By the floor that they lie on the parts are " + std::string(times) +
         " times as thick as in the CAD file: another part lies there, or the sensor sees parts and floor at "
         "different depths.";
}
}
