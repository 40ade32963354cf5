// SPDX-License-Identifier: BSD-3-Clause
#include "model/edges/VisibleEdges.h"

#include "base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace meam
{
namespace
{
constexpr double HairsFromEdge = 4.0; // a face is looked at this far from its edge

Eigen::Vector3d vertexOf(const TriangleMesh& mesh, int face, int corner)
{
  return mesh.vertices[mesh.triangles[face][corner]].cast<double>();
}

int cornerOf(const TriangleMesh& mesh, int face, int vertex)
{
  const Eigen::Vector3i& triangle = mesh.triangles[face];
  return triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
}

/// Barycentric coordinates of a point of the face.
Eigen::Vector3d weightsOf(const TriangleMesh& mesh, int face, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d a = vertexOf(mesh, face, 0);
  const Eigen::Vector3d b = vertexOf(mesh, face, 1);
  const Eigen::Vector3d c = vertexOf(mesh, face, 2);
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double v = (point - a).cross(c - a).dot(normal) / normal.squaredNorm();
  const double w = (b - a).cross(point - a).dot(normal) / normal.squaredNorm();
  return { 1.0 - v - w, v, w };
}
}

VisibleEdges::VisibleEdges(const TriangleMesh& mesh, double sharpAngle, double spacing, double edgeOn)
  : Mesh(mesh)
  , Sight(mesh)
  , Spacing(spacing)
  , EdgeOn(edgeOn)
  , Edges(edgesOf(mesh))
  , FaceNormals(faceNormals(mesh, Edges))
{
  const float flattest = static_cast<float>(std::cos(sharpAngle * M_PI / 180.0));
  std::vector<std::array<int, 2>> features;
  std::vector<int> edgeOfFeature;
  this->IsFeature.resize(this->Edges.size());
  for (std::size_t e = 0; e < this->Edges.size(); ++e)
  {
    const MeshEdge& edge = this->Edges[e];
    this->IsFeature[e] =
      edge.faceCount != 2 || this->FaceNormals[edge.faces[0]].dot(this->FaceNormals[edge.faces[1]]) < flattest;
    if (this->IsFeature[e])
    {
      features.push_back(edge.vertices);
      edgeOfFeature.push_back(static_cast<int>(e));
    }
  }
  this->Features = sampleEdges(mesh.vertices, features, spacing);
  for (EdgeSample& sample : this->Features)
  {
    sample.edge = edgeOfFeature[sample.edge];
  }
  this->EdgesOfFace.resize(mesh.triangles.size());
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto [low, high] = std::minmax(mesh.triangles[face][k], mesh.triangles[face][(k + 1) % 3]);
      const std::array<int, 2> vertices{ low, high };
      const auto place = std::lower_bound(this->Edges.begin(), this->Edges.end(), vertices,
        [](const MeshEdge& edge, const auto& wanted) { return edge.vertices < wanted; });
      this->EdgesOfFace[face][k] = static_cast<int>(place - this->Edges.begin());
    }
  }
  this->findCornerNormals();
}

/// Corners at a vertex that are joined by edges that are not sharp share a normal, the mean of their faces
/// by area and angle: a large flat face keeps its own beside a narrow fillet, and it does not matter how a
/// facet is cut into triangles.
void VisibleEdges::findCornerNormals()
{
  const std::size_t faces = this->Mesh.triangles.size();
  std::vector<int> leader(3 * faces);
  std::iota(leader.begin(), leader.end(), 0);
  const auto leaderOf = [&](int corner)
  {
    while (leader[corner] != corner)
    {
      corner = leader[corner] = leader[leader[corner]];
    }
    return corner;
  };
  for (std::size_t e = 0; e < this->Edges.size(); ++e)
  {
    for (const int vertex : this->Edges[e].vertices)
    {
      if (!this->IsFeature[e])
      {
        const auto [first, second] = this->Edges[e].faces;
        leader[leaderOf(3 * first + cornerOf(this->Mesh, first, vertex))] =
          leaderOf(3 * second + cornerOf(this->Mesh, second, vertex));
      }
    }
  }
  std::vector<Eigen::Vector3d> sums(3 * faces, Eigen::Vector3d::Zero());
  for (std::size_t corner = 0; corner < 3 * faces; ++corner)
  {
    const int face = static_cast<int>(corner / 3);
    const int k = static_cast<int>(corner % 3);
    const Eigen::Vector3d place = vertexOf(this->Mesh, face, k);
    const Eigen::Vector3d next = vertexOf(this->Mesh, face, (k + 1) % 3) - place;
    const Eigen::Vector3d last = vertexOf(this->Mesh, face, (k + 2) % 3) - place;
    const Eigen::Vector3d area = next.cross(last);
    sums[leaderOf(static_cast<int>(corner))] += std::atan2(area.norm(), next.dot(last)) * area;
  }
  this->CornerNormals.resize(faces);
  for (std::size_t corner = 0; corner < 3 * faces; ++corner)
  {
    this->CornerNormals[corner / 3][corner % 3] = sums[leaderOf(static_cast<int>(corner))].normalized();
  }
}

