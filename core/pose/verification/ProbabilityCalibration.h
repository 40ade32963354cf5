// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
/// Logistic regression of whether a pose is right on what was counted for it and its certainty.
struct LogisticRegression
{
  double constant;
  double counted;   ///< of EvidenceCounts::sum
  double certainty; ///< of its logarithm

  /// Logarithm of the odds that a pose is right.
  double logOdds(double sum, double poseCertainty) const;
};

/// What turns counts into probabilities, with the default weights of evidence. `withSurface` was fitted on what comes
/// out of simulated bins of examples/parts, seen by structured light and with depths made as coarse as active stereo
/// has them, with the part in them or not; `edgesAlone` on the Tohoku dataset without its surface.
/// examples/calibration.py tells how they hold for other scenes.
struct ProbabilityCalibration
{
  LogisticRegression withSurface{ -0.39, 0.228, 5.3 };
  LogisticRegression edgesAlone{ 2.9, 0.08, 1.0 }; ///< of scenes without a surface
};

/// [0, 1], from the logarithm of odds.
double probabilityOf(double logOdds);
}
