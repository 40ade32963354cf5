// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace meam
{
/// The mean over a square of `window` (odd) pixels around each pixel; at the image's border a smaller one around the
/// same pixel, so that what is linear stays as it is.
std::vector<double> boxMeans(const std::vector<double>& values, int width, int height, int window);

/// Independent numbers of variance 1 made alike within a square of `window` (odd) pixels; the variance stays.
std::vector<double> correlated(const std::vector<double>& noise, int width, int height, int window);

/// Which pixels the second eye, on the right, does not see behind something nearer: those left of a jump, as many as
/// the disparities (pixels) differ. Of what it sees through a gap that narrow a matcher that keeps the order along a
/// row has no disparity either.
std::vector<bool> halfOccluded(const std::vector<double>& disparities, int width);
}
