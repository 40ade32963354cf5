// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/Rasterizer.h"

#include "base/Error.h"

#include <map>

namespace meam
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double SmoothBelow = 0.85; // cosine of 32 degrees: facets that stand for one round surface

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

/// A facet's corners on the image, and one over their depths.
struct Projected
{
  std::array<Vector2d, 3> corners;
  Vector3d inverse;
};

Projected projected(const Facet& facet, const Camera& camera)
{
  Projected result;
  for (int k = 0; k < 3; ++k)
  {
    const Vector3d point = camera.T_camera_scene * facet.corners[k];
    if (!(point.z() > 0.0))
    {
      throw Error("The sensor is not above everything it looks at: raise it.");
    }
    result.inverse[k] = 1.0 / point.z();
    result.corners[k] << camera.fx * point.x() / point.z() + camera.cx, camera.fy * point.y() / point.z() + camera.cy;
  }
  return result;
}
}

std::vector<Facet> facetsOf(const std::vector<Body>& bodies)
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
      }
      facets.push_back(facet);
    }
  }
  return facets;
}

View rasterize(const std::vector<Facet>& facets, double floor, const Camera& camera)
{
  const std::size_t pixels = static_cast<std::size_t>(camera.width) * camera.height;
  View view;
  view.depths.resize(pixels);
  view.normals.assign(pixels, Vector3d(0, 0, -1));
  view.bodies.assign(pixels, -1);
  // The floor: a ray rises in the scene by `slope` for each mm along the camera's z.
  const Eigen::Isometry3d T_scene_camera = camera.T_camera_scene.inverse();
  for (std::size_t i = 0; i < pixels; ++i)
  {
    const Vector3d ray = rayThrough(i, camera);
    const double slope = T_scene_camera.linear().row(2).dot(ray);
    view.depths[i] = (floor - T_scene_camera.translation().z()) / slope;
  }
  for (const Facet& facet : facets)
  {
    const Projected image = projected(facet, camera);
    forEachPixel(image.corners, camera.width, camera.height,
      [&](int column, int row, const Vector3d& weights)
      {
        const std::size_t pixel = static_cast<std::size_t>(row) * camera.width + column;
        // 1 / z is linear on the image.
        const double depth = 1.0 / weights.dot(image.inverse);
        if (depth < view.depths[pixel])
        {
          const Vector3d share = depth * weights.cwiseProduct(image.inverse);
          view.depths[pixel] = depth;
          view.normals[pixel] = share[0] * facet.normals[0] + share[1] * facet.normals[1] + share[2] * facet.normals[2];
          view.bodies[pixel] = facet.body;
        }
      });
  }
  return view;
}

std::vector<Mask> silhouettesOf(const std::vector<Facet>& facets, int bodies, const Camera& camera)
{
  std::vector<Eigen::AlignedBox2d> boxes(bodies);
  for (const Facet& facet : facets)
  {
    for (int k = 0; facet.body < bodies && k < 3; ++k)
    {
      boxes[facet.body].extend(projected(facet, camera).corners[k]);
    }
  }
  std::vector<Mask> masks(bodies);
  for (int i = 0; i < bodies; ++i)
  {
    // Pixels are where both of their coordinates are whole numbers.
    const Eigen::Array2d low = boxes[i].min().array().ceil().max(0.0);
    const Eigen::Array2d high = boxes[i].max().array().floor().min(Eigen::Array2d(camera.width - 1, camera.height - 1));
    if ((high >= low).all())
    {
      masks[i].left = static_cast<int>(low.x());
      masks[i].top = static_cast<int>(low.y());
      masks[i].width = static_cast<int>(high.x() - low.x()) + 1;
      masks[i].height = static_cast<int>(high.y() - low.y()) + 1;
      masks[i].pixels.assign(static_cast<std::size_t>(masks[i].width) * masks[i].height, 0);
    }
  }
  for (const Facet& facet : facets)
  {
    if (facet.body < bodies)
    {
      Mask& mask = masks[facet.body];
      Projected image = projected(facet, camera);
      for (Vector2d& corner : image.corners)
      {
        corner -= Vector2d(mask.left, mask.top);
      }
      forEachPixel(image.corners, mask.width, mask.height,
        [&](int column, int row, const Vector3d&)
        { mask.pixels[static_cast<std::size_t>(row) * mask.width + column] = 255; });
    }
  }
  return masks;
}
}
