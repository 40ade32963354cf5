// SPDX-License-Identifier: BSD-3-Clause
#include "pick/planning/GraspSearch.h"

#include "base/Bounds.h"
#include "base/Error.h"
#include "base/sequences/Sequences.h"
#include "pick/GraspTurns.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace meam
{
namespace
{
constexpr double CupSlack = 2.0;   // mm that a cup gives way when it comes down on the part
constexpr double PartMargin = 1.0; // mm that the open gripper keeps from the part that it takes, but between its pads
constexpr int FewestInVoxel = 2;   // a point alone is none of a surface
// Shares of the part's size, the diagonal of its box.
constexpr double SurfaceSpacing = 0.03; // of the points on the part that tell what lies at it and on it
constexpr double MostOutside = 0.5;     // a grasp so far from the part is one of another part, or in another unit
constexpr double LeastLength = 1e-3;    // mm, of a spacing
constexpr double SameSurface = 0.01;    // a gripper finds the surface where it is no farther off
constexpr int RimPoints = 8;            // of a cup, and as many half way to its middle
constexpr int RoundSteps = 36;          // about the axis of a nearly round part, as its rotation is decided

/// A gripper that touches the part it holds only where it holds it, however little its pose is off: thicker by the
/// margin but on the pads of the jaws, whose room is their clearance, and on the cup's rim, which gives way.
Gripper widened(Gripper gripper, double safetyMargin)
{
  gripper.cupDiameter += 2.0 * safetyMargin;
  gripper.fingerWidth += 2.0 * PartMargin;
  gripper.fingerThickness += PartMargin;
  gripper.tipLength += PartMargin; // and so is the body nearer to the part
  gripper.fingerLength = std::max(gripper.fingerLength, gripper.tipLength + PartMargin);
  gripper.bodyWidth += 2.0 * PartMargin;
  return gripper;
}

Grasp at(Grasp grasp, const Eigen::Isometry3d& T_model_grasp)
{
  grasp.T_model_grasp = T_model_grasp;
  return grasp;
}

PickObstruction obstructionOf(Obstacle obstacle)
{
  return obstacle == Obstacle::Bin        ? PickObstruction::Bin
         : obstacle == Obstacle::Instance ? PickObstruction::Instance
                                          : PickObstruction::Measured;
}
}

double tiltOf(const Eigen::Isometry3d& T_scene_grasp, const Eigen::Vector3d& up)
{
  const double down = -T_scene_grasp.linear().col(2).dot(up);
  return std::acos(std::clamp(down, -1.0, 1.0)) * 180.0 / M_PI;
}

GraspSearch::GraspSearch(const TriangleMesh& part, const Symmetries& symmetries, const Grasps& grasps,
  const Gripper& gripper, const PlanSettings& settings)
  : Claw(gripper)
  , Settings(settings)
  , Given(grasps)
  , Box(bounds(part.vertices).cast<double>())
  , Collisions(part, gripper)
  , Surface(part, std::max(SurfaceSpacing * this->partSize(), LeastLength),
      std::max(MostTolerance * this->partSize(), LeastLength))
{
  if (grasps.empty())
  {
    throw Error("There is no grasp: define one at least, or have some proposed.");
  }
  const Gripper wide = widened(gripper, settings.safetyMargin);
  const PickCollisions own(part, wide);
  const std::vector<Eigen::Isometry3d> symmetric = turnsOf(symmetries, settings.turnStep);
  for (const Grasp& grasp : grasps)
  {
    requireGrasp(grasp);
    const double outside = this->Box.exteriorDistance(grasp.T_model_grasp.translation());
    if (outside > MostOutside * this->partSize())
    {
      throw Error("The grasp '" + grasp.name + "' lies " + std::to_string(std::lround(outside)) +
                  " mm outside the part: check that it is one of this part, in its coordinates and in mm.");
    }
    this->Frames.push_back(framesOf(grasp, symmetric, settings.turnStep, this->partSize()));
    this->NeedsRotation.push_back(settings.rotationCounts || !this->holdsAnyRotation(grasp, symmetries));
    this->Touching.push_back({});
    for (const auto& frame : this->Frames.back())
    {
      const double back = grasp.kind == GraspKind::Suction ? CupSlack : 0.0;
      const Grasp open = at(grasp, frame * Eigen::Translation3d(0.0, 0.0, -back));
      this->Touching.back().push_back(this->fits(grasp) && own.touchesHeld(open, settings.wayIn, this->step()));
    }
  }
}

bool GraspSearch::tooWide(const Grasp& grasp) const
{
  return grasp.kind == GraspKind::Parallel && this->Claw.mesh.triangles.empty() &&
         grasp.width + 2.0 * this->Claw.jawClearance > this->Claw.opening;
}

bool GraspSearch::holdsAnyRotation(const Grasp& grasp, const Symmetries& symmetries) const
{
  Points touched;
  const auto touch = [&](double x, double y)
  { touched.push_back((grasp.T_model_grasp * Eigen::Vector3d(x, y, 0.0)).cast<float>()); };
  if (grasp.kind == GraspKind::Parallel)
  {
    touch(-0.5 * grasp.width, 0.0);
    touch(0.5 * grasp.width, 0.0);
  }
  else
  {
    touch(0.0, 0.0);
    for (int k = 0; k < RimPoints; ++k)
    {
      const double angle = 2.0 * M_PI * k / RimPoints;
      for (const double radius : { 0.25 * this->Claw.cupDiameter, 0.5 * this->Claw.cupDiameter })
      {
        touch(radius * std::cos(angle), radius * std::sin(angle));
      }
    }
  }
  auto turns = mapped<Eigen::Isometry3d>(symmetries.near, [&](const NearSymmetry& symmetry) { return symmetry.T; });
  for (const ContinuousSymmetry& axis : nearlyRoundAxes(symmetries))
  {
    for (int k = 1; k < RoundSteps; ++k)
    {
      turns.push_back(turnAbout(axis.axis, 2.0 * M_PI * k / RoundSteps, axis.point));
    }
  }
  const double near = SameSurface * this->partSize();
  // The part turned so, where the gripper goes to where it would be as it is.
  return !turns.empty() && std::all_of(turns.begin(), turns.end(),
                             [&](const Eigen::Isometry3d& turn)
                             { return this->Surface.pointsAt(turn, touched, near).size() == touched.size(); });
}

double GraspSearch::step() const { return std::max(this->Settings.safetyMargin, 1.0); }

void GraspSearch::setObstacles(const Poses& poses, const std::vector<const GraspSearch*>& ofPoses,
  const std::optional<Bin>& bin, const PickSurroundings& around)
{
  std::vector<Eigen::Isometry3d> places;
  std::vector<const PickCollisions*> parts;
  for (const int copy : around.copies)
  {
    places.push_back(poses[copy].T_scene_model);
    parts.push_back(&ofPoses[copy]->Collisions);
  }
  this->Collisions.setBin(bin ? &*bin : nullptr);
  this->Collisions.setInstances(places, parts);
  this->Collisions.setMeasured(around.unexplained, around.voxelSize, FewestInVoxel);
}

Pick GraspSearch::pickAt(const Pose& pose, int copy, int index, const PickSurroundings& around) const
{
  const Grasp& grasp = this->Given[index];
  Pick best;
  best.obstruction = this->Claw.kind != grasp.kind ? PickObstruction::WrongKind : PickObstruction::TooWide;
  best.T_scene_grasp = pose.T_scene_model * grasp.T_model_grasp;
  if (!this->fits(grasp))
  {
    return best;
  }
  const double most = std::max(ComfortableClearance, this->Settings.safetyMargin);
  best.obstruction = PickObstruction::Tilted;
  best.tilt = 180.0;
  for (std::size_t turn = 0; turn < this->Frames[index].size(); ++turn)
  {
    Pick pick;
    pick.T_scene_grasp = pose.T_scene_model * this->Frames[index][turn];
    pick.tilt = tiltOf(pick.T_scene_grasp, around.up);
    if (pick.tilt > this->Settings.maximumTilt)
    {
      pick.obstruction = PickObstruction::Tilted;
    }
    else if (this->Touching[index][turn])
    {
      pick.obstruction = PickObstruction::PartItself;
    }
    else
    {
      const Clearance found = this->Collisions.clearance(
        at(grasp, this->Frames[index][turn]), pick.T_scene_grasp, copy, this->Settings.wayIn, most, this->step());
      pick.clearance = found.distance;
      if (found.obstacle != Obstacle::None && found.distance < std::max(this->Settings.safetyMargin, 1e-9))
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
}
