// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/PinholeCamera.h"

namespace meam
{
/// Throws Error for focal lengths that are not positive, sizes below 0, and numbers that are not finite.
void requireCamera(const Camera& camera);

// Both take a camera that requireCamera() lets pass.

/// Where the camera sees a point of the scan (mm), in pixels, also outside the image; NaN for a point that is
/// not in front of the camera.
Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& point);

/// The point of the scan (mm) that is seen at a pixel, `depth` mm away along the camera's z axis; NaN where
/// the lens model has no such ray.
Eigen::Vector3d unproject(const Camera& camera, const Eigen::Vector2d& pixel, double depth);
}