/// The zero crossings of the cosine between the round surface's normal and the line of sight: mesh edges
/// between faces that are turned towards the viewpoint and away from it would zig-zag.
VisibleEdges::Contours VisibleEdges::contours(const Eigen::Vector3d& viewpoint) const
{
  Contours result;
  std::map<int, int> vertexOfEdge;
  const auto vertexOn = [&](int edge, const Eigen::Vector3d& point)
  {
    const int next = static_cast<int>(result.vertices.size());
    // Neighbouring faces share it, unless the surface breaks there.
    const int vertex = this->IsFeature[edge] ? next : vertexOfEdge.try_emplace(edge, next).first->second;
    if (vertex == next)
    {
      result.vertices.push_back(point.cast<float>());
    }
    return vertex;
  };
  for (std::size_t f = 0; f < this->Mesh.triangles.size(); ++f)
  {
    const int face = static_cast<int>(f);
    std::array<double, 3> facing;
    for (int k = 0; k < 3; ++k)
    {
      facing[k] = this->CornerNormals[f][k].dot(viewpoint - vertexOf(this->Mesh, face, k));
    }
    std::vector<int> ends;
    for (int k = 0; k < 3; ++k)
    {
      const int next = (k + 1) % 3;
      if ((facing[k] >= 0.0) != (facing[next] >= 0.0))
      {
        const double share = facing[k] / (facing[k] - facing[next]);
        ends.push_back(vertexOn(this->EdgesOfFace[f][k],
          (1.0 - share) * vertexOf(this->Mesh, face, k) + share * vertexOf(this->Mesh, face, next)));
      }
    }
    if (!ends.empty() && !this->FaceNormals[f].isZero())
    {
      result.segments.push_back({ ends[0], ends[1] });
      result.faces.push_back(face);
    }
  }
  return result;
}

/// A point of a sharp edge or a border is seen when one of its faces is seen right beside it.
std::optional<VisibleEdges::SeenPoint> VisibleEdges::seeFeature(
  const EdgeSample& sample, const Eigen::Vector3d& viewpoint, const Silhouette& silhouette) const
{
  const MeshEdge& edge = this->Edges[sample.edge];
  const Eigen::Vector3d point = sample.point.cast<double>();
  const Eigen::Vector3d tangent = sample.tangent.cast<double>();
  const Eigen::Vector3d towards = (viewpoint - point).normalized();
  Eigen::Vector3d normals = Eigen::Vector3d::Zero();
  Eigen::Vector3d inward = Eigen::Vector3d::Zero(); // off the edge, on the face that is seen best
  double best = 0.0;
  int seen = 0;
  int plainlySeen = 0;
  for (int side = 0; side < std::min(edge.faceCount, 2); ++side)
  {
    const Eigen::Vector3d normal = this->FaceNormals[edge.faces[side]].cast<double>();
    const Eigen::Vector3i& triangle = this->Mesh.triangles[edge.faces[side]];
    const int opposite = triangle.sum() - edge.vertices[0] - edge.vertices[1];
    const Eigen::Vector3d across = this->Mesh.vertices[opposite].cast<double>() - point;
    const Eigen::Vector3d along = (across - across.dot(tangent) * tangent).normalized();
    if (this->Sight.isSeen(point + HairsFromEdge * this->Sight.hair() * along, normal, viewpoint))
    {
      ++seen;
      const double cosine = normal.dot(towards);
      normals += std::copysign(1.0, cosine) * normal;
      plainlySeen += std::abs(cosine) > this->EdgeOn ? 1 : 0;
      if (std::abs(cosine) > best)
      {
        best = std::abs(cosine);
        inward = along;
      }
    }
  }
  if (seen == 0)
  {
    return {};
  }
  const bool goesOn = seen == 2 && plainlySeen != 1;
  return SeenPoint{ normals.normalized().cast<float>(),
    goesOn ? EdgeType::Crease : this->typeOfEnd(point, tangent, -inward, viewpoint, silhouette) };
}

