// SPDX-License-Identifier: BSD-3-Clause
#include "pick/proposal/ContactPlaces.h"

#include "base/sequences/Sequences.h"
#include "mesh/ConvexHull.h"
#include "mesh/MeshEdges.h"
#include "mesh/SurfaceSampling.h"
#include "simulation/MassProperties.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double DiscsFill = 0.7;         // of the plane, at Poisson discs: their number for a spacing
constexpr double SameDirection = 0.996;   // cosine, 5 degrees: one line through the centre of mass for these
constexpr double AtRightAngles = 0.99999; // cosine, 0.26 degrees
constexpr double SymmetryMargin = 0.01;   // of the diameter

double areaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& triangle : mesh.triangles)
  {
    const Eigen::Vector3f a = mesh.vertices[triangle[0]];
    area += 0.5 * (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a).norm();
  }
  return area;
}

/// Where the lines through the centre along the normals of the samples leave the part.
std::vector<ContactPlace> throughCentre(const PointCloud& samples, const MeshRays& rays, const PartBalance& balance)
{
  Points directions;
  std::vector<ContactPlace> places;
  for (const auto& normal : samples.normals)
  {
    const auto known = [&](const Eigen::Vector3f& direction) { return direction.dot(normal) > SameDirection; };
    if (std::any_of(directions.begin(), directions.end(), known))
    {
      continue;
    }
    directions.push_back(normal);
    const Eigen::Vector3d out = normal.cast<double>().normalized();
    const Eigen::Vector3d from = balance.centre + balance.diameter * out;
    for (const RayHit& hit : rays.hits(from, -out, 2.0 * balance.diameter))
    {
      if (hit.entering && hit.normal.dot(out) > AtRightAngles)
      {
        places.push_back({ from - hit.distance * out, hit.normal });
      }
    }
  }
  return places;
}
}

PartBalance balanceOf(const TriangleMesh& part)
{
  const std::vector<MeshEdge> edges = edgesOf(part);
  const bool closed = std::all_of(edges.begin(), edges.end(), [](const MeshEdge& edge) { return edge.faceCount == 2; });
  PartBalance balance;
  balance.diameter = diameter(part.vertices);
  balance.centre = massProperties(part, closed).T_model_body.translation();
  return balance;
}

std::vector<ContactPlace> contactPlaces(const TriangleMesh& part, const MeshRays& rays, const PartBalance& balance,
  const Symmetries& symmetries, int count, unsigned seed)
{
  SurfaceSamplingSettings sampling;
  sampling.spacing = std::sqrt(DiscsFill * areaOf(part) / count);
  sampling.seed = seed;
  const PointCloud samples = sampleSurface(part, sampling);
  std::vector<ContactPlace> places = throughCentre(samples, rays, balance);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    places.push_back({ samples.points[i].cast<double>(), samples.normals[i].cast<double>().normalized() });
  }
  const auto points = mapped<Eigen::Vector3f>(
    places, [&](const ContactPlace& place) -> Eigen::Vector3f { return place.point.cast<float>(); });
  const std::vector<bool> stands = representatives(points, symmetries, SymmetryMargin * balance.diameter);
  std::vector<ContactPlace> result;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (stands[i])
    {
      result.push_back(places[i]);
    }
  }
  return result;
}
}
