// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// Any turn about an axis maps the part onto itself.
struct ContinuousSymmetry
{
  Eigen::Vector3d axis;  ///< unit
  Eigen::Vector3d point; ///< on the axis, mm: the foot of the part's middle
};

/// A turn that maps the part onto itself but for a small part of the surface, such as a notch.
struct NearSymmetry
{
  Eigen::Isometry3d T;    ///< part frame, mm
  double overlap = 0.0;   ///< share of the surface that comes to lie on the surface, [0, 1]
  double deviation = 0.0; ///< mm, the largest distance of the turned surface from the surface; 8 % of d_max: or more
};

/// The rotations that map a part onto itself; mirror images are not among them.
struct Symmetries
{
  /// None, one axis, or three for a ball.
  std::vector<ContinuousSymmetry> continuous;
  /// The finite group without the identity; with a continuous axis, what is left beside it (a flip).
  std::vector<Eigen::Isometry3d> discrete;
  std::vector<NearSymmetry> near; ///< largest overlap first

  bool exact() const { return !this->continuous.empty() || !this->discrete.empty(); }
};

/// A turn by `angle` (radians) about the axis through `centre`.
Eigen::Isometry3d turnAbout(const Eigen::Vector3d& axis, double angle, const Eigen::Vector3d& centre);

/// Of all poses that are equal to T_scene_model for a part with these exact symmetries, the one that is turned
/// least against `reference`; of equals the first.
Eigen::Isometry3d nearestEqual(
  const Eigen::Isometry3d& T_scene_model, const Eigen::Isometry3d& reference, const Symmetries& symmetries);

/// Degrees between two rotations, up to these symmetries, near ones among them.
double turnBetween(const Eigen::Isometry3d& of, const Eigen::Isometry3d& T, const Symmetries& same);

/// The axes about which a part is nearly round: those of its near-symmetries other than half turns.
std::vector<ContinuousSymmetry> nearlyRoundAxes(const Symmetries& symmetries);

/// The same as if a nearly round part were round: any turn about the first such axis is a symmetry, too.
Symmetries asIfRound(const Symmetries& symmetries);

/// The exact symmetries that are known of a part, and what was found of near ones besides them.
Symmetries withKnownExact(const Symmetries& found, const Symmetries& known);

/// For each point whether it is one of those that stand for all others: every point has an image under the exact
/// symmetries that is within `margin` (mm) of them. All points of a part without symmetries.
std::vector<bool> representatives(const Points& points, const Symmetries& symmetries, double margin);
}
