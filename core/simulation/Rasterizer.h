// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"
#include "scene/Camera.h"

#include <algorithm>
#include <array>

namespace meam
{
/// Something a virtual camera looks at.
struct Body
{
  const TriangleMesh* mesh = nullptr;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity(); ///< mm
  Eigen::Vector3d albedo = Eigen::Vector3d::Constant(0.6);         ///< shares of red, green and blue light it reflects
};

/// A triangle of a body, in the scene (mm).
struct Facet
{
  std::array<Eigen::Vector3d, 3> corners;
  std::array<Eigen::Vector3d, 3> normals; ///< unit, of the round surface that it stands for
  int body;
};

/// The triangles of all bodies, body by body.
std::vector<Facet> facetsOf(const std::vector<Body>& bodies);

/// What a camera sees of the nearest surface, pixel by pixel.
struct View
{
  std::vector<double> depths;           ///< mm along the camera's z
  std::vector<Eigen::Vector3d> normals; ///< in the scene; of any length
  std::vector<int> bodies;              ///< -1: the floor
};

/// The ray through the middle of a pixel, counted row by row, up to z = 1.
inline Eigen::Vector3d rayThrough(std::size_t pixel, const Camera& camera)
{
  const int column = static_cast<int>(pixel % camera.width);
  const int row = static_cast<int>(pixel / camera.width);
  return { (column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1.0 };
}

/// Renders facets above an endless floor, the plane z = `floor` of the scene (mm). The camera has no distortion.
/// Throws Error when something is not in front of the camera.
View rasterize(const std::vector<Facet>& facets, double floor, const Camera& camera);

/// A region of an image.
struct Mask
{
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels; ///< row by row; 255 where it is set, otherwise 0

  int count() const { return static_cast<int>(std::count(this->pixels.begin(), this->pixels.end(), 255)); }
};

/// Where each of the first `bodies` bodies would be seen if it were alone, in its narrowest frame.
std::vector<Mask> silhouettesOf(const std::vector<Facet>& facets, int bodies, const Camera& camera);

/// Calls visit(column, row, weights of the corners) for the pixels whose middle is in the triangle.
template <typename Visitor>
void forEachPixel(const std::array<Eigen::Vector2d, 3>& p, int width, int height, Visitor&& visit)
{
  using Eigen::Vector2d;
  const Vector2d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
  const Vector2d high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  const double area = cross(p[1] - p[0], p[2] - p[0]);
  if (area == 0.0 || !(low.x() < width) || !(low.y() < height) || !(high.x() >= 0.0) || !(high.y() >= 0.0))
  {
    return;
  }
  const int left = static_cast<int>(std::ceil(std::max(low.x(), 0.0)));
  const int right = static_cast<int>(std::floor(std::min(high.x(), width - 1.0)));
  const int top = static_cast<int>(std::ceil(std::max(low.y(), 0.0)));
  const int bottom = static_cast<int>(std::floor(std::min(high.y(), height - 1.0)));
  for (int row = top; row <= bottom; ++row)
  {
    for (int column = left; column <= right; ++column)
    {
      const Vector2d at(column, row);
      const Eigen::Vector3d weights(cross(p[2] - p[1], at - p[1]) / area, cross(p[0] - p[2], at - p[2]) / area,
        cross(p[1] - p[0], at - p[0]) / area);
      if (weights.minCoeff() >= 0.0)
      {
        visit(column, row, weights);
      }
    }
  }
}
}
