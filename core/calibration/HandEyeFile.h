// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "calibration/HandEyeCalibration.h"

#include <optional>
#include <string>
#include <vector>

namespace meam
{
struct HandEyeFile
{
  std::vector<HandEyePair> pairs;   ///< mm
  std::optional<CameraMount> mount; ///< where the file says it
};

/// Reads pairs of poses: JSON with a list `pairs` of objects with `T_base_gripper` and `T_camera_target`, 4x4 each, row
/// by row, and, where they are not the defaults, `units` ("mm"; "m") and `mount` ("beside": the camera beside the
/// robot; "hand": on the gripper); or a table, CSV, with 32 numbers in a row, T_base_gripper and T_camera_target in mm,
/// row by row, with or without a header. Throws Error, naming the file and the pair, for what is missing or no rotation
/// and translation.
HandEyeFile readHandEye(const std::string& path);
}
