// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/VirtualSensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace meam
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double SmoothBelow = 0.85;   // cosine of 32 degrees: facets that stand for one round surface
constexpr double GrazingCosine = 0.12; // a surface that is seen flatter gives no depth
constexpr double ShadowMapCells = 1000.0;
constexpr double Ambient = 0.34;

struct Lamp
{
  Vector3d towards;
  double strength;
};
const std::array<Lamp, 2> Lamps{ Lamp{ Vector3d(-0.55, -0.40, -0.73).normalized(), 0.62 },
  Lamp{ Vector3d(0.62, 0.30, -0.72).normalized(), 0.22 } };

/// A corner's normal for shading: the mean over the faces around it that belong to the same round
/// surface.
std::vector<std::array<Vector3d, 3>> cornerNormals(const TriangleMesh& mesh)
{
  const auto before = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b)
  { return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3); };
  std::map<Eigen::Vector3f, std::vector<int>, decltype(before)> facesAt(before);
  std::vector<Vector3d> areas;
  for (const auto& t : mesh.triangles)
  {
    const Vector3d a = mesh.vertices[t[0]].cast<double>();
    areas.push_back((mesh.vertices[t[1]].cast<double>() - a).cross(mesh.vertices[t[2]].cast<double>() - a));
    for (const int corner : t)
    {
      facesAt[mesh.vertices[corner]].push_back(static_cast<int>(areas.size()) - 1);
    }
  }
  std::vector<std::array<Vector3d, 3>> normals(mesh.triangles.size());
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      Vector3d sum = Vector3d::Zero();
      for (const int face : facesAt[mesh.vertices[mesh.triangles[i][k]]])
      {
        if (areas[face].dot(areas[i]) >= SmoothBelow * areas[face].norm() * areas[i].norm())
        {
          sum += areas[face];
        }
      }
      normals[i][k] = sum.normalized();
    }
  }
  return normals;
}

/// Calls visit(column, row, weights of the corners) for the pixels whose middle is in the triangle.
template <typename Visitor>
void forEachPixel(const std::array<Vector2d, 3>& p, int width, int height, Visitor&& visit)
{
  const Vector2d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
  const Vector2d high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  const double area = cross(p[1] - p[0], p[2] - p[0]);
  if (area == 0.0 || !(low.x() < width) || !(low.y() < height) || !(high.x() >= 0.0) || !(high.y() >= 0.0))
  {
    return;
  }
  const int left = std::max(static_cast<int>(std::ceil(std::max(low.x(), 0.0))), 0);
  const int right = static_cast<int>(std::floor(std::min(high.x(), width - 1.0)));
  const int top = std::max(static_cast<int>(std::ceil(std::max(low.y(), 0.0))), 0);
  const int bottom = static_cast<int>(std::floor(std::min(high.y(), height - 1.0)));
  for (int row = top; row <= bottom; ++row)
  {
    for (int column = left; column <= right; ++column)
    {
      const Vector2d at(column, row);
      const Vector3d weights(cross(p[2] - p[1], at - p[1]) / area, cross(p[0] - p[2], at - p[2]) / area,
        cross(p[1] - p[0], at - p[0]) / area);
      if (weights.minCoeff() >= 0.0)
      {
        visit(column, row, weights);
      }
    }
  }
}

/// The bodies' triangles in the sensor's frame.
struct Facet
{
  std::array<Vector3d, 3> corners;
  std::array<Vector3d, 3> normals;
  int body;
};

std::vector<Facet> facetsOf(const std::vector<Body>& bodies, double nearest)
{
  std::map<const TriangleMesh*, std::vector<std::array<Vector3d, 3>>> normalsOf;
  std::vector<Facet> facets;
  for (std::size_t b = 0; b < bodies.size(); ++b)
  {
    const Body& body = bodies[b];
    auto& normals = normalsOf[body.mesh];
    if (normals.empty())
    {
      normals = cornerNormals(*body.mesh);
    }
    for (std::size_t i = 0; i < body.mesh->triangles.size(); ++i)
    {
      Facet facet;
      facet.body = static_cast<int>(b);
      for (int k = 0; k < 3; ++k)
      {
        facet.corners[k] = body.T_scene_model * body.mesh->vertices[body.mesh->triangles[i][k]].cast<double>();
        facet.normals[k] = body.T_scene_model.linear() * normals[i][k];
        if (!(facet.corners[k].z() > nearest))
        {
          throw Error("The sensor is not above everything it looks at: raise it.");
        }
      }
      facets.push_back(facet);
    }
  }
  return facets;
}

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

/// The blur of a lens: 1 2 1 in both directions.
std::vector<double> blurred(const std::vector<double>& values, int width, int height)
{
  std::vector<double> result = values;
  const auto pass = [&](int length, int lines, std::size_t step, std::size_t line)
  {
    const std::vector<double> from = result;
    for (int k = 0; k < lines; ++k)
    {
      for (int i = 0; i < length; ++i)
      {
        const std::size_t at = k * line + i * step;
        result[at] = 0.5 * from[at] + 0.25 * (from[i > 0 ? at - step : at] + from[i + 1 < length ? at + step : at]);
      }
    }
  };
  pass(width, height, 1, width);
  pass(height, width, width, 1);
  return result;
}
}

