// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "calibration/ModelCalibration.h"

namespace meam
{
// The log odds that poses are searched for by; what is said of final poses is PlaceOdds. With the surface they were
// fitted on what comes out of simulated bins of all parts, seen by each kind of sensor, with the part in them or not;
// edges alone on the Tohoku dataset without its surface.

/// Of EvidenceCounts::sum, with a surface.
inline constexpr LogisticRegression CalibrationWithSurface{ -6.3, 0.64 };
/// Of EvidenceCounts::ofEdges, without.
inline constexpr LogisticRegression CalibrationOfEdges{ 2.9, 0.16 };
/// Logarithm of the odds that a copy is here: those that it is when the part is in the scan, and how certain that is,
/// [0, 1].
double withCertainty(double logOdds, double certainty);
}
