// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the simulated sensor look at.
#pragma once
#include "mesh/TriangleMesh.h"
#include "TestGrids.h"
#include "simulation/Rasterizer.h"

namespace meam::test
{
/// A plate of 100 mm by `height` around the origin, facing the sensor.
inline TriangleMesh plate(float height = 100.0f)
{
  const float y = 0.5f * height;
  return { { { -50, -y, 0 }, { 50, -y, 0 }, { 50, y, 0 }, { -50, y, 0 } }, { { 0, 2, 1 }, { 0, 3, 2 } } };
}

inline Body at(const TriangleMesh& mesh, double x, double z, double tilt = 0.0)
{
  Body body;
  body.mesh = &mesh;
  body.T_scene_model.translation() << x, 0.0, z;
  body.T_scene_model.linear() = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()).matrix();
  return body;
}

/// 101 x 101 pixels; a millimetre is 100 / z of them.
inline Camera camera() { return grids::camera(101, 101, 100.0, 50.0, 50.0); }

constexpr double Floor = 1000.0;
constexpr int Middle = 50 * 101 + 50;
}
