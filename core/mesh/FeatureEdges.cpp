// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/FeatureEdges.h"

#include "mesh/ConvexHull.h"
#include "mesh/MeshEdges.h"
#include "mesh/SurfaceSampling.h"
#include "mesh/TriangleMesh.h"

#include <cmath>

namespace meam
{
PointCloud extractFeatureEdges(const TriangleMesh& mesh, const FeatureEdgesSettings& settings, const Progress& progress)
{
  requireMesh(mesh);
  if (!(settings.angle > 0.0) || !(settings.angle < 180.0))
  {
    throw Error("The angle of sharp edges must be between 0 and 180 degrees.");
  }
  if (!(settings.spacing >= 0.0) || !std::isfinite(settings.spacing))
  {
    throw Error("The spacing of the edge points must be 0 (automatic) or a positive length in mm.");
  }
  const double spacing = settings.spacing > 0.0 ? settings.spacing : SpacingShare * diameter(mesh.vertices);
  if (!(spacing > 0.0))
  {
    throw Error("The mesh has no area: all of its faces are degenerate.");
  }
  const std::vector<MeshEdge> edges = edgesOf(mesh);
  const Points normals = faceNormals(mesh, edges);
  const float flattest = static_cast<float>(std::cos(settings.angle * M_PI / 180.0));
  report(progress, 0.3);

  PointCloud result;
  for (const EdgeType type : { EdgeType::Crease, EdgeType::HoleBorder })
  {
    std::vector<std::array<int, 2>> chosen;
    std::vector<int> numbers;
    for (std::size_t e = 0; e < edges.size(); ++e)
    {
      const MeshEdge& edge = edges[e];
      const bool border = edge.faceCount == 1;
      const bool sharp =
        edge.faceCount > 2 || (!border && normals[edge.faces[0]].dot(normals[edge.faces[1]]) < flattest);
      if (type == EdgeType::Crease ? sharp : border)
      {
        chosen.push_back(edge.vertices);
        numbers.push_back(static_cast<int>(e));
      }
    }
    for (const auto& sample : sampleEdges(mesh.vertices, chosen, spacing))
    {
      const MeshEdge& edge = edges[numbers[sample.edge]];
      Eigen::Vector3f normal = normals[edge.faces[0]];
      if (edge.faceCount > 1)
      {
        constexpr float foldedBack = 1e-3f; // where faces lie on each other the first one counts
        const Eigen::Vector3f sum = normal + normals[edge.faces[1]];
        normal = sum.norm() > foldedBack ? sum.normalized() : normal;
      }
      result.pointIds.push_back(static_cast<int>(result.points.size()));
      result.points.push_back(sample.point);
      result.tangents.push_back(sample.tangent);
      result.normals.push_back(normal);
      result.edgeTypes.push_back(type);
    }
    report(progress, type == EdgeType::Crease ? 0.7 : 1.0);
  }
  return result;
}
}
