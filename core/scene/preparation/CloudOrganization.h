// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/Camera.h"
#include "scene/MeasuredCloud.h"

namespace meam
{
/// Brings a cloud back onto the pixels of the camera that measured it: each pixel keeps the nearest of the points
/// that it sees, in the camera's frame (mm); without one it is NaN. Of the image, grey values or colours, a pixel
/// without a point takes what the nearest pixel with one has, so that holes make no edges in it; normals stay NaN.
/// Throws Error for a cloud that is organized, a camera without width and height, and when it sees no point.
MeasuredCloud organizeCloud(const MeasuredCloud& points, const Camera& camera, const Progress& progress = {});
}
