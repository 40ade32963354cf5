// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickPlanning.h"

#include "base/Bounds.h"
#include "pick/GraspTurns.h"
#include "pick/PartSurface.h"
#include "pick/PickCollisions.h"
#include "scene/edges/GridSurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>

namespace meam
{
namespace
{
std::string lengthText(double mm) { return std::to_string(static_cast<int>(std::lround(mm))) + " mm"; }

/// A gripper that touches the part it holds only where it holds it, however little its pose is off: thicker by the
/// margin but on the pads of the jaws, whose room is their clearance, and on the cup's rim, which gives way.
Gripper widened(Gripper gripper, const PickSettings& settings)
{
  gripper.cupDiameter += 2.0 * settings.safetyMargin;
  gripper.fingerWidth += 2.0 * settings.partMargin;
  gripper.fingerThickness += settings.partMargin;
  gripper.tipLength += settings.partMargin; // and so is the body nearer to the part
  gripper.fingerLength = std::max(gripper.fingerLength, gripper.tipLength + settings.partMargin);
  gripper.bodyWidth += 2.0 * settings.partMargin;
  return gripper;
}

void check(const PickSettings& settings)
{
  const auto length = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (!length(settings.safetyMargin) || !length(settings.wayIn) || !length(settings.tolerance) ||
      !length(settings.voxelSize) || !length(settings.cupSlack) || !length(settings.partMargin) ||
      !length(settings.comfortableClearance))
  {
    throw Error("The margins, the way in, the tolerance, the voxels, the cup's slack and the "
                "comfortable clearance must be 0 mm or more.");
  }
  if (!(settings.leastProbability >= 0.0 && settings.leastProbability <= 1.0) ||
      !(settings.mostTilt >= 0.0 && settings.mostTilt <= 180.0) ||
      !(settings.mostCovered >= 0.0 && settings.mostCovered <= 100.0))
  {
    throw Error(
      "The least probability must be 0 to 1, the most tilt 0 to 180 degrees, the most that may be covered 0 to 100 %.");
  }
  if (!(settings.turnStep >= 1.0 && settings.turnStep <= 360.0))
  {
    throw Error("The step between turns of a grasp must be 1 to 360 degrees.");
  }
}

/// Of a pose of which nothing is known, such as a true one: 1.
double confidence(const Pose& pose)
{
  const double known = probabilityOrScore(pose);
  return known > 0.0 ? known : 1.0;
}

void check(const Poses& poses)
{
  for (const Pose& pose : poses)
  {
    if (!pose.T_scene_model.matrix().allFinite())
    {
      throw Error("A pose to pick at is not finite.");
    }
  }
}

void check(const Bin& bin, const Gripper& gripper, double margin)
{
  requireBin(bin);
  const double room = std::min(bin.size.x(), bin.size.y());
  double width = gripper.kind == GraspKind::Suction ? gripper.cupDiameter : gripper.fingerWidth;
  if (!gripper.mesh.triangles.empty())
  {
    width = bounds(gripper.mesh.vertices).cast<double>().sizes().head<2>().minCoeff();
  }
  if (width + 2.0 * margin > room)
  {
    throw Error("The gripper, " + lengthText(width) + " wide, does not go into the bin of " + lengthText(room) +
                ": check their units.");
  }
}

/// Every so-manieth finite point of the scan, so that a few of them are in the side of a voxel.
Points thinned(const OrganizedCloud& cloud, double pointDistance, double voxelSize, double pointsInVoxel)
{
  const int step = cloud.height > 1 && pointDistance > 0.0
                     ? std::max(1, static_cast<int>(voxelSize / (pointsInVoxel * pointDistance)))
                     : 1;
  return everyNth(cloud, step);
}
}

std::string describe(const Pick& pick)
{
  switch (pick.obstruction)
  {
    case PickObstruction::None:
      return "possible";
    case PickObstruction::Uncertain:
      return "the pose is too uncertain";
    case PickObstruction::Covered:
      return "covered from above to " + std::to_string(static_cast<int>(std::lround(100.0 * pick.covered))) + " %";
    case PickObstruction::WrongKind:
      return "the grasp is for another kind of gripper";
    case PickObstruction::TooWide:
      return "the part is too wide there for the jaws";
    case PickObstruction::Tilted:
      return "tilted by " + std::to_string(static_cast<int>(std::lround(pick.tilt))) + " degrees";
    case PickObstruction::PartItself:
      return "collides with the part itself";
    case PickObstruction::Bin:
      return "collides with the bin";
    case PickObstruction::Instance:
      return "collides with instance " + std::to_string(pick.obstacle + 1);
    case PickObstruction::Measured:
      return "collides with something measured";
  }
  return {};
}

std::string labelOf(const Pick& pick, int rank)
{
  switch (pick.obstruction)
  {
    case PickObstruction::None:
      return "pick " + std::to_string(rank);
    case PickObstruction::Uncertain:
      return "uncertain";
    case PickObstruction::Covered:
      return std::to_string(std::lround(100.0 * pick.covered)) + " % covered";
    case PickObstruction::WrongKind:
      return "wrong kind";
    case PickObstruction::TooWide:
      return "too wide";
    case PickObstruction::Tilted:
      return "tilted";
    case PickObstruction::PartItself:
      return "hits the part";
    case PickObstruction::Bin:
      return "hits the bin";
    case PickObstruction::Instance:
      return "hits " + std::to_string(pick.obstacle + 1);
    case PickObstruction::Measured:
      return "hits something";
  }
  return {};
}

std::string describe(const Picks& picks)
{
  static const char* const names[] = { "possible", "of uncertain poses", "covered", "of another kind of gripper",
    "too wide", "tilted", "against the part itself", "against the bin", "against another copy",
    "against something measured" };
  std::array<int, std::size(names)> counts{};
  std::set<int> all;
  std::set<int> graspable;
  for (const Pick& pick : picks)
  {
    ++counts[static_cast<std::size_t>(pick.obstruction)];
    all.insert(pick.pose);
    if (pick.possible())
    {
      graspable.insert(pick.pose);
    }
  }
  std::string text = std::to_string(graspable.size()) + " of " + std::to_string(all.size()) +
                     " copies can be picked, by " + std::to_string(counts[0]) + " of " + std::to_string(picks.size()) +
                     " picks";
  for (std::size_t k = 1; k < counts.size(); ++k)
  {
    if (counts[k] > 0)
    {
      text += (text.find(';') == std::string::npos ? "; " : ", ") + std::to_string(counts[k]) + " " + names[k];
    }
  }
  return text + ".";
}

/// A scan as planning sees it.
struct PickPlanner::Surroundings
{
  Points points;                                  ///< all, thinned
  double voxelSize = 0.0;                         ///< mm
  double tolerance = 0.0;                         ///< mm
  Eigen::Vector3d up = -Eigen::Vector3d::UnitZ(); ///< unit
  double top = 0.0;                               ///< mm along `up`: the bin's rim, or the highest point
  std::vector<int> copies;                        ///< poses that are likely enough to stand in the way
  std::vector<std::vector<int>> pointsOf;         ///< of each copy
};

/// What is known before a scan.
class PickPlanner::Part
{
public:
  Part(const TriangleMesh& mesh, const Symmetries& symmetries, const Grasps& grasps, const Gripper& hand,
    const PickSettings& wanted)
    : gripper(hand)
    , settings(wanted)
    , given(grasps)
    , box(bounds(mesh.vertices).cast<double>())
    , collisions(mesh, hand)
    , surface(
        mesh, std::max(wanted.surfaceSpacing * this->size(), 1e-3), std::max(wanted.mostTolerance * this->size(), 1e-3))
  {
    check(wanted);
    if (grasps.empty())
    {
      throw Error("There is no grasp: define one at least, or have some proposed.");
    }
    const Gripper wide = widened(hand, wanted);
    const PickCollisions own(mesh, wide);
    const std::vector<Eigen::Isometry3d> symmetric = turnsOf(symmetries, wanted.turnStep);
    for (const Grasp& grasp : grasps)
    {
      requireGrasp(grasp);
      const double outside = this->box.exteriorDistance(grasp.T_model_grasp.translation());
      if (outside > wanted.mostOutside * this->size())
      {
        throw Error("The grasp '" + grasp.name + "' lies " + lengthText(outside) +
                    " outside the part: check that it is one of this part, in its coordinates and in mm.");
      }
      this->frames.push_back(framesOf(grasp, symmetric, wanted.turnStep, this->size()));
      this->touching.push_back({});
      for (const auto& frame : this->frames.back())
      {
        const double back = grasp.kind == GraspKind::Suction ? wanted.cupSlack : 0.0;
        const Grasp open = at(grasp, frame * Eigen::Translation3d(0.0, 0.0, -back));
        this->touching.back().push_back(this->fits(grasp) && own.touchesHeld(open, wanted.wayIn, this->step()));
      }
    }
  }

