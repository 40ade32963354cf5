// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/Lighting.h"

#include "base/sequences/Sequences.h"

#include <cmath>
#include <limits>

namespace meam
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double ShadowMapCells = 1000.0;
constexpr double Ambient = 0.34;
constexpr double Texture = 0.03;  // share of the albedo, standard deviation of its spots
constexpr double SpotSize = 0.05; // of the nearness

struct Lamp
{
  Vector3d towards;
  double strength;
};
const std::array<Lamp, 2> Lamps{ Lamp{ Vector3d(-0.55, -0.40, -0.73).normalized(), 0.62 },
  Lamp{ Vector3d(0.62, 0.30, -0.72).normalized(), 0.22 } };

/// Which points a lamp reaches: the distance along its light of what it meets first.
class ShadowMap
{
public:
  ShadowMap(const std::vector<Facet>& facets, const Lamp& lamp)
    : Side(lamp.towards.unitOrthogonal())
    , Up(lamp.towards.cross(this->Side))
    , Towards(lamp.towards)
  {
    Eigen::AlignedBox2d box;
    for (const Facet& facet : facets)
    {
      for (const auto& corner : facet.corners)
      {
        box.extend(this->onMap(corner));
      }
    }
    this->CellSize = std::max(box.isEmpty() ? 0.0 : box.sizes().maxCoeff(), 1e-9) / ShadowMapCells;
    this->Origin = box.isEmpty() ? Vector2d::Zero().eval() : box.min();
    this->Heights.assign(static_cast<std::size_t>(Size) * Size, -std::numeric_limits<float>::infinity());
    for (const Facet& facet : facets)
    {
      std::array<Vector2d, 3> corners;
      Vector3d heights;
      for (int k = 0; k < 3; ++k)
      {
        corners[k] = this->cellOf(facet.corners[k]);
        heights[k] = facet.corners[k].dot(this->Towards);
      }
      forEachPixel(corners, Size, Size,
        [&](int column, int row, const Vector3d& weights)
        {
          float& height = this->Heights[static_cast<std::size_t>(row) * Size + column];
          height = std::max(height, static_cast<float>(heights.dot(weights)));
        });
    }
  }

  /// The share of the light that arrives at a surface point, softened over a few cells.
  double light(const Vector3d& point, const Vector3d& normal) const
  {
    // A little above the surface, so that it does not shade itself.
    const Vector3d above = point + 2.0 * this->CellSize * normal;
    const Vector2d cell = this->cellOf(above);
    const double height = above.dot(this->Towards) + 2.0 * this->CellSize;
    int lit = 0;
    for (int dy = -2; dy <= 2; ++dy)
    {
      for (int dx = -2; dx <= 2; ++dx)
      {
        const int column = static_cast<int>(std::lround(cell.x())) + dx;
        const int row = static_cast<int>(std::lround(cell.y())) + dy;
        const bool inside = column >= 0 && row >= 0 && column < Size && row < Size;
        lit += !inside || this->Heights[static_cast<std::size_t>(row) * Size + column] <= height;
      }
    }
    return lit / 25.0;
  }

private:
  static constexpr int Size = static_cast<int>(ShadowMapCells) + 1;
  Vector2d onMap(const Vector3d& point) const { return { point.dot(this->Side), point.dot(this->Up) }; }
  Vector2d cellOf(const Vector3d& point) const { return (this->onMap(point) - this->Origin) / this->CellSize; }

  Vector3d Side;
  Vector3d Up;
  Vector3d Towards;
  Vector2d Origin;
  double CellSize;
  std::vector<float> Heights;
};

