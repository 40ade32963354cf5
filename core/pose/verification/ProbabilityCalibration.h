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
/// out of simulated bins of this project's own parts, by two sensors, with the part in them or not; `edgesAlone` on the
/// Tohoku dataset without its surface. How it holds for other parts and sensors: docs/evaluation.md.
struct ProbabilityCalibration
{
  LogisticRegression withSurface{ -0.39, 0.228, 5.3 };
  LogisticRegression edgesAlone{ 2.9, 0.08, 1.0 }; ///< of scenes without a surface
};

/// [0, 1], from the logarithm of odds.
double probabilityOf(double logOdds);
}
