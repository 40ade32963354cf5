// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"

#include <cmath>

namespace parts
{
meam::TriangleMesh box(const Eigen::Vector3f& low, const Eigen::Vector3f& high)
{
  meam::TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
  {
    mesh.vertices.emplace_back(
      corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(), corner & 4 ? high.z() : low.z());
  }
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
         { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } })
  {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  }
  return mesh;
}

meam::TriangleMesh prism(const std::vector<Eigen::Vector2f>& outline, float height)
{
  meam::TriangleMesh mesh;
  const int n = static_cast<int>(outline.size());
  for (const float z : { 0.0f, height })
  {
    for (const auto& corner : outline)
    {
      mesh.vertices.emplace_back(corner.x(), corner.y(), z);
    }
  }
  for (int i = 1; i + 1 < n; ++i)
  {
    mesh.triangles.emplace_back(0, i + 1, i);
    mesh.triangles.emplace_back(n, n + i, n + i + 1);
  }
  for (int i = 0; i < n; ++i)
  {
    const int j = (i + 1) % n;
    mesh.triangles.emplace_back(i, j, n + j);
    mesh.triangles.emplace_back(i, n + j, n + i);
  }
  return mesh;
}

meam::TriangleMesh regularPrism(int corners, double radius, float height)
{
  std::vector<Eigen::Vector2f> outline;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 2.0 * M_PI * i / corners;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return prism(outline, height);
}

meam::TriangleMesh rectangle(float width, float height)
{
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { width, 0, 0 }, { width, height, 0 }, { 0, height, 0 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return mesh;
}

meam::TriangleMesh lBracket()
{
  return prism({ { 18, 12 }, { 18, 40 }, { 0, 40 }, { 0, 0 }, { 60, 0 }, { 60, 12 } }, 15);
}

meam::TriangleMesh windowPlate()
{
  meam::TriangleMesh mesh;
  for (const float z : { 0.0f, 10.0f })
  {
    for (const auto& corner : { Eigen::Vector2f(0, 0), { 60, 0 }, { 60, 40 }, { 0, 40 }, //
           { 40, 14 }, { 54, 14 }, { 54, 34 }, { 40, 34 } })
    {
      mesh.vertices.emplace_back(corner.x(), corner.y(), z);
    }
  }
  const auto quad = [&](int a, int b, int c, int d)
  {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  };
  for (int i = 0; i < 4; ++i)
  {
    const int j = (i + 1) % 4;
    quad(8 + i, 8 + j, 12 + j, 12 + i); // top: the lower 8 corners are the bottom's, 4 outer and 4 of the window
    quad(i, 4 + i, 4 + j, j);
    quad(i, j, 8 + j, 8 + i);
    quad(4 + i, 12 + i, 12 + j, 4 + j);
  }
  return mesh;
}

meam::TriangleMesh blockOnPlate(bool mirrored)
{
  meam::TriangleMesh mesh = box({ 0.0f, 0.0f, 0.0f }, { 60.0f, 40.0f, 6.0f });
  const float left = mirrored ? 0.0f : 40.0f;
  const meam::TriangleMesh block = box({ left, 0.0f, 3.0f }, { left + 20.0f, 12.0f, 18.0f });
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), block.vertices.begin(), block.vertices.end());
  for (const auto& triangle : block.triangles)
  {
    mesh.triangles.push_back({ triangle[0] + first, triangle[1] + first, triangle[2] + first });
  }
  return mesh;
}

meam::TriangleMesh gear()
{
  constexpr int Corners = 40;
  meam::TriangleMesh mesh;
  for (const float z : { 0.0f, 10.0f })
  {
    for (int k = 0; k < Corners; ++k)
    {
      const bool tooth = k % 4 < 2 && k >= 4;
      const double angle = k * M_PI / 20.0;
      mesh.vertices.emplace_back((tooth ? 34.0 : 28.0) * std::cos(angle), (tooth ? 34.0 : 28.0) * std::sin(angle), z);
    }
  }
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, 10);
  for (int k = 0; k < Corners; ++k)
  {
    const int next = (k + 1) % Corners;
    mesh.triangles.push_back({ next, k, 2 * Corners });
    mesh.triangles.push_back({ Corners + k, Corners + next, 2 * Corners + 1 });
    mesh.triangles.push_back({ k, next, Corners + next });
    mesh.triangles.push_back({ k, Corners + next, Corners + k });
  }
  return mesh;
}

meam::TriangleMesh cutPlate() { return prism({ { -30, -30 }, { 30, -30 }, { 30, 20 }, { 6, 30 }, { -30, 30 } }, 10); }

Eigen::Isometry3d motion(std::mt19937& random, double reach)
{
  const auto number = [&] { return random() / 2147483648.0 - 1.0; };
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(number(), number(), number(), number()).normalized().toRotationMatrix();
  T.translation() = reach * Eigen::Vector3d(number(), number(), number());
  return T;
}

meam::Points moved(const meam::Points& points, const Eigen::Isometry3d& T)
{
  meam::Points result;
  for (const auto& point : points)
  {
    result.push_back((T * point.cast<double>()).cast<float>());
  }
  return result;
}

meam::PointCloud moved(const meam::PointCloud& cloud, const Eigen::Isometry3d& T)
{
  Eigen::Isometry3d R = Eigen::Isometry3d::Identity();
  R.linear() = T.linear();
  meam::PointCloud result = cloud;
  result.points = moved(cloud.points, T);
  result.normals = moved(cloud.normals, R);
  result.tangents = moved(cloud.tangents, R);
  return result;
}

meam::PrecisePoints moved(const meam::PrecisePoints& points, const Eigen::Isometry3d& T)
{
  meam::PrecisePoints result;
  for (const auto& point : points)
  {
    result.push_back(T * point);
  }
  return result;
}

meam::PrecisePoints precise(const meam::Points& points)
{
  meam::PrecisePoints result;
  for (const auto& point : points)
  {
    result.push_back(point.cast<double>());
  }
  return result;
}

meam::PrecisePoints skewed(int count)
{
  std::mt19937 random(4);
  std::gamma_distribution<double> distance(2.0, 1.0);
  meam::PrecisePoints points;
  for (int i = 0; i < count; ++i)
  {
    points.emplace_back(90.0 * distance(random), 40.0 * distance(random), 10.0 * distance(random));
  }
  return points;
}

meam::PointCloud withTangents(const meam::PointCloud& edges, double partDiameter, const Eigen::Vector3d& viewDirection,
  const meam::TangentEstimationSettings& settings)
{
  const meam::ThinnedEdges found =
    meam::estimateTangents(meam::toLocalCloud(edges), partDiameter, viewDirection, settings);
  Eigen::Isometry3d toScene = Eigen::Isometry3d::Identity();
  toScene.linear() = found.edges.T_local_scene.linear().transpose();
  meam::PointCloud result = edges.subset(found.indices);
  result.tangents = moved(found.edges.cloud.tangents, toScene);
  result.weights = found.edges.cloud.weights;
  return result;
}
}
