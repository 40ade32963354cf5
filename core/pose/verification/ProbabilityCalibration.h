// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
/// Logistic regression of whether a pose is right on its score and certainty.
struct LogisticRegression
{
  double constant;
  double score;
  double certainty; ///< of its logarithm

  /// That a pose is right, [0, 1].
  double probability(double poseScore, double poseCertainty) const;
};

/// What turns scores into probabilities. Fitted by examples/calibration.py, with the default weights of evidence, on
/// all poses that come out of the Tohoku dataset: scenes 0 to 19 of parts 1 to 3, exact boundaries, without noise and
/// with 0.5 mm. Probabilities of these scenes are those of the data they were fitted on.
struct ProbabilityCalibration
{
  LogisticRegression withSurface{ -18.9, 26.4, 5.8 };
  LogisticRegression edgesAlone{ -4.1, 15.0, 1.7 }; ///< on the same scenes without their surface
};
}
