// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/Camera.h"

#include <string>

namespace meam
{
struct CameraFile
{
  Camera camera;
  double depthScale = 1.0;    ///< mm that a depth image's value of 1 stands for
  std::string doubtOfPlace{}; ///< why it may be elsewhere than `camera` has it, which is nothing to a sensor's own
};

/// Reads a camera's calibration, YAML, XML or JSON, by the entries of
/// - OpenCV and ROS: `camera_matrix` or `K`, `distortion_coefficients` or `D`, `image_width` and `image_height`, and,
///   for a camera beside the sensor, `T_camera_scene` (4x4), `R` and `T` (as cv::stereoCalibrate names them) or `rvec`
///   and `tvec`; mm;
/// - BOP and RealSense: `fx`, `fy`, `cx` or `ppx`, `cy` or `ppy`, or `cam_K`, `width`, `height`, `coeffs`;
/// - Open3D: `intrinsic_matrix`, column by column;
/// - Kalibr: `intrinsics` (fx fy cx cy), `distortion_coeffs`, `resolution`, and `T_cn_cnm1`, metres;
/// of a single camera, whatever they stand in, with entries beside them; or a camera matrix alone, as numbers.
/// Of names case and underscores do not count. The distortion is k1 k2 p1 p2 k3, and k4 k5 k6 of the rational model, as
/// a list or by these names; whatever is named like a distortion (`dist...`, `D1`, `k1`) is read or refused. A
/// `distortion_model` or `model` that is another one is refused by its name, unless its coefficients are zeros, and a
/// camera that is no pinhole, or whose image is binned or cut out, always. `depth_scale` may stand in any. The focal
/// lengths and the principal point have to be there; a place under another name, as Open3D's `extrinsic` or ROS's
/// `translation` and `rotation`, is doubted, and so is one less than 1 mm away, which is in metres; other entries are
/// skipped. Throws Error, naming the file, what is wrong and what to do.
CameraFile readCamera(const std::string& path);

/// The same of a camera beside the sensor. Throws Error for a doubt of its place, too.
Camera readImageCamera(const std::string& path);
}