/// A contour lies on facets that may be turned away: it is seen when nothing hides the round surface that
/// they stand for. Where the surface is hollow, the part itself is in front.
std::optional<VisibleEdges::SeenPoint> VisibleEdges::seeContour(
  const EdgeSample& sample, int face, const Eigen::Vector3d& viewpoint, const Silhouette& silhouette) const
{
  const Eigen::Vector3d point = sample.point.cast<double>();
  const auto& normals = this->CornerNormals[face];
  const Eigen::Vector3d weights = weightsOf(this->Mesh, face, point);
  Eigen::Vector3d normal = (weights[0] * normals[0] + weights[1] * normals[1] + weights[2] * normals[2]).normalized();
  double facet = 0.0;   // how far the facet's corners lie below the round surface's tangent planes
  double bending = 0.0; // of the surface along the line of sight: away from the viewpoint on the normal's side
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Vector3d side = vertexOf(this->Mesh, face, (k + 1) % 3) - vertexOf(this->Mesh, face, k);
    facet = std::max({ facet, std::abs(side.dot(normals[k])), std::abs(side.dot(normals[(k + 1) % 3])) });
    const Eigen::Vector3d opposite = vertexOf(this->Mesh, face, (k + 2) % 3) - vertexOf(this->Mesh, face, (k + 1) % 3);
    bending += normals[k].dot(viewpoint - vertexOf(this->Mesh, face, k)) *
               this->FaceNormals[face].cast<double>().cross(opposite).dot(viewpoint - point);
  }
  normal *= std::copysign(1.0, bending);
  if (!this->Sight.isFree(point + (facet + this->Sight.hair()) * normal, viewpoint))
  {
    return {};
  }
  return SeenPoint{ normal.cast<float>(),
    this->typeOfEnd(point, sample.tangent.cast<double>(), normal, viewpoint, silhouette) };
}

/// The type of a point where the visible surface ends, on the side of the edge that `outward` is on.
EdgeType VisibleEdges::typeOfEnd(const Eigen::Vector3d& point, const Eigen::Vector3d& tangent,
  const Eigen::Vector3d& outward, const Eigen::Vector3d& viewpoint, const Silhouette& silhouette) const
{
  const Eigen::Vector3d across = tangent.cross(viewpoint - point).normalized();
  const Silhouette::Cell beyond = silhouette.beyond(point, std::copysign(1.0, across.dot(outward)) * across);
  return beyond == Silhouette::Cell::Enclosed ? EdgeType::HoleBorder : EdgeType::Contour;
}

PointCloud VisibleEdges::seenFrom(
  const Eigen::Vector3d& viewpoint, const Silhouette& silhouette, const Progress& progress) const
{
  const Contours contours = this->contours(viewpoint);
  std::vector<EdgeSample> samples = this->Features;
  const std::size_t features = samples.size();
  for (EdgeSample& sample : sampleEdges(contours.vertices, contours.segments, this->Spacing))
  {
    samples.push_back(sample);
  }
  std::vector<std::optional<SeenPoint>> seen(samples.size());
  parallelFor(static_cast<int>(samples.size()), 0, progress,
    [&](int begin, int end, int)
    {
      for (std::size_t i = begin; i < static_cast<std::size_t>(end); ++i)
      {
        seen[i] = i < features ? this->seeFeature(samples[i], viewpoint, silhouette)
                               : this->seeContour(samples[i], contours.faces[samples[i].edge], viewpoint, silhouette);
      }
    });
  PointCloud cloud;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (seen[i])
    {
      cloud.points.push_back(samples[i].point);
      cloud.tangents.push_back(samples[i].tangent);
      cloud.normals.push_back(seen[i]->normal);
      cloud.edgeTypes.push_back(seen[i]->type);
    }
  }
  return cloud;
}
}
