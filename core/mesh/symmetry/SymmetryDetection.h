// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/Symmetries.h"

namespace meam
{
struct SymmetryDetectionSettings
{
  double tolerance = 0.0;       ///< mm: distance that a turned surface may keep from itself; 0: toleranceShare
  double toleranceShare = 0.01; ///< of the diameter
  double leastOverlap = 0.8;    ///< of a near-symmetry: share of the surface that comes to lie on the surface

  // Axes
  int axes = 1500;         ///< directions on a sphere that are tried: 3 degrees from any direction to the nearest
  int orders = 8;          ///< turns by 360 / k degrees up to this k find axes; the scan finds the others
  double mostMisfit = 0.6; ///< mean distance of a turned surface, of the reach: with more there is no axis or angle
  int mostAxes = 24;       ///< the best of them that are looked at,
  double axisSeparation = 12.0;  ///< degrees: nearer ones are the same; a fitted one that is farther is another
  double coarseLeafShare = 0.15; ///< of the diameter, cubes of which one point finds axes,
  double scanLeafShare = 0.06;   ///< and one finds angles and fits,
  double sparseLeafShare = 0.03; ///< cubes of which one point is the surface that both are laid on

  // Angles
  int scanSteps = 120;          ///< of a full turn about an axis,
  int firstStep = 3;            ///< from which on, to both sides, a turn is looked at,
  double leastTurn = 8.0;       ///< degrees: fitted, a smaller one is none,
  double sameTurn = 4.0;        ///< and two that differ by less are one
  int continuousTurns = 11;     ///< of a continuous symmetry, all of which have to be exact,
  double continuousStep = 31.0; ///< degrees from one to the next, which no small order shares

  // Distances from the surface, and the fit of a turn
  double reachShare = 0.08;     ///< of the diameter: larger distances are told as this
  double nearSpacings = 2.0;    ///< spacings: most points that lie on the surface have a sample this near
  double alongSpacings = 1.5;   ///< along the surface from a sample to where the next one stands for it
  double sameSide = 0.7;        ///< cosine of 45 degrees between the normals of corresponding points
  int fitSteps = 12;            ///< with correspondences within the reach in the first,
  double lastReachShare = 0.25; ///< and within this share of it in the last
  double shownSpacing = 0.1; ///< of the reach that surfaceDeviation() is given: what it takes for the samples' spacing
};

/// Finds the rotations of `surface`, evenly sampled with normals (mm), onto itself: axes through its
/// middle are tried in all directions, the best are fitted, and what they map is measured.
Symmetries detectSymmetries(
  const PointCloud& surface, const SymmetryDetectionSettings& settings = {}, const Progress& progress = {});

/// For each point of `surface` its distance (mm, at most `reach`) from the surface after the motion.
std::vector<float> surfaceDeviation(
  const PointCloud& surface, const Eigen::Isometry3d& T, double reach, const SymmetryDetectionSettings& settings = {});
}
