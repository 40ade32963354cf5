// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/Symmetries.h"

namespace meam
{
struct SymmetryDetectionSettings
{
  double tolerance = 0.0;    ///< mm: distance that a turned surface may keep from itself; 0: 1 % of the diameter
  double leastOverlap = 0.8; ///< of a near-symmetry: share of the surface that comes to lie on the surface
};

/// Finds the rotations of `surface`, evenly sampled with normals (mm), onto itself: axes through its
/// middle are tried in all directions, the best are fitted, and what they map is measured.
Symmetries detectSymmetries(
  const PointCloud& surface, const SymmetryDetectionSettings& settings = {}, const Progress& progress = {});

/// For each point of `surface` its distance (mm, at most `reach`) from the surface after the motion.
std::vector<float> surfaceDeviation(const PointCloud& surface, const Eigen::Isometry3d& T, double reach);
}
