// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"

#include "base/sequences/Sequences.h"
#include "mesh/SurfaceSampling.h"

#include <cmath>
#include <map>

namespace
{
void addQuad(meam::TriangleMesh& mesh, int a, int b, int c, int d)
{
  mesh.triangles.emplace_back(a, b, c);
  mesh.triangles.emplace_back(a, c, d);
}
}

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
    addQuad(mesh, a, b, c, d);
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
    addQuad(mesh, i, j, n + j, n + i);
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

meam::TriangleMesh frame(float outer, float inner)
{
  meam::TriangleMesh mesh;
  for (const float half : { outer, inner })
  {
    mesh.vertices.insert(
      mesh.vertices.end(), { { -half, -half, 0 }, { half, -half, 0 }, { half, half, 0 }, { -half, half, 0 } });
  }
  for (int i = 0; i < 4; ++i)
  {
    addQuad(mesh, i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4);
  }
  return mesh;
}

meam::TriangleMesh holedPlate(const Eigen::AlignedBox2f& outer, const Eigen::AlignedBox2f& hole, float height)
{
  meam::TriangleMesh mesh;
  for (const float z : { 0.0f, height })
  {
    for (const auto& [low, high] : { std::pair(outer.min(), outer.max()), std::pair(hole.min(), hole.max()) })
    {
      mesh.vertices.insert(mesh.vertices.end(),
        { { low.x(), low.y(), z }, { high.x(), low.y(), z }, { high.x(), high.y(), z }, { low.x(), high.y(), z } });
    }
  }
  for (int i = 0; i < 4; ++i)
  {
    const int j = (i + 1) % 4;
    addQuad(mesh, 8 + i, 8 + j, 12 + j, 12 + i); // top: the lower 8 corners are the bottom's, 4 outer and 4 of the hole
    addQuad(mesh, i, 4 + i, 4 + j, j);
    addQuad(mesh, i, j, 8 + j, 8 + i);
    addQuad(mesh, 4 + i, 12 + i, 12 + j, 4 + j);
  }
  return mesh;
}

meam::TriangleMesh windowPlate()
{
  using Corner = Eigen::Vector2f;
  return holedPlate({ Corner(0, 0), Corner(60, 40) }, { Corner(40, 14), Corner(54, 34) }, 10);
}

meam::TriangleMesh revolved(const std::vector<Eigen::Vector2d>& profile, int sides)
{
  meam::TriangleMesh mesh;
  const int n = static_cast<int>(profile.size());
  for (int i = 0; i < sides; ++i)
  {
    const double angle = 2.0 * M_PI * i / sides;
    const int next = (i + 1) % sides;
    for (int k = 0; k < n; ++k)
    {
      const Eigen::Vector2d& p = profile[k];
      mesh.vertices.push_back(Eigen::Vector3d(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()).cast<float>());
      addQuad(mesh, i * n + k, next * n + k, next * n + (k + 1) % n, i * n + (k + 1) % n);
    }
  }
  return mesh;
}

meam::TriangleMesh divided(meam::TriangleMesh mesh, int times)
{
  for (; times > 0; --times)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b)
    {
      const auto [found, isNew] = middles.emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (isNew)
      {
        mesh.vertices.push_back(0.5f * (mesh.vertices[a] + mesh.vertices[b]));
      }
      return found->second;
    };
    std::vector<Eigen::Vector3i> triangles;
    for (const auto& t : mesh.triangles)
    {
      const Eigen::Vector3i m(middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0]));
      triangles.insert(triangles.end(), { { t[0], m[0], m[2] }, { m[0], t[1], m[1] }, { m[2], m[1], t[2] }, m });
    }
    mesh.triangles = triangles;
  }
  return mesh;
}

meam::TriangleMesh sphere(float radius, int divisions)
{
  meam::TriangleMesh mesh;
  mesh.vertices = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  mesh.triangles = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 }, { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 },
    { 0, 3, 5 } };
  mesh = divided(mesh, divisions);
  for (auto& vertex : mesh.vertices)
  {
    vertex = radius * vertex.normalized();
  }
  return mesh;
}

meam::TriangleMesh joined(meam::TriangleMesh mesh, const meam::TriangleMesh& other)
{
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& triangle : other.triangles)
  {
    mesh.triangles.push_back(triangle.array() + first);
  }
  return mesh;
}

meam::TriangleMesh soup(const meam::TriangleMesh& mesh)
{
  meam::TriangleMesh loose;
  for (const auto& t : mesh.triangles)
  {
    loose = joined(loose, { { mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]] }, { { 0, 1, 2 } } });
  }
  return loose;
}

