// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>

namespace meam
{
/// A pinhole camera with Brown's lens distortion, or the rational one, in OpenCV's conventions: x right, y down, z the
/// way it looks; the centre of the upper left pixel is (0, 0).
struct Camera
{
  int width = 0; ///< pixels; 0: not known, and the next
  int height = 0;
  double fx = 0.0; ///< pixels, focal lengths
  double fy = 0.0;
  double cx = 0.0; ///< pixels, principal point
  double cy = 0.0;
  std::array<double, 8> distortion{}; ///< k1 k2 p1 p2 k3, and of the rational model k4 k5 k6; zeros: no distortion
  /// mm; takes a point of the scan to the camera's frame. The identity: the camera is the scan's own.
  Eigen::Isometry3d T_camera_scene = Eigen::Isometry3d::Identity();
};
}
