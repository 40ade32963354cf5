// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/SignedDistanceGrid.h"

#include "base/Bounds.h"
#include "mesh/TriangleMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr float Band = 2.5f;         // cells on both sides of the surface in which distances are exact
constexpr int Margin = 4;            // cells around the mesh
constexpr float LargeTriangle = 8.f; // cells; larger ones are cut before their surroundings are looked at
// A path over the grid's neighbours is this much longer than the straight one, at most.
constexpr float LongestPath = 1.13f;

/// The squared distance of a point from a triangle.
/// (C. Ericson: Real-Time Collision Detection, 2005, Section 5.1.5)
float squaredDistance(const Eigen::Vector3f& point, const Eigen::Matrix3f& corners)
{
  const Eigen::Vector3f ab = corners.col(1) - corners.col(0);
  const Eigen::Vector3f ac = corners.col(2) - corners.col(0);
  const Eigen::Vector3f ap = point - corners.col(0);
  const float d1 = ab.dot(ap);
  const float d2 = ac.dot(ap);
  if (d1 <= 0.0f && d2 <= 0.0f)
  {
    return ap.squaredNorm();
  }
  const Eigen::Vector3f bp = ap - ab;
  const float d3 = ab.dot(bp);
  const float d4 = ac.dot(bp);
  if (d3 >= 0.0f && d4 <= d3)
  {
    return bp.squaredNorm();
  }
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f)
  {
    return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  }
  const Eigen::Vector3f cp = ap - ac;
  const float d5 = ab.dot(cp);
  const float d6 = ac.dot(cp);
  if (d6 >= 0.0f && d5 <= d6)
  {
    return cp.squaredNorm();
  }
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f)
  {
    return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  }
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0f && d4 >= d3 && d5 >= d6)
  {
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (ac - ab)).squaredNorm();
  }
  const float inverse = 1.0f / (va + vb + vc);
  return (ap - vb * inverse * ab - vc * inverse * ac).squaredNorm();
}
}

SignedDistanceGrid::SignedDistanceGrid(const TriangleMesh& mesh, bool closed, double cellSize)
  : Box(bounds(mesh.vertices))
  , CellSize(static_cast<float>(cellSize))
{
  const Eigen::Vector3f margin = Eigen::Vector3f::Constant(Margin * this->CellSize);
  this->Box.min() -= margin;
  this->Size = ((this->Box.sizes() + margin).array() / this->CellSize).ceil().cast<int>() + 1;
  this->Box.max() = this->Box.min() + (this->CellSize * (this->Size - 1).cast<float>()).matrix();
  this->Distances.assign(this->index(0, 0, this->Size.z()), std::numeric_limits<float>::infinity());
  for (const auto& triangle : mesh.triangles)
  {
    Eigen::Matrix3f corners;
    corners << mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]];
    this->addTriangle(corners);
  }
  this->spread();
  if (closed)
  {
    this->makeSigned(mesh);
  }
}

void SignedDistanceGrid::addTriangle(const Eigen::Matrix3f& corners)
{
  const Eigen::Array3f low = corners.rowwise().minCoeff();
  const Eigen::Array3f high = corners.rowwise().maxCoeff();
  if ((high - low).maxCoeff() > LargeTriangle * this->CellSize)
  {
    int longest = 0;
    float length = -1.0f;
    for (int k = 0; k < 3; ++k)
    {
      const float edge = (corners.col((k + 1) % 3) - corners.col(k)).squaredNorm();
      longest = edge > length ? k : longest;
      length = std::max(length, edge);
    }
    const Eigen::Vector3f middle = 0.5f * (corners.col(longest) + corners.col((longest + 1) % 3));
    for (int half = 0; half < 2; ++half)
    {
      Eigen::Matrix3f piece = corners;
      piece.col((longest + half) % 3) = middle;
      this->addTriangle(piece);
    }
    return;
  }
  const Eigen::Array3i first = ((low - this->Box.min().array()) / this->CellSize - Band).ceil().cast<int>().max(0);
  const Eigen::Array3i last =
    ((high - this->Box.min().array()) / this->CellSize + Band).floor().cast<int>().min(this->Size - 1);
  for (int z = first.z(); z <= last.z(); ++z)
  {
    for (int y = first.y(); y <= last.y(); ++y)
    {
      for (int x = first.x(); x <= last.x(); ++x)
      {
        const Eigen::Vector3f point = this->Box.min() + this->CellSize * Eigen::Vector3f(x, y, z);
        const float distance = std::sqrt(squaredDistance(point, corners));
        float& least = this->Distances[this->index(x, y, z)];
        if (distance <= Band * this->CellSize)
        {
          least = std::min(least, distance);
        }
      }
    }
  }
}

