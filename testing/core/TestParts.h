// SPDX-License-Identifier: BSD-3-Clause
// Parts made in code, and motions, for the tests.
#pragma once

#include "features/TangentEstimation.h"
#include "mesh/TriangleMesh.h"
#include "scene/Sensor.h"

#include <gtest/gtest.h>

#include <functional>
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

/// A square sheet about the origin in the plane z = 0, facing up, with a square opening; half of their sides.
meam::TriangleMesh frame(float outer, float inner);

/// A rectangular plate on the plane z = 0 with a rectangular hole; corners 4 to 7 are the hole's below.
meam::TriangleMesh holedPlate(const Eigen::AlignedBox2f& outer, const Eigen::AlignedBox2f& hole, float height);

/// What is to the left of a closed profile (distance from the z axis, z), once around the axis.
meam::TriangleMesh revolved(const std::vector<Eigen::Vector2d>& profile, int sides);

/// About the origin, of 8 * 4^divisions triangles.
meam::TriangleMesh sphere(float radius, int divisions);

/// Every triangle becomes four, so many times.
meam::TriangleMesh divided(meam::TriangleMesh mesh, int times = 1);

meam::TriangleMesh joined(meam::TriangleMesh mesh, const meam::TriangleMesh& other);

/// As an STL reader gives it: triangles share no vertices, only their places.
meam::TriangleMesh soup(const meam::TriangleMesh& mesh);

double area(const meam::TriangleMesh& mesh);

/// Of a closed mesh; negative, where it faces inwards.
double volume(const meam::TriangleMesh& mesh);

/// Points so many mm apart.
meam::PointCloud sampled(const meam::TriangleMesh& mesh, double spacing);

/// An L of unequal legs, 60 x 40 x 15 mm: no rotation maps it onto itself. The first corner is the
/// inner one, from which all others are seen.
meam::TriangleMesh lBracket();

/// A plate of 60 x 40 x 10 mm with a window of 14 x 20 mm towards one corner: no rotation maps it onto itself.
meam::TriangleMesh windowPlate();

/// A plate of 60 x 40 x 6 mm with a block of 20 x 12 x 12 mm on one corner, or on its neighbour, which makes it the
/// mirror image.
meam::TriangleMesh blockOnPlate(bool mirrored);
/// A plate of 60 x 40 x 6 mm with a high block on one of its corners: its back is plain.
meam::TriangleMesh tower();

/// A gear of ten teeth, one of which is missing: turns by 36 degrees are near-symmetries.
meam::TriangleMesh gear();

/// A square plate of 60 x 60 x 10 mm with one corner cut off: quarter turns and flips are near-symmetries.
meam::TriangleMesh cutPlate();

Eigen::Isometry3d motion(std::mt19937& random, double reach);

meam::PointCloud moved(const meam::PointCloud& cloud, const Eigen::Isometry3d& T);

meam::PrecisePoints moved(const meam::PrecisePoints& points, const Eigen::Isometry3d& T);

/// Every so many mm of a rectangle; z by a function of x and y, or the same everywhere.
meam::Points lattice(
  const Eigen::Vector2f& low, const Eigen::Vector2f& high, float step, const std::function<float(float, float)>& z);
meam::Points lattice(const Eigen::Vector2f& low, const Eigen::Vector2f& high, float step, float z);

/// Adds points to others.
void add(meam::Points& points, const meam::Points& more);

/// They all look the same way.
meam::PointCloud facing(const meam::Points& points, const Eigen::Vector3f& normal);

/// About the origin; with tangents.
meam::Points scattered(int count, double reach);
meam::PointCloud scatteredEdges(int count, double reach);

meam::PrecisePoints precise(const meam::Points& points);

/// Points, skewed along each axis, so that the principal frame is clear.
meam::PrecisePoints skewed(int count);

/// An orthographic sensor that looks down.
inline meam::Sensor fromAbove() { return { false, Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ() }; }

/// Of the edge points those that stay, with tangents and weights.
meam::PointCloud withTangents(const meam::PointCloud& edges, double partDiameter, const Eigen::Vector3d& viewDirection,
  const meam::TangentEstimationSettings& settings = {});
}