  static Grasp at(Grasp grasp, const Eigen::Isometry3d& T_model_grasp)
  {
    grasp.T_model_grasp = T_model_grasp;
    return grasp;
  }

  /// mm, the diagonal of its box.
  double size() const { return this->box.diagonal().norm(); }
  /// mm, between the places at which a gripper's mesh is looked at on its way.
  double step() const { return std::max(this->settings.safetyMargin, 1.0); }

  bool fits(const Grasp& grasp) const { return this->gripper.kind == grasp.kind && !this->tooWide(grasp); }
  bool tooWide(const Grasp& grasp) const
  {
    return grasp.kind == GraspKind::Parallel && this->gripper.mesh.triangles.empty() &&
           grasp.width + 2.0 * this->gripper.jawClearance > this->gripper.opening;
  }

  /// The best turn of a grasp of a copy; where none is possible the one that comes farthest.
  Pick pickAt(const Pose& pose, int copy, int g, const Surroundings& around) const
  {
    const Grasp& grasp = this->given[g];
    Pick best;
    best.obstruction = this->gripper.kind != grasp.kind ? PickObstruction::WrongKind : PickObstruction::TooWide;
    best.T_scene_grasp = pose.T_scene_model * grasp.T_model_grasp;
    if (!this->fits(grasp))
    {
      return best;
    }
    const double most = std::max(this->settings.comfortableClearance, this->settings.safetyMargin);
    best.obstruction = PickObstruction::Tilted;
    best.tilt = 180.0;
    for (std::size_t turn = 0; turn < this->frames[g].size(); ++turn)
    {
      Pick pick;
      pick.T_scene_grasp = pose.T_scene_model * this->frames[g][turn];
      const double down = -pick.T_scene_grasp.linear().col(2).dot(around.up);
      pick.tilt = std::acos(std::clamp(down, -1.0, 1.0)) * 180.0 / M_PI;
      if (pick.tilt > this->settings.mostTilt)
      {
        pick.obstruction = PickObstruction::Tilted;
      }
      else if (this->touching[g][turn])
      {
        pick.obstruction = PickObstruction::PartItself;
      }
      else
      {
        const Clearance found = this->collisions.clearance(
          at(grasp, this->frames[g][turn]), pick.T_scene_grasp, copy, this->settings.wayIn, most, this->step());
        pick.clearance = found.distance;
        if (found.obstacle != Obstacle::None && found.distance < std::max(this->settings.safetyMargin, 1e-9))
        {
          pick.obstruction = obstructionOf(found.obstacle);
          pick.obstacle = found.obstacle == Obstacle::Instance ? around.copies[found.instance] : -1;
        }
      }
      const auto order = [](const Pick& p)
      { return std::make_tuple(p.possible() ? 0 : -static_cast<int>(p.obstruction), -p.clearance, p.tilt); };
      if (pick.possible() != best.possible() ? pick.possible() : order(pick) < order(best))
      {
        best = pick;
      }
    }
    return best;
  }

