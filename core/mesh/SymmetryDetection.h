// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Error.h"
#include "Geometry.h"

namespace meam
{
struct SymmetryDetectionSettings
{
  double tolerance = 0.0;    ///< mm: distance that a turned surface may keep from itself; 0: 1 % of the diameter
  double leastOverlap = 0.8; ///< of a near-symmetry: share of the surface that comes to lie on the surface
};

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
  double deviation = 0.0; ///< mm, the largest distance of the turned surface from the surface
};

/// The rotations that map a part onto itself; mirror images are not among them.
struct Symmetries
{
  std::vector<ContinuousSymmetry> continuous;
  /// The finite group without the identity; with a continuous axis, what is left beside it (a flip).
  std::vector<Eigen::Isometry3d> discrete;
  std::vector<NearSymmetry> near; ///< largest overlap first
};

/// Finds the rotations of `surface`, evenly sampled with normals (mm), onto itself: axes through its
/// middle are tried in all directions, the best are fitted, and what they map is measured.
Symmetries detectSymmetries(
  const PointCloud& surface, const SymmetryDetectionSettings& settings = {}, const Progress& progress = {});

/// For each point of `surface` its distance (mm, at most `reach`) from the surface after the motion.
std::vector<float> surfaceDeviation(const PointCloud& surface, const Eigen::Isometry3d& T, double reach);
}
