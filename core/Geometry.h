// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace meam
{
using Points = std::vector<Eigen::Vector3f>;
using PrecisePoints = std::vector<Eigen::Vector3d>;

/// A part's surface: vertices in mm, triangles counter-clockwise seen from outside.
struct TriangleMesh
{
  Points vertices;
  std::vector<Eigen::Vector3i> triangles;
};

/// What an edge point of an appearance model is, in the image seen from its viewpoint.
enum class EdgeType : unsigned char
{
  Contour,   ///< the visible surface ends there; behind it is the background or another surface
  Crease,    ///< the visible surface goes on on both sides
  HoleBorder ///< the visible surface ends there; behind it is background that the part encloses
};

/// Points in mm with what is known of each; an array is empty or as long as `points`.
struct PointCloud
{
  Points points;
  Points normals;            ///< unit, outward
  Points tangents;           ///< unit direction of the edge; the sign carries no meaning
  std::vector<int> pointIds; ///< index of the surface sample: the point's identity across views
  std::vector<EdgeType> edgeTypes{};
  std::vector<float> weights{}; ///< how much each counts, [0, 1]

  std::size_t size() const { return this->points.size(); }
  bool empty() const { return this->points.empty(); }
  /// The points at `indices`, with every array that is there, in that order.
  PointCloud subset(const std::vector<int>& indices) const;
};

/// What is seen of a part from one viewpoint (paper, Section 4), or the whole part: all visible points
/// or, after boundary extraction, the edge points alone.
struct AppearanceModel
{
  std::string name;
  Eigen::Vector3f direction = Eigen::Vector3f::UnitZ(); ///< unit, from the part to the viewpoint
  PointCloud cloud;
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Constant(NAN); ///< mm; NaN when it is not known: far away
  bool wholePart = false; ///< no viewpoint: nothing of the part is hidden, and the direction is a mere name
};

/// Throws Error, naming `what`, when there is no point or when no point is finite.
void requirePoints(const Points& points, const std::string& what);
void requirePoints(std::size_t count, std::size_t finite, const std::string& what);

/// The cloud without points that have a coordinate, or a tangent, that is not finite.
PointCloud finitePoints(PointCloud cloud);

/// Axis-aligned bounds of the finite points.
Eigen::AlignedBox3f bounds(const Points& points);

/// Bounds without the given share of the points at each end of each axis.
Eigen::AlignedBox3f innerBounds(const Points& points, double share);

/// A right-handed frame whose first column is `axis`; a continuous function of it almost everywhere.
Eigen::Matrix3f frameAround(const Eigen::Vector3f& axis);

/// Takes points to their own principal frame (mean, axes of most and second most extent, signs by their skewness):
/// what is cut into cells and steps there does not depend on how the scene lies in its coordinates. Of `count` points, x y
/// z each, those that are finite and no strays far beyond all measure.
Eigen::Isometry3d principalFrame(const float* xyz, std::size_t count);
Eigen::Isometry3d principalFrame(const double* xyz, std::size_t count);
template <typename Scalar>
Eigen::Isometry3d principalFrame(const std::vector<Eigen::Matrix<Scalar, 3, 1>>& points)
{
  return principalFrame(points.empty() ? nullptr : points.front().data(), points.size());
}

/// The points after a motion.
Points moved(const Points& points, const Eigen::Isometry3d& motion);

/// Throws Error when a scene cannot be in the part's unit of length: its extent is far smaller or
/// larger than `partDiameter` allows. The message names the likely factor.
void requireSameUnits(const Points& scene, double partDiameter);

/// What to tell a user when a scene's extent is possible but unlikely for a part in the same unit, as with centimetres: it
/// names the likely factor. Empty when there is nothing to tell.
std::string unitsWarning(const Points& scene, double partDiameter);
}
