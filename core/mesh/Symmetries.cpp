// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Symmetries.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
// From which on turns of a part, and their axes, are one and the same.
constexpr double SameTurn = 3.0;        // degrees between turns that differ by less
constexpr double SameAxisCosine = 0.99; // between axes that are nearer, 8 degrees
constexpr double HalfTurn = 170.0;      // degrees: a turn by more is half a turn

/// No axis or plane of symmetry that a part is drawn with runs along it.
const Eigen::Vector3d Generic = Eigen::Vector3d(0.48, 0.36, 0.8).normalized(); // along no axis

/// The turn about the axis after which T_scene_model is turned least against the reference.
Eigen::Isometry3d turnedTowards(
  const Eigen::Isometry3d& T_scene_model, const Eigen::Isometry3d& reference, const ContinuousSymmetry& symmetry)
{
  // trace(M Rot(a, angle)) is largest for a small turn between the two.
  const Eigen::Matrix3d M = reference.linear().transpose() * T_scene_model.linear();
  const Eigen::Vector3d& a = symmetry.axis;
  const double sine = a.x() * (M(1, 2) - M(2, 1)) + a.y() * (M(2, 0) - M(0, 2)) + a.z() * (M(0, 1) - M(1, 0));
  const double cosine = M.trace() - a.dot(M * a);
  return T_scene_model * turnAbout(a, std::atan2(sine, cosine), symmetry.point);
}

/// The axis of a turn, through the point of it that is nearest to the origin.
ContinuousSymmetry axisOf(const Eigen::Isometry3d& turn)
{
  const Eigen::AngleAxisd rotation(Eigen::Matrix3d(turn.linear()));
  const Eigen::Vector3d& axis = rotation.axis();
  const Eigen::Vector3d across = turn.translation() - axis.dot(turn.translation()) * axis;
  return { axis, 0.5 * (across + axis.cross(across) / std::tan(0.5 * rotation.angle())) };
}

double traceBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  return (a.linear().transpose() * b.linear()).trace();
}
}

Eigen::Isometry3d turnAbout(const Eigen::Vector3d& axis, double angle, const Eigen::Vector3d& centre)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(centre);
  T.rotate(Eigen::AngleAxisd(angle, axis));
  T.translate(-centre);
  return T;
}

Eigen::Isometry3d nearestEqual(
  const Eigen::Isometry3d& T_scene_model, const Eigen::Isometry3d& reference, const Symmetries& symmetries)
{
  if (symmetries.continuous.size() > 1)
  {
    // A ball may be turned in any way about its middle.
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(T_scene_model.linear().transpose() * reference.linear()));
    return T_scene_model * turnAbout(turn.axis(), turn.angle(), symmetries.continuous.front().point);
  }
  const auto turned = [&](const Eigen::Isometry3d& T)
  { return symmetries.continuous.empty() ? T : turnedTowards(T, reference, symmetries.continuous.front()); };
  constexpr double clearly = 1e-9; // more than rounding
  Eigen::Isometry3d best = turned(T_scene_model);
  for (const Eigen::Isometry3d& S : symmetries.discrete)
  {
    const Eigen::Isometry3d equal = turned(T_scene_model * S);
    if (traceBetween(reference, equal) > traceBetween(reference, best) + clearly)
    {
      best = equal;
    }
  }
  return best;
}

double turnBetween(const Eigen::Isometry3d& of, const Eigen::Isometry3d& T, const Symmetries& same)
{
  const auto between = [&](const Eigen::Isometry3d& one)
  {
    const Eigen::Matrix3d turn = nearestEqual(one, T, same).linear().transpose() * T.linear();
    return Eigen::AngleAxisd(turn).angle() * 180.0 / M_PI;
  };
  double least = between(of);
  for (const NearSymmetry& symmetry : same.near)
  {
    least = std::min(least, between(of * symmetry.T));
  }
  return least;
}

std::vector<ContinuousSymmetry> nearlyRoundAxes(const Symmetries& symmetries)
{
  const double halfTurn = HalfTurn * M_PI / 180.0;
  std::vector<ContinuousSymmetry> axes;
  for (const NearSymmetry& near : symmetries.near)
  {
    const ContinuousSymmetry found = axisOf(near.T);
    const bool known = std::any_of(axes.begin(), axes.end(),
      [&](const ContinuousSymmetry& axis) { return std::abs(axis.axis.dot(found.axis)) > SameAxisCosine; });
    if (!known && Eigen::AngleAxisd(Eigen::Matrix3d(near.T.linear())).angle() < halfTurn)
    {
      axes.push_back(found);
    }
  }
  return axes;
}

Symmetries asIfRound(const Symmetries& symmetries)
{
  Symmetries result = symmetries;
  const std::vector<ContinuousSymmetry> axes = nearlyRoundAxes(symmetries);
  if (result.continuous.empty() && !axes.empty())
  {
    result.continuous.push_back(axes.front());
  }
  return result;
}

Symmetries withKnownExact(const Symmetries& found, const Symmetries& known)
{
  const double sameTurn = SameTurn * M_PI / 180.0;
  Symmetries result = known;
  result.near.clear();
  for (const NearSymmetry& near : found.near)
  {
    const Eigen::Isometry3d rest = nearestEqual(near.T, Eigen::Isometry3d::Identity(), known);
    if (Eigen::AngleAxisd(Eigen::Matrix3d(rest.linear())).angle() > sameTurn)
    {
      result.near.push_back(near);
    }
  }
  return result;
}

std::vector<bool> representatives(const Points& points, const Symmetries& symmetries, double margin)
{
  // Of the images of a point, the one that lies farthest along a generic direction.
  std::vector<bool> result(points.size(), true);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3d point = points[i].cast<double>();
    const double limit = Generic.dot(point) + margin;
    const auto farthest = [&](const Eigen::Vector3d& image)
    {
      if (symmetries.continuous.empty())
      {
        return Generic.dot(image);
      }
      const ContinuousSymmetry& symmetry = symmetries.continuous.front();
      const Eigen::Vector3d offset = image - symmetry.point;
      if (symmetries.continuous.size() > 1)
      {
        return Generic.dot(symmetry.point) + offset.norm();
      }
      const double along = offset.dot(symmetry.axis);
      const double across = Generic.dot(symmetry.axis);
      return Generic.dot(symmetry.point) + along * across +
             (offset - along * symmetry.axis).norm() * std::sqrt(std::max(0.0, 1.0 - across * across));
    };
    result[i] = farthest(point) <= limit;
    for (const Eigen::Isometry3d& S : symmetries.discrete)
    {
      result[i] = result[i] && farthest(S * point) <= limit;
    }
  }
  return result;
}
}