/// The mean over a square window around each pixel.
std::vector<double> boxMean(const std::vector<double>& values, int width, int height, int radius)
{
  std::vector<double> sums(static_cast<std::size_t>(width + 1) * (height + 1), 0.0);
  const auto at = [&](int row, int column) -> double&
  { return sums[static_cast<std::size_t>(row) * (width + 1) + column]; };
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      at(row + 1, column + 1) = values[static_cast<std::size_t>(row) * width + column] + at(row, column + 1) +
                                at(row + 1, column) - at(row, column);
    }
  }
  std::vector<double> means(values.size());
  for (int row = 0; row < height; ++row)
  {
    const int top = std::max(row - radius, 0);
    const int bottom = std::min(row + radius + 1, height);
    for (int column = 0; column < width; ++column)
    {
      const int left = std::max(column - radius, 0);
      const int right = std::min(column + radius + 1, width);
      means[static_cast<std::size_t>(row) * width + column] =
        (at(bottom, right) - at(top, right) - at(bottom, left) + at(top, left)) / ((bottom - top) * (right - left));
    }
  }
  return means;
}

/// A number in [-1, 1] for each corner of a grid, always the same.
double spotAt(int x, int y, int z)
{
  std::uint32_t hash = 73856093u * static_cast<std::uint32_t>(x) ^ 19349663u * static_cast<std::uint32_t>(y) ^
                       83492791u * static_cast<std::uint32_t>(z);
  hash = (hash ^ (hash >> 13)) * 1274126177u;
  return static_cast<double>((hash ^ (hash >> 16)) & 0xffffu) / 32767.5 - 1.0;
}

/// Spots on a surface, smooth between the corners of a grid of side 1.
double spots(const Vector3d& point)
{
  const Vector3d low = point.array().floor();
  const Vector3d t = point - low;
  double sum = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    const Eigen::Vector3i step(i & 1, (i >> 1) & 1, i >> 2);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      weight *= step[axis] ? t[axis] : 1.0 - t[axis];
    }
    const Eigen::Vector3i corner = low.cast<int>() + step;
    sum += weight * spotAt(corner.x(), corner.y(), corner.z());
  }
  return sum;
}
}

std::vector<Eigen::Vector3f> illuminate(const View& view, const Camera& camera, const std::vector<Facet>& facets,
  const std::vector<Body>& bodies, const Eigen::Vector3d& floorAlbedo, double nearness, const Progress& progress)
{
  const std::array<ShadowMap, 2> shadows{ ShadowMap(facets, Lamps[0]), ShadowMap(facets, Lamps[1]) };
  report(progress, 0.3);
  const double middle = *std::max_element(view.depths.begin(), view.depths.end());
  const int around = std::max(2, static_cast<int>(std::lround(nearness * camera.fx / middle)));
  const std::vector<double> surroundings = boxMean(view.depths, camera.width, camera.height, around);
  report(progress, 0.4);
  const Eigen::Isometry3d T_scene_camera = camera.T_camera_scene.inverse();
  const auto T_model_scene =
    mapped<Eigen::Isometry3d>(bodies, [&](const Body& body) { return body.T_scene_model.inverse(); });
  std::vector<Eigen::Vector3f> colors(view.depths.size());
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    const Vector3d ray = rayThrough(i, camera);
    const Vector3d point = T_scene_camera * (view.depths[i] * ray);
    Vector3d normal = view.normals[i].normalized();
    if (normal.dot(T_scene_camera.linear() * ray) > 0.0)
    {
      normal = -normal; // the inside of an open mesh
    }
    // Less of the ambient light reaches what lies deeper than its surroundings.
    const double depth = std::clamp((view.depths[i] - surroundings[i]) / nearness, -0.5, 1.0);
    double light = Ambient * (1.0 - 0.6 * depth);
    for (std::size_t k = 0; k < Lamps.size(); ++k)
    {
      const double facing = normal.dot(Lamps[k].towards);
      if (facing > 0.0)
      {
        light += Lamps[k].strength * facing * shadows[k].light(point, normal);
      }
    }
    const int body = view.bodies[i];
    const Vector3d onSurface = body < 0 ? point : T_model_scene[body] * point;
    light *= 1.0 + Texture * spots(onSurface / (SpotSize * nearness));
    colors[i] = (light * (body < 0 ? floorAlbedo : bodies[body].albedo)).cast<float>();
    if (i % camera.width == 0)
    {
      report(progress, 0.4 + 0.6 * static_cast<double>(i) / colors.size());
    }
  }
  return colors;
}
}
