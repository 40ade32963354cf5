// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceSampling.h"

#include "base/Bounds.h"
#include "base/Random.h"
#include "mesh/ConvexHull.h"
#include "mesh/TriangleMesh.h"

#include <cmath>

namespace meam
{
namespace
{
// In a square whose side is the spacing: a point of the surface is at most the spacing and the distance to the nearest
// candidate away from a sample.
constexpr double CandidatesPerSquare = 20.0;
constexpr float SameSide = 0.5f; // cosine of 60 degrees: samples that face farther apart do not displace each other

struct Candidate
{
  Eigen::Vector3f point;
  int triangle;
};

/// Accepted samples in a spatial hash. Cells are two spacings wide, so that eight of them hold all
/// neighbours; cells that share a bucket by chance only cost a look.
class SampleGrid
{
public:
  SampleGrid(const Eigen::Vector3f& origin, double spacing, std::size_t expected)
    : Origin(origin)
    , InverseCell(static_cast<float>(0.5 / spacing))
    , SquaredSpacing(static_cast<float>(spacing * spacing))
  {
    std::size_t buckets = 1024;
    while (buckets < 2 * expected)
    {
      buckets *= 2;
    }
    this->Heads.assign(buckets, -1);
  }

  /// Adds the sample unless one that faces the same way is closer than the spacing.
  bool insert(PointCloud& samples, const Eigen::Vector3f& point, const Eigen::Vector3f& normal)
  {
    const Eigen::Array3f cell = (point - this->Origin).array() * this->InverseCell;
    const Eigen::Array3i own = cell.floor().cast<int>();
    const Eigen::Array3i side =
      (cell - cell.floor() < 0.5f).select(Eigen::Array3i(-1, -1, -1), Eigen::Array3i(1, 1, 1));
    for (int k = 0; k < 8; ++k)
    {
      const Eigen::Array3i offset(k & 1, (k >> 1) & 1, (k >> 2) & 1);
      for (int i = this->Heads[this->bucket(own + offset * side)]; i >= 0; i = this->Next[i])
      {
        if ((samples.points[i] - point).squaredNorm() < this->SquaredSpacing &&
            samples.normals[i].dot(normal) > SameSide)
        {
          return false;
        }
      }
    }
    int& head = this->Heads[this->bucket(own)];
    this->Next.push_back(head);
    head = static_cast<int>(samples.size());
    samples.points.push_back(point);
    samples.normals.push_back(normal);
    samples.pointIds.push_back(head);
    return true;
  }

private:
  std::size_t bucket(const Eigen::Array3i& cell) const
  {
    const std::uint32_t hash = static_cast<std::uint32_t>(cell.x()) * 73856093u ^
                               static_cast<std::uint32_t>(cell.y()) * 19349663u ^
                               static_cast<std::uint32_t>(cell.z()) * 83492791u;
    return (hash ^ (hash >> 15)) & (this->Heads.size() - 1);
  }

  Eigen::Vector3f Origin;
  float InverseCell;
  float SquaredSpacing;
  std::vector<int> Heads;
  std::vector<int> Next;
};
}

PointCloud sampleSurface(const TriangleMesh& mesh, const SurfaceSamplingSettings& settings, const Progress& progress)
{
  requireMesh(mesh);
  if (!(settings.spacing >= 0.0) || !std::isfinite(settings.spacing))
  {
    throw Error("The spacing of the surface samples must be 0 (automatic) or a positive length in mm.");
  }

  // Area and unit normal of each triangle; the running sum of the areas.
  std::vector<double> areaUpTo(mesh.triangles.size());
  Points normals(mesh.triangles.size(), Eigen::Vector3f::Zero());
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Eigen::Vector3i& triangle = mesh.triangles[t];
    const Eigen::Vector3d a = mesh.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d cross =
      (mesh.vertices[triangle[1]].cast<double>() - a).cross(mesh.vertices[triangle[2]].cast<double>() - a);
    const double length = cross.norm();
    if (length > 0.0)
    {
      normals[t] = (cross / length).cast<float>();
    }
    area += 0.5 * length;
    areaUpTo[t] = area;
  }
  if (!(area > 0.0))
  {
    throw Error("The mesh has no area: all of its faces are degenerate.");
  }

  const double spacing = settings.spacing > 0.0 ? settings.spacing : SpacingShare * diameter(mesh.vertices);
  constexpr double most = 1e8; // candidates, 1.6 GB
  const double wanted = std::ceil(CandidatesPerSquare * area / (spacing * spacing));
  if (!(wanted <= most))
  {
    throw Error("The spacing of the surface samples is too small for the part (it asks for more than " +
                std::to_string(static_cast<int>(0.7 * most / CandidatesPerSquare)) +
                " samples): enlarge it, or check the unit of the CAD file.");
  }

  // Candidates by area, at even steps of the running sum: every face gets its share to within one.
  Random random(settings.seed);
  std::vector<Candidate> candidates(static_cast<std::size_t>(wanted));
  std::size_t t = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const double at = (static_cast<double>(i) + random.uniform()) * area / wanted;
    while (t + 1 < areaUpTo.size() && areaUpTo[t] <= at)
    {
      ++t;
    }
    const double r = std::sqrt(random.uniform());
    const double s = random.uniform();
    const Eigen::Vector3i& triangle = mesh.triangles[t];
    const Eigen::Vector3d point = (1.0 - r) * mesh.vertices[triangle[0]].cast<double>() +
                                  r * (1.0 - s) * mesh.vertices[triangle[1]].cast<double>() +
                                  r * s * mesh.vertices[triangle[2]].cast<double>();
    candidates[i] = { point.cast<float>(), static_cast<int>(t) };
  }
  random.shuffle(candidates);
  report(progress, 0.3);

  PointCloud samples;
  const auto expected = static_cast<std::size_t>(wanted / CandidatesPerSquare);
  SampleGrid grid(bounds(mesh.vertices).min(), spacing, expected);
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    grid.insert(samples, candidates[i].point, normals[candidates[i].triangle]);
    reportStep(progress, i, 0.3 + 0.7 * static_cast<double>(i) / wanted);
  }
  report(progress, 1.0);
  return samples;
}
}
