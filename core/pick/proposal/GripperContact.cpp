// SPDX-License-Identifier: BSD-3-Clause
#include "pick/proposal/GripperContact.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double PadTolerance = 0.5;  // mm that a jaw's pad may be from the surface where it is said to touch
constexpr double LeastContact = 0.15; // share of each pad that has to touch; a pin touches a fifth all along the pad
constexpr double MostBend = 5.0;      // degrees between the surface's normals under a cup
constexpr int PadRays = 5;            // along each side of a pad: odd, so that one is in its middle
constexpr int CupRings = 3;
constexpr int CupRays = 16;          // on each ring
constexpr double CupLook = 5.0;      // seal tolerances above and below the rim
constexpr double LeastOpening = 1.0; // mm beside the part from where rays look at it when jaws have no clearance

/// One pad, on the side of x that `side` says.
class Pad
{
public:
  Pad(const MeshRays& rays, const Grasp& grasp, const Gripper& gripper, double frictionAngle, double side)
    : Rays(rays)
    , Frame(grasp.T_model_grasp)
    , FrictionAngle(frictionAngle * M_PI / 180.0)
    , Inward(-side * grasp.T_model_grasp.linear().col(0))
    , Open(std::max(gripper.jawClearance, LeastOpening))
    , X(side * (0.5 * grasp.width + this->Open))
    , Reach(this->Open + 0.5 * grasp.width)
  {
  }

  struct Touch
  {
    double depth = 0.0; ///< mm from the pad to the surface; less than 0: it sticks out
    double angle = 0.0; ///< radians between the normal and the closing direction
  };

  /// What a ray from a place of the open pad meets; nothing when it misses the part.
  std::optional<Touch> at(double y, double z) const
  {
    const std::optional<RayHit> hit =
      this->Rays.firstEntered(this->Frame * Eigen::Vector3d(this->X, y, z), this->Inward, this->Reach);
    if (!hit)
    {
      return {};
    }
    return Touch{ hit->distance - this->Open, std::acos(std::clamp(-hit->normal.dot(this->Inward), -1.0, 1.0)) };
  }

  bool touches(const Touch& touch) const
  {
    return std::abs(touch.depth) <= PadTolerance && touch.angle <= this->FrictionAngle;
  }

  /// The share that touches; none when something keeps the pad away.
  std::optional<double> share(double width, double length) const
  {
    int touching = 0;
    for (int i = 0; i < PadRays; ++i)
    {
      for (int k = 0; k < PadRays; ++k)
      {
        const auto place = [](int cell) { return (cell + 0.5) / PadRays - 0.5; };
        const std::optional<Touch> touch = this->at(place(i) * width, place(k) * length);
        if (touch && touch->depth < -PadTolerance)
        {
          return {};
        }
        touching += touch && this->touches(*touch) ? 1 : 0;
      }
    }
    return static_cast<double>(touching) / (PadRays * PadRays);
  }

private:
  const MeshRays& Rays;
  const Eigen::Isometry3d& Frame;
  double FrictionAngle; ///< radians
  Eigen::Vector3d Inward;
  double Open;
  double X;
  double Reach;
};
}

std::optional<GripperContact> jawContact(
  const MeshRays& rays, const Grasp& grasp, const Gripper& gripper, double frictionAngle)
{
  const Pad pads[] = { { rays, grasp, gripper, frictionAngle, -1.0 }, { rays, grasp, gripper, frictionAngle, 1.0 } };
  GripperContact contact;
  contact.share = 1.0;
  for (const Pad& pad : pads)
  {
    const auto middle = pad.at(0.0, 0.0);
    if (!middle || !pad.touches(*middle))
    {
      return {};
    }
    contact.slant = std::max(contact.slant, middle->angle / (frictionAngle * M_PI / 180.0));
  }
  for (const Pad& pad : pads)
  {
    const std::optional<double> share = pad.share(gripper.fingerWidth, 2.0 * gripper.tipLength);
    if (!share || *share < LeastContact)
    {
      return {};
    }
    contact.share = std::min(contact.share, *share);
  }
  return contact;
}

std::optional<GripperContact> cupContact(const MeshRays& rays, const Grasp& grasp, const Gripper& gripper)
{
  const Eigen::Vector3d down = grasp.T_model_grasp.linear().col(2);
  const double above = CupLook * SealTolerance;
  double farthest = 0.0;
  const auto isFlat = [&](double x, double y)
  {
    const auto hit = rays.firstEntered(grasp.T_model_grasp * Eigen::Vector3d(x, y, -above), down, 2.0 * above);
    farthest = hit ? std::max(farthest, std::abs(hit->distance - above)) : farthest;
    return hit && -hit->normal.dot(down) >= std::cos(MostBend * M_PI / 180.0);
  };
  bool flat = isFlat(0.0, 0.0);
  for (int ring = CupRings; flat && ring > 0; --ring)
  {
    const double radius = 0.5 * gripper.cupDiameter * ring / CupRings;
    for (int k = 0; flat && k < CupRays; ++k)
    {
      const double angle = 2.0 * M_PI * k / CupRays;
      flat = isFlat(radius * std::cos(angle), radius * std::sin(angle));
    }
  }
  if (!flat || farthest > SealTolerance)
  {
    return {};
  }
  return GripperContact{ 1.0, farthest / SealTolerance };
}
}
