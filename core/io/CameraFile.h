// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/Camera.h"

#include <string>

namespace meam
{
struct CameraFile
{
  Camera camera;
  double depthScale = 1.0; ///< mm that a depth image's value of 1 stands for
};

/// Reads a camera's calibration: OpenCV's own format (YAML, XML or JSON) with `camera_matrix`,
/// `distortion_coefficients` or `dist_coeffs` (k1 k2 p1 p2 k3), `image_width`, `image_height` and, for a camera
/// beside the sensor, `T_camera_scene` (4x4) or `R` and `T` (as cv::stereoCalibrate names them; mm); or the
/// camera.json of a BOP dataset with `fx`, `fy`, `cx`, `cy`, `width`, `height`. `depth_scale` may stand in any.
/// The focal lengths and the principal point have to be there; entries it does not know are skipped.
/// Throws Error, naming the file, what is wrong and what to do.
CameraFile readCamera(const std::string& path);
}
