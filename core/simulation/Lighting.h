// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "simulation/Rasterizer.h"

namespace meam
{
/// The light that comes from each pixel's surface, as shares of white: two lamps that cast shadows, less of the
/// ambient light for what lies deeper than its surroundings, and a slight texture that sticks to the bodies.
/// `nearness` (mm): what lies so much behind its surroundings is in their shade; spots are far smaller.
std::vector<Eigen::Vector3f> illuminate(const View& view, const Camera& camera, const std::vector<Facet>& facets,
  const std::vector<Body>& bodies, const Eigen::Vector3d& floorAlbedo, double nearness, const Progress& progress = {});
}
