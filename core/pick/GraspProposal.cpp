// SPDX-License-Identifier: BSD-3-Clause
#include "pick/GraspProposal.h"

#include "base/Parallel.h"
#include "base/Range.h"
#include "pick/PickCollisions.h"
#include "pick/proposal/ContactPlaces.h"
#include "pick/proposal/GraspSpread.h"
#include "pick/proposal/GripperContact.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace meam
{
namespace
{
constexpr double LeastWidth = 0.5;   // mm, of what the jaws hold: thinner sheets bend
constexpr int Approaches = 8;        // directions about the closing one that are tried
constexpr double WayIn = 80.0;       // mm, straight along the approach, on which the gripper must not touch the part
constexpr double WayStep = 2.0;      // mm between the places on it at which a gripper that is a mesh is looked at
constexpr int Contacts = 1500;       // places on the surface that are tried, about: more finds more and takes longer
constexpr double FreeTurnLoss = 0.1; // share of the contact that a free turn may cost
constexpr double CentreWeight = 0.5; // of the quality that is lost half a diameter away from the centre of mass
constexpr double AngleWeight = 0.5;  // of the quality that is lost at the limit of friction, or of what a lip closes

constexpr double SamePlaces = 0.1;      // of the diameter, the spread where none is given
constexpr double QualitySteps = 1e6;    // finer differences of quality are rounding
constexpr double AlongAxis = 0.9;       // cosine: a direction of the CAD that is no reference for approaches
constexpr double AfterCandidates = 0.8; // of the work, for the progress

void requireSettings(const ProposeSettings& s)
{
  requireWithin("maximum number of grasps", s.maximumGrasps, 0, Unbounded);
  requireWithin("spread of grasps", s.spread, 0.0, Unbounded, " mm");
  requireWithin("friction angle", s.frictionAngle, 0.1, 89.0, " degrees");
}

/// A direction of the CAD that does not run along the axis: down, because parts are drawn as they stand, or else along
/// y.
Eigen::Vector3d referenceAcross(const Eigen::Vector3d& axis)
{
  return std::abs(axis.z()) < AlongAxis ? Eigen::Vector3d(-Eigen::Vector3d::UnitZ()) : Eigen::Vector3d::UnitY();
}

/// Says what a gripper makes of a grasp.
class GraspJudge
{
public:
  GraspJudge(const TriangleMesh& part, const Gripper& gripper, double frictionAngle)
    : Rays(part)
    , Balance(balanceOf(part))
    , Collisions(part, gripper)
    , Claw(gripper)
    , FrictionAngle(frictionAngle)
  {
  }

  const MeshRays& rays() const { return this->Rays; }
  const PartBalance& balance() const { return this->Balance; }

  /// How the gripper touches the part there; none when it does not hold or is in its own way.
  std::optional<GripperContact> contact(const Grasp& grasp) const
  {
    const bool isCup = grasp.kind == GraspKind::Suction;
    const auto found = isCup ? cupContact(this->Rays, grasp, this->Claw)
                             : jawContact(this->Rays, grasp, this->Claw, this->FrictionAngle);
    Grasp before = grasp; // a cup that sits on the surface touches it
    before.T_model_grasp.translate(Eigen::Vector3d(0.0, 0.0, isCup ? -SealTolerance : 0.0));
    return found && !this->Collisions.touchesHeld(before, WayIn, WayStep) ? found : std::nullopt;
  }

  double quality(const Grasp& grasp, const GripperContact& contact) const
  {
    Eigen::Vector3d lever = this->Balance.centre - grasp.T_model_grasp.translation();
    if (grasp.kind == GraspKind::Suction) // what hangs straight below does not bend the lip
    {
      const Eigen::Vector3d axis = grasp.T_model_grasp.linear().col(2);
      lever -= lever.dot(axis) * axis;
    }
    const double away = std::min(1.0, lever.norm() / (0.5 * this->Balance.diameter));
    return contact.share * (1.0 - CentreWeight * away) * (1.0 - AngleWeight * std::min(1.0, contact.slant));
  }

  /// The turn after which the gripper holds as well, all around.
  FreeTurn freeTurn(const Grasp& grasp) const
  {
    const bool isCup = grasp.kind == GraspKind::Suction;
    if (this->isFree(grasp, Eigen::Vector3d::UnitZ()))
    {
      return FreeTurn::Approach;
    }
    return !isCup && this->isFree(grasp, Eigen::Vector3d::UnitX()) ? FreeTurn::Closing : FreeTurn::None;
  }

private:
  bool isFree(const Grasp& grasp, const Eigen::Vector3d& axis) const
  {
    const auto here = this->contact(grasp);
    const int turns = static_cast<int>(std::lround(360.0 / GraspTurnStep));
    for (int k = 1; here && k < turns; ++k)
    {
      Grasp turned = grasp;
      turned.T_model_grasp.rotate(Eigen::AngleAxisd(2.0 * M_PI * k / turns, axis));
      const auto there = this->contact(turned);
      if (!there || there->share < (1.0 - FreeTurnLoss) * here->share)
      {
        return false;
      }
    }
    return here.has_value();
  }

  MeshRays Rays;
  PartBalance Balance;
  PickCollisions Collisions;
  const Gripper& Claw;
  double FrictionAngle; ///< degrees
};

/// The grasps of jaws that close along the normal of a place: a face on the other side, and approaches across.
Grasps jawGrasps(
  const ContactPlace& place, const MeshRays& rays, const Gripper& gripper, const ProposeSettings& settings)
{
  Grasps grasps;
  const double most = gripper.mesh.triangles.empty() ? gripper.opening - 2.0 * gripper.jawClearance : gripper.opening;
  const double cone = std::cos(settings.frictionAngle * M_PI / 180.0);
  for (const RayHit& hit : rays.hits(place.point, -place.normal, most))
  {
    if (hit.entering || hit.distance < LeastWidth || hit.normal.dot(-place.normal) < cone)
    {
      continue;
    }
    Grasp grasp;
    grasp.width = hit.distance;
    const Eigen::Vector3d middle = place.point - 0.5 * hit.distance * place.normal;
    grasp.T_model_grasp = graspFrame(middle, place.normal.cross(referenceAcross(place.normal)), place.normal);
    grasp.T_model_grasp.rotate(Eigen::AngleAxisd(-0.5 * M_PI, Eigen::Vector3d::UnitX())); // to the reference
    for (int k = 0; k < Approaches; ++k)
    {
      grasps.push_back(grasp);
      const double angle = 2.0 * M_PI * k / Approaches;
      grasps.back().T_model_grasp.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()));
    }
  }
  return grasps;
}

