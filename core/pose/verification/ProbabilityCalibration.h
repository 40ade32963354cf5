// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "calibration/ModelCalibration.h"

namespace meam
{
// What turns counts into probabilities. With the surface, and whether the part is there, were fitted on what comes out
// of simulated bins of all parts, seen by each kind of sensor, with the part in them or not; edges alone on the Tohoku
// dataset without its surface. testing/evaluation/calibration.py tells how they hold for other scenes.

/// Of EvidenceCounts::sum: whether a pose is right, but for a turn by a near-symmetry.
inline constexpr LogisticRegression CalibrationWithSurface{ -6.3, 0.64 };
/// The same of EvidenceCounts::ofEdges, in scenes without a surface.
inline constexpr LogisticRegression CalibrationOfEdges{ 2.9, 0.16 };
/// Whether the part is in the scan at all, from the logarithm of its best pose's odds: in the bins with the part that
/// was 3.5 to 24, in those without it at most 1.6.
inline constexpr LogisticRegression CalibrationOfPresence{ -6.0, 3.0 };
inline constexpr double LeastPresent = 0.2; ///< however badly that fits: it may be alone, with its notch out of sight

/// Logarithm of the odds that a copy is here: those that it is when the part is in the scan, and how certain that is,
/// [0, 1].
double withCertainty(double logOdds, double certainty);
}