/// From the samples that have a distance to all others: the shortest path over neighbours, forth and back.
void SignedDistanceGrid::spread()
{
  const float none = std::numeric_limits<float>::infinity();
  std::vector<char> isExact(this->Distances.size());
  std::transform(this->Distances.begin(), this->Distances.end(), isExact.begin(), [&](float d) { return d < none; });
  const auto pass = [&](int sign)
  {
    const auto along = [&](int i, int size) { return sign > 0 ? i : size - 1 - i; };
    for (int k = 0; k < this->Size.z(); ++k)
    {
      for (int j = 0; j < this->Size.y(); ++j)
      {
        for (int i = 0; i < this->Size.x(); ++i)
        {
          const int x = along(i, this->Size.x());
          const int y = along(j, this->Size.y());
          const int z = along(k, this->Size.z());
          float& distance = this->Distances[this->index(x, y, z)];
          // The thirteen neighbours that came before.
          for (int n = 0; n < 13; ++n)
          {
            const Eigen::Array3i step(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
            const Eigen::Array3i from = Eigen::Array3i(x, y, z) + sign * step;
            if ((from >= 0).all() && (from < this->Size).all())
            {
              distance = std::min(distance, this->Distances[this->index(from.x(), from.y(), from.z())] +
                                              this->CellSize * std::sqrt(static_cast<float>(step.square().sum())));
            }
          }
        }
      }
    }
  };
  pass(1);
  pass(-1);
  for (std::size_t i = 0; i < isExact.size(); ++i)
  {
    this->Distances[i] /= isExact[i] ? 1.0f : LongestPath;
  }
}

/// A sample is inside when lines along z below it enter the mesh more often than they leave it.
void SignedDistanceGrid::makeSigned(const TriangleMesh& mesh)
{
  std::vector<std::int8_t> crossings(this->Distances.size(), 0); // between a sample and the one below
  for (const auto& triangle : mesh.triangles)
  {
    std::array<Eigen::Vector3d, 3> p;
    for (int k = 0; k < 3; ++k)
    {
      p[k] = (mesh.vertices[triangle[k]] - this->Box.min()).cast<double>() / this->CellSize;
    }
    const auto cross = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double x, double y)
    { return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x()); };
    const double area = cross(p[0], p[1], p[2].x(), p[2].y());
    if (area == 0.0)
    {
      continue;
    }
    const Eigen::Vector3d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
    const Eigen::Vector3d high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    for (int y = static_cast<int>(std::ceil(low.y())); y <= high.y(); ++y)
    {
      for (int x = static_cast<int>(std::ceil(low.x())); x <= high.x(); ++x)
      {
        // An edge is looked at from the same end for both of its faces, so that a line through it crosses one.
        double weights[3];
        bool inside = true;
        for (int k = 0; k < 3; ++k)
        {
          const int a = (k + 1) % 3;
          const int b = (k + 2) % 3;
          const bool turned = triangle[a] > triangle[b];
          const double side = turned ? cross(p[b], p[a], x, y) : cross(p[a], p[b], x, y);
          inside &= (side >= 0.0) != (turned != (area < 0.0));
          weights[k] = (turned ? -side : side) / area;
        }
        if (inside)
        {
          const double z = weights[0] * p[0].z() + weights[1] * p[1].z() + weights[2] * p[2].z();
          crossings[this->index(x, y, std::clamp(static_cast<int>(std::ceil(z)), 0, this->Size.z() - 1))] +=
            area > 0.0 ? -1 : 1; // out through a face that looks up
        }
      }
    }
  }
  const std::size_t layer = this->index(0, 0, 1);
  for (std::size_t column = 0; column < layer; ++column)
  {
    int depth = 0;
    for (std::size_t i = column; i < this->Distances.size(); i += layer)
    {
      depth += crossings[i];
      this->Distances[i] = depth > 0 ? -this->Distances[i] : this->Distances[i];
    }
  }
}

float SignedDistanceGrid::bound(const Eigen::Vector3f& point) const
{
  const Eigen::Array3f cell = (point - this->Box.min()).array() / this->CellSize + 0.5f;
  if (!((cell >= 0.0f).all() && (cell < this->Size.cast<float>()).all()))
  {
    return this->Box.exteriorDistance(point) + (Margin - 1) * this->CellSize;
  }
  // The nearest sample is not farther than half the diagonal of a cell.
  const Eigen::Array3i at = cell.cast<int>();
  return this->Distances[this->index(at.x(), at.y(), at.z())] - 0.87f * this->CellSize;
}

float SignedDistanceGrid::at(const Eigen::Vector3f& point, Eigen::Vector3f& direction) const
{
  direction.setZero();
  const Eigen::Array3f cell = (point - this->Box.min()).array() / this->CellSize;
  if (!((cell >= 0.0f).all() && (cell < (this->Size - 1).cast<float>()).all()))
  {
    return this->bound(point);
  }
  const Eigen::Array3i low = cell.cast<int>();
  const Eigen::Array3f t = cell - low.cast<float>();
  float value[8];
  for (int i = 0; i < 8; ++i)
  {
    value[i] = this->Distances[this->index(low.x() + (i & 1), low.y() + ((i >> 1) & 1), low.z() + (i >> 2))];
  }
  const auto mix = [](float a, float b, float share) { return a + share * (b - a); };
  float x[4]; // along x
  for (int i = 0; i < 4; ++i)
  {
    x[i] = mix(value[2 * i], value[2 * i + 1], t.x());
  }
  const float y[2] = { mix(x[0], x[1], t.y()), mix(x[2], x[3], t.y()) };
  direction << mix(
    mix(value[1] - value[0], value[3] - value[2], t.y()), mix(value[5] - value[4], value[7] - value[6], t.y()), t.z()),
    mix(x[1] - x[0], x[3] - x[2], t.z()), y[1] - y[0];
  direction.normalize();
  return mix(y[0], y[1], t.z());
}
}