  static PickObstruction obstructionOf(Obstacle obstacle)
  {
    return obstacle == Obstacle::Bin        ? PickObstruction::Bin
           : obstacle == Obstacle::Instance ? PickObstruction::Instance
                                            : PickObstruction::Measured;
  }

  Gripper gripper;
  PickSettings settings;
  Grasps given;
  Eigen::AlignedBox3d box; ///< of the mesh, mm
  PickCollisions collisions;
  PartSurface surface;
  std::vector<std::vector<Eigen::Isometry3d>> frames; ///< T_model_grasp of each grasp at all its turns
  std::vector<std::vector<bool>> touching;            ///< of each, whether the gripper touches the part that it holds
};

PickPlanner::PickPlanner(const TriangleMesh& part, const Symmetries& symmetries, const Grasps& grasps,
  const Gripper& gripper, const PickSettings& settings)
  : Known(std::make_unique<Part>(part, symmetries, grasps, gripper, settings))
{
}

PickPlanner::~PickPlanner() = default;

PickPlanner::Surroundings PickPlanner::surroundings(
  const Poses& poses, const OrganizedCloud& cloud, const std::optional<Bin>& bin)
{
  Part& part = *this->Known;
  const PickSettings& settings = part.settings;
  Surroundings around;
  const GridScale scale = cloud.points.empty() ? GridScale{} : gridScale(cloud);
  const double ofPart = settings.toleranceOfPart * part.size();
  around.tolerance = settings.tolerance > 0.0 ? settings.tolerance : ofPart + settings.noiseInTolerance * scale.noise;
  around.tolerance = std::min(around.tolerance, settings.mostTolerance * part.size());
  around.voxelSize =
    settings.voxelSize > 0.0 ? settings.voxelSize : std::max(ofPart, settings.pointsInVoxel * scale.pointDistance);
  around.points = thinned(cloud, scale.pointDistance, around.voxelSize, settings.thinnedInVoxel);
  if (bin)
  {
    around.up = bin->T_scene_bin.linear().col(2);
    around.top = around.up.dot(bin->T_scene_bin * Eigen::Vector3d(0.0, 0.0, bin->size.z()));
  }
  else if (!around.points.empty())
  {
    const auto height = [&](const Eigen::Vector3f& point) { return around.up.dot(point.cast<double>()); };
    around.top = height(*std::max_element(
      around.points.begin(), around.points.end(), [&](const auto& a, const auto& b) { return height(a) < height(b); }));
  }

  std::vector<Eigen::Isometry3d> places;
  std::vector<bool> explained(around.points.size(), false);
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    if (confidence(poses[k]) < settings.leastProbability)
    {
      continue;
    }
    around.copies.push_back(static_cast<int>(k));
    places.push_back(poses[k].T_scene_model);
    around.pointsOf.push_back(part.surface.pointsAt(places.back(), around.points, around.tolerance));
    for (const int index : around.pointsOf.back())
    {
      explained[index] = true;
    }
  }
  Points rest;
  for (std::size_t k = 0; k < around.points.size(); ++k)
  {
    if (!explained[k] && !(bin && distanceFrom(*bin, around.points[k].cast<double>()) <= around.tolerance))
    {
      rest.push_back(around.points[k]);
    }
  }
  part.collisions.setBin(bin ? &*bin : nullptr);
  part.collisions.setInstances(places);
  part.collisions.setMeasured(rest, around.voxelSize, settings.fewestInVoxel);
  return around;
}

