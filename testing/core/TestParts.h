// SPDX-License-Identifier: BSD-3-Clause
// Parts made in code, and motions, for the tests.
#pragma once

#include "features/TangentEstimation.h"
#include "mesh/TriangleMesh.h"
#include "scene/Sensor.h"

#include <limits>
#include <random>

namespace parts
{
/// A coordinate of what was not measured.
constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

/// An axis-aligned box, outward triangles.
meam::TriangleMesh box(const Eigen::Vector3f& low, const Eigen::Vector3f& high);

/// A prism over a polygon in the xy plane (counter-clockwise, star-shaped about its first corner).
meam::TriangleMesh prism(const std::vector<Eigen::Vector2f>& outline, float height);

/// Of many corners a cylinder; about z, on the plane z = 0.
meam::TriangleMesh regularPrism(int corners, double radius, float height);

/// From the origin along x and y in the plane z = 0, facing up.
meam::TriangleMesh rectangle(float width, float height);

/// An L of unequal legs, 60 x 40 x 15 mm: no rotation maps it onto itself. The first corner is the
/// inner one, from which all others are seen.
meam::TriangleMesh lBracket();

/// A plate of 60 x 40 x 10 mm with a window of 14 x 20 mm towards one corner: no rotation maps it onto itself.
meam::TriangleMesh windowPlate();

/// A plate of 60 x 40 x 6 mm with a block of 20 x 12 x 12 mm on one corner, or on its neighbour, which makes it the
/// mirror image.
meam::TriangleMesh blockOnPlate(bool mirrored);

/// A gear of ten teeth, one of which is missing: turns by 36 degrees are near-symmetries.
meam::TriangleMesh gear();

/// A square plate of 60 x 60 x 10 mm with one corner cut off: quarter turns and flips are near-symmetries.
meam::TriangleMesh cutPlate();

Eigen::Isometry3d motion(std::mt19937& random, double reach);

meam::Points moved(const meam::Points& points, const Eigen::Isometry3d& T);

meam::PointCloud moved(const meam::PointCloud& cloud, const Eigen::Isometry3d& T);

meam::PrecisePoints moved(const meam::PrecisePoints& points, const Eigen::Isometry3d& T);

meam::PrecisePoints precise(const meam::Points& points);

/// Points, skewed along each axis, so that the principal frame is clear.
meam::PrecisePoints skewed(int count);

/// An orthographic sensor that looks down.
inline meam::Sensor fromAbove() { return { false, Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ() }; }

/// Of the edge points those that stay, with tangents and weights.
meam::PointCloud withTangents(const meam::PointCloud& edges, double partDiameter, const Eigen::Vector3d& viewDirection,
  const meam::TangentEstimationSettings& settings = {});
}