double area(const meam::TriangleMesh& mesh)
{
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
  {
    const Eigen::Vector3f a = mesh.vertices[t[0]];
    sum += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return sum;
}

double volume(const meam::TriangleMesh& mesh)
{
  const auto corner = [&](int vertex) -> Eigen::Vector3d { return mesh.vertices[vertex].cast<double>(); };
  return meam::sumOf(
           mesh.triangles, [&](const auto& t) { return corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))); }) /
         6.0;
}

meam::PointCloud sampled(const meam::TriangleMesh& mesh, double spacing)
{
  meam::SurfaceSamplingSettings settings;
  settings.spacing = spacing;
  return meam::sampleSurface(mesh, settings);
}

meam::TriangleMesh blockOnPlate(bool mirrored)
{
  const float left = mirrored ? 0.0f : 40.0f;
  return joined(
    box({ 0.0f, 0.0f, 0.0f }, { 60.0f, 40.0f, 6.0f }), box({ left, 0.0f, 3.0f }, { left + 20.0f, 12.0f, 18.0f }));
}

meam::TriangleMesh tower()
{
  return joined(box({ 0.0f, 0.0f, 0.0f }, { 60.0f, 40.0f, 6.0f }), box({ 40.0f, 0.0f, 3.0f }, { 60.0f, 16.0f, 40.0f }));
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
    addQuad(mesh, k, next, Corners + next, Corners + k);
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

meam::PointCloud moved(const meam::PointCloud& cloud, const Eigen::Isometry3d& T)
{
  Eigen::Isometry3d R = Eigen::Isometry3d::Identity();
  R.linear() = T.linear();
  meam::PointCloud result = cloud;
  result.points = meam::moved(cloud.points, T);
  result.normals = meam::moved(cloud.normals, R);
  result.tangents = meam::moved(cloud.tangents, R);
  return result;
}

meam::PrecisePoints moved(const meam::PrecisePoints& points, const Eigen::Isometry3d& T)
{
  return meam::mapped<Eigen::Vector3d>(points, [&](const auto& point) -> Eigen::Vector3d { return T * point; });
}

meam::Points lattice(
  const Eigen::Vector2f& low, const Eigen::Vector2f& high, float step, const std::function<float(float, float)>& z)
{
  const Eigen::Array2i counts = ((high - low).array() / step).round().cast<int>() + 1;
  meam::Points points;
  for (int k = 0; k < counts.prod(); ++k)
  {
    const float x = low.x() + step * (k / counts.y()), y = low.y() + step * (k % counts.y());
    points.emplace_back(x, y, z(x, y));
  }
  return points;
}

meam::Points lattice(const Eigen::Vector2f& low, const Eigen::Vector2f& high, float step, float z)
{
  return lattice(low, high, step, [z](float, float) { return z; });
}

void add(meam::Points& points, const meam::Points& more) { points.insert(points.end(), more.begin(), more.end()); }

meam::PointCloud facing(const meam::Points& points, const Eigen::Vector3f& normal)
{
  meam::PointCloud result;
  result.points = points;
  result.normals.assign(points.size(), normal);
  return result;
}

meam::Points scattered(int count, double reach) { return scatteredEdges(count, reach).points; }

meam::PointCloud scatteredEdges(int count, double reach)
{
  std::mt19937 random(9);
  meam::PointCloud edges;
  for (int i = 0; i < count; ++i)
  {
    const Eigen::Isometry3d T = motion(random, reach);
    edges.points.push_back(T.translation().cast<float>());
    edges.tangents.push_back(T.linear().col(0).cast<float>());
  }
  return edges;
}

meam::PrecisePoints precise(const meam::Points& points)
{
  return meam::mapped<Eigen::Vector3d>(
    points, [&](const Eigen::Vector3f& point) -> Eigen::Vector3d { return point.cast<double>(); });
}

meam::PrecisePoints skewed(int count)
{
  std::mt19937 random(4);
  std::gamma_distribution<double> distance(2.0, 1.0);
  return meam::ofIndices<Eigen::Vector3d>(count,
    [&](int) { return Eigen::Vector3d(90.0 * distance(random), 40.0 * distance(random), 10.0 * distance(random)); });
}

meam::PointCloud withTangents(const meam::PointCloud& edges, double partDiameter, const Eigen::Vector3d& viewDirection,
  const meam::TangentEstimationSettings& settings)
{
  const meam::ThinnedEdges found =
    meam::estimateTangents(meam::toLocalCloud(edges), partDiameter, viewDirection, settings);
  Eigen::Isometry3d toScene = Eigen::Isometry3d::Identity();
  toScene.linear() = found.edges.T_local_scene.linear().transpose();
  meam::PointCloud result = edges.subset(found.indices);
  result.tangents = meam::moved(found.edges.cloud.tangents, toScene);
  result.weights = found.edges.cloud.weights;
  return result;
}
}