double PickPlanner::coveredShare(const Pose& pose, int copy, const Surroundings& around) const
{
  const PartSurface& surface = this->Known->surface;
  std::vector<bool> own(around.points.size(), false);
  for (const int index : around.pointsOf[copy])
  {
    own[index] = true;
  }
  const Eigen::Vector3d middle = pose.T_scene_model * surface.middle();
  Points others;
  for (std::size_t k = 0; k < around.points.size(); ++k)
  {
    const Eigen::Vector3d from = around.points[k].cast<double>() - middle;
    if (!own[k] && (from - from.dot(around.up) * around.up).norm() <= surface.radius())
    {
      others.push_back(around.points[k]);
    }
  }
  return surface.covered(pose.T_scene_model, around.up, others, around.voxelSize, around.tolerance);
}

Picks PickPlanner::plan(
  const Poses& poses, const OrganizedCloud& cloud, const std::optional<Bin>& bin, const Progress& progress)
{
  const Part& part = *this->Known;
  check(poses);
  if (bin)
  {
    check(*bin, part.gripper, part.settings.safetyMargin);
  }
  report(progress, 0.0);
  const Surroundings around = this->surroundings(poses, cloud, bin);
  Picks picks;
  std::size_t copy = 0;
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    report(progress, 0.3 + 0.7 * static_cast<double>(k) / static_cast<double>(poses.size()));
    const bool likely = copy < around.copies.size() && around.copies[copy] == static_cast<int>(k);
    const double covered = likely ? this->coveredShare(poses[k], static_cast<int>(copy), around) : 0.0;
    const bool free = likely && 100.0 * covered <= part.settings.mostCovered;
    for (std::size_t g = 0; g < part.given.size(); ++g)
    {
      Pick pick;
      pick.T_scene_grasp = poses[k].T_scene_model * part.given[g].T_model_grasp;
      pick.obstruction = likely ? PickObstruction::Covered : PickObstruction::Uncertain;
      if (free)
      {
        pick = part.pickAt(poses[k], static_cast<int>(copy), static_cast<int>(g), around);
      }
      pick.pose = static_cast<int>(k);
      pick.grasp = static_cast<int>(g);
      pick.covered = covered;
      pick.reach = around.top - around.up.dot(pick.T_scene_grasp.translation());
      if (pick.possible())
      {
        const double comfort = part.settings.comfortableClearance;
        pick.score = confidence(poses[k]) * part.given[g].quality * (1.0 - covered) *
                     (comfort > 0.0 ? std::min(1.0, pick.clearance / comfort) : 1.0);
      }
      picks.push_back(pick);
    }
    copy += likely;
  }
  const auto order = [](const Pick& pick)
  { return std::make_tuple(-pick.score, -static_cast<int>(pick.obstruction), pick.tilt); };
  std::stable_sort(picks.begin(), picks.end(),
    [&](const Pick& a, const Pick& b) { return a.possible() != b.possible() ? a.possible() : order(a) < order(b); });
  report(progress, 1.0);
  return picks;
}
}
