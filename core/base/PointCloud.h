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

/// Throws Error, naming `what`, when there is no point or when no point is finite.
void requirePoints(const Points& points, const std::string& what);
void requirePoints(std::size_t count, std::size_t finite, const std::string& what);

/// The cloud without points that have a coordinate, or a tangent, that is not finite.
PointCloud finitePoints(PointCloud cloud);

/// The points after a motion.
Points moved(const Points& points, const Eigen::Isometry3d& motion);
}
