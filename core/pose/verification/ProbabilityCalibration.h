// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
/// Logistic regression of whether a pose is right, but for a turn by a near-symmetry, on what was counted for it.
struct LogisticRegression
{
  double constant;
  double counted; ///< of EvidenceCounts::sum, or of what the edges say

  double logOdds(double sum) const { return this->constant + this->counted * sum; }
};

/// What turns counts into probabilities, with the default weights of evidence. `withSurface` was fitted on what comes
/// out of simulated bins of all parts, seen by each kind of sensor, with the part in them or not; `edgesAlone` on the
/// Tohoku dataset without its surface. examples/calibration.py tells how they hold for other scenes.
struct ProbabilityCalibration
{
  LogisticRegression withSurface{ -7.2, 0.64 };
  LogisticRegression edgesAlone{ 2.9, 0.16 }; ///< of scenes without a surface
};

/// Logarithm of the odds that a pose is right: those of its place, where it has a part, and the certainty of its
/// rotation there, [0, 1].
double withCertainty(double logOdds, double certainty);

/// [0, 1], from the logarithm of odds.
double probabilityOf(double logOdds);
}