SensorData renderBodies(
  const std::vector<Body>& bodies, const VirtualSensorSettings& settings, Random& random, const Progress& progress)
{
  const int width = settings.width;
  const int height = settings.height;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  const Vector2d middle(0.5 * (width - 1), 0.5 * (height - 1));
  const std::vector<Facet> facets = facetsOf(bodies, 0.01 * settings.floor);
  const auto rayOf = [&](std::size_t i)
  {
    return Vector3d((static_cast<double>(i % width) - middle.x()) / settings.focalLength,
      (static_cast<double>(i / width) - middle.y()) / settings.focalLength, 1.0);
  };

  // Depth: the nearest facet of each pixel.
  SensorData result;
  result.bodyOfPixel.assign(pixels, -1);
  result.visiblePixels.assign(bodies.size(), 0);
  result.alonePixels.assign(bodies.size(), 0);
  std::vector<double> depths(pixels, settings.floor);
  std::vector<Vector3d> normals(pixels, Vector3d(0, 0, -1));
  std::vector<int> lastBody(pixels, -1);
  for (const Facet& facet : facets)
  {
    std::array<Vector2d, 3> corners;
    Vector3d inverse;
    for (int k = 0; k < 3; ++k)
    {
      inverse[k] = 1.0 / facet.corners[k].z();
      corners[k] = settings.focalLength * inverse[k] * facet.corners[k].head<2>() + middle;
    }
    forEachPixel(corners, width, height,
      [&](int column, int row, const Vector3d& weights)
      {
        const std::size_t pixel = static_cast<std::size_t>(row) * width + column;
        if (lastBody[pixel] != facet.body)
        {
          lastBody[pixel] = facet.body;
          ++result.alonePixels[facet.body];
        }
        // 1 / z is linear on the image.
        const double depth = 1.0 / weights.dot(inverse);
        if (depth < depths[pixel])
        {
          const Vector3d share = depth * weights.cwiseProduct(inverse);
          depths[pixel] = depth;
          normals[pixel] = share[0] * facet.normals[0] + share[1] * facet.normals[1] + share[2] * facet.normals[2];
          result.bodyOfPixel[pixel] = facet.body;
        }
      });
  }
  report(progress, 0.4);

  // Light: lamps with shadows, and less of the ambient light for what lies deeper than its
  // surroundings.
  const std::array<ShadowMap, 2> shadows{ ShadowMap(facets, Lamps[0]), ShadowMap(facets, Lamps[1]) };
  report(progress, 0.6);
  const int around =
    std::max(2, static_cast<int>(std::lround(settings.nearness * settings.focalLength / settings.floor)));
  const std::vector<double> surroundings = boxMean(depths, width, height, around);
  std::vector<double> light(pixels);
  std::vector<double> cosines(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    const Vector3d ray = rayOf(i);
    const Vector3d point = depths[i] * ray;
    Vector3d normal = normals[i].normalized();
    cosines[i] = -normal.dot(ray) / ray.norm();
    if (cosines[i] < 0.0)
    {
      normal = -normal; // the inside of an open mesh
      cosines[i] = -cosines[i];
    }
    const double depth = std::clamp((depths[i] - surroundings[i]) / settings.nearness, -0.5, 1.0);
    light[i] = Ambient * (1.0 - 0.6 * depth);
    for (std::size_t k = 0; k < Lamps.size(); ++k)
    {
      const double facing = normal.dot(Lamps[k].towards);
      if (facing > 0.0)
      {
        light[i] += Lamps[k].strength * facing * shadows[k].light(point, normal);
      }
    }
    const int body = result.bodyOfPixel[i];
    light[i] *= body < 0 ? settings.floorAlbedo : bodies[body].albedo;
  }
  report(progress, 0.8);

  result.image.width = result.cloud.width = width;
  result.image.height = result.cloud.height = height;
  result.image.pixels.resize(pixels);
  result.cloud.points.resize(pixels);
  const std::vector<double> image = blurred(light, width, height);
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < pixels; ++i)
  {
    const double grey = 255.0 * image[i] + settings.imageNoise * random.normal();
    result.image.pixels[i] = static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0, 255.0)));
    const Vector3d ray = rayOf(i);
    const double noise = settings.depthNoise * random.normal() / ray.norm();
    const bool lost = random.uniform() < settings.dropout || cosines[i] < GrazingCosine;
    result.cloud.points[i] =
      lost ? Eigen::Vector3f::Constant(nothing) : Eigen::Vector3f(((depths[i] + noise) * ray).cast<float>());
    if (result.bodyOfPixel[i] >= 0)
    {
      ++result.visiblePixels[result.bodyOfPixel[i]];
    }
  }
  report(progress, 1.0);
  return result;
}
}
