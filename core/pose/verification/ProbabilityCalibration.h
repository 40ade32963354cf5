// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "calibration/ModelCalibration.h"

namespace meam
{
// What turns counts into probabilities. With the surface it was fitted on what comes out
// of simulated bins of all parts, seen by each kind of sensor, with the part in them or not; edges alone on the Tohoku
// dataset without its surface. testing/evaluation/calibration.py tells how they hold for other scenes.

/// Of EvidenceCounts::sum: whether a pose is right, but for a turn by a near-symmetry.
inline constexpr LogisticRegression CalibrationWithSurface{ -6.3, 0.64 };
/// The same of EvidenceCounts::ofEdges, in scenes without a surface.
inline constexpr LogisticRegression CalibrationOfEdges{ 2.9, 0.16 };
/// Logarithm of the odds that a copy is here: those that it is when the part is in the scan, and how certain that is,
/// [0, 1].
double withCertainty(double logOdds, double certainty);
}
