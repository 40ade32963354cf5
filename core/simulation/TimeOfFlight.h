// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/Camera.h"
#include "simulation/Rasterizer.h"

namespace meam
{
/// The light that comes back from each pixel's surface (any unit): by the cosine of incidence and the square of the
/// distance.
std::vector<double> returnedLight(const View& view, const Camera& camera);

/// Depths (mm) of a view where light that takes a second way, from a surface nearby, mixes in: concave corners seem
/// deeper and round. `share` of its light a surface throws on, as Lambert's law has it; light of more bounces is left
/// out. Surfaces that the camera does not see give none.
std::vector<double> multipathDepths(
  const View& view, const Camera& camera, const std::vector<double>& light, double share);

/// Depths as a sensor measures them in whose pixels the light of neighbours mixes, within a Gaussian of `sigma` pixels:
/// at a jump they lie between both surfaces, nearer to the one that returns more light.
std::vector<double> mixedDepths(
  const std::vector<double>& depths, const std::vector<double>& light, const Camera& camera, double sigma);
}