Grasps cupGrasps(const ContactPlace& place)
{
  Grasp grasp;
  grasp.kind = GraspKind::Suction;
  grasp.T_model_grasp = graspFrame(place.point, -place.normal, referenceAcross(place.normal));
  return { grasp };
}

/// All that hold, best first.
Grasps candidates(const std::vector<ContactPlace>& places, const GraspJudge& judge, const Gripper& gripper,
  const ProposeSettings& settings, const Progress& progress)
{
  std::vector<Grasps> found(places.size());
  parallelForEach(static_cast<int>(places.size()), numberOfThreads(settings.threads), progress,
    [&](int i)
    {
      const Grasps tried = gripper.kind == GraspKind::Suction ? cupGrasps(places[i])
                                                              : jawGrasps(places[i], judge.rays(), gripper, settings);
      for (Grasp grasp : tried)
      {
        if (const auto contact = judge.contact(grasp))
        {
          grasp.quality = std::round(judge.quality(grasp, *contact) * QualitySteps) / QualitySteps;
          found[i].push_back(grasp);
        }
      }
    });
  Grasps all;
  for (const Grasps& some : found)
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  std::stable_sort(all.begin(), all.end(), [](const Grasp& a, const Grasp& b) { return a.quality > b.quality; });
  return all;
}
}

Grasps proposeGrasps(const TriangleMesh& part, const Symmetries& symmetries, const Gripper& gripper,
  const ProposeSettings& settings, const Progress& progress)
{
  requireMesh(part);
  requireGripper(gripper);
  requireSettings(settings);
  const GraspJudge judge(part, gripper, settings.frictionAngle);
  const double size = judge.balance().diameter;
  const std::vector<ContactPlace> places =
    contactPlaces(part, judge.rays(), judge.balance(), symmetries, Contacts, settings.seed);
  const Grasps all = candidates(places, judge, gripper, settings, subProgress(progress, 0.0, AfterCandidates));

  const double spread = settings.spread > 0.0 ? settings.spread : SamePlaces * size;
  Grasps best = spreadOut(
    all, symmetries, spread, size, settings.maximumGrasps, [&](const Grasp& grasp) { return judge.freeTurn(grasp); },
    subProgress(progress, AfterCandidates, 1.0));
  int number = 0;
  for (Grasp& grasp : best)
  {
    grasp.name = (gripper.kind == GraspKind::Suction ? "suction " : "parallel ") + std::to_string(++number);
  }
  return best;
}
}
