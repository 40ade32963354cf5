// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/OccludingContours.h"

#include "base/AllVectors.h"
#include "base/PointGrid.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double Neighbour = 1.6; // of the samples' spacing, up to which two are neighbours
constexpr double Flattest = 1.0;  // degrees between the normals of neighbours: less, and the surface is flat there
constexpr double Sharpest = 30.0; // degrees; more, and an edge of the part lies between them
constexpr double Smooth = 15.0;   // degrees between the normals about an edge point and their mean: more is an edge
constexpr double SeenLast = 0.12; // cosine at which any sensor loses a surface that turns away
constexpr double SeenFirst = 0.7; // cosine at which it does not, however coarse
constexpr double Grazing = 0.25;  // cosine: an edge point whose surface all views see flatter was a contour there

float cosineOf(double degrees) { return static_cast<float>(std::cos(degrees * M_PI / 180.0)); }

/// Of directions to one.
MEAM_ALL_VECTORS
void findCosines(const SoAPoints& directions, const Eigen::Vector3f& to, float* cosines)
{
  const float *x = directions.x.data(), *y = directions.y.data(), *z = directions.z.data();
  const float toX = to.x(), toY = to.y(), toZ = to.z();
  const std::size_t count = directions.size();
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k)
  {
    cosines[k] = x[k] * toX + (y[k] * toY + z[k] * toZ);
  }
}
}

OccludingContours::OccludingContours(const PointCloud& surface, double spacing)
  : Samples(surface.points)
  , Spacing(spacing)
{
  const Points &points = surface.points, &normals = surface.normals;
  const float flat = cosineOf(Flattest), sharp = cosineOf(Sharpest);
  const PointGrid grid(points, Neighbour * spacing);
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
  {
    this->Normals.add(normals[i]);
    const int begin = static_cast<int>(this->Neighbours.size());
    float least = 1.0f; // cosine to the normals of its neighbours
    grid.forEachWithin(points[i], Neighbour * spacing,
      [&](int k, float)
      {
        const float cosine = normals[i].dot(normals[k]);
        const bool isRound = (normals[k] - normals[i]).dot(points[k] - points[i]) > 0.0f;
        if (cosine < flat && cosine > sharp && isRound)
        {
          this->Neighbours.push_back(k);
          least = std::min(least, cosine);
        }
      });
    std::sort(this->Neighbours.begin() + begin, this->Neighbours.end());
    const int end = static_cast<int>(this->Neighbours.size());
    if (begin < end)
    {
      constexpr float rounding = 1e-3f; // of the cosine
      this->Bends.push_back({ i, std::sqrt(1.0f - least * least) + rounding, begin, end });
    }
  }
}

std::vector<OccludingContours::Point> OccludingContours::from(const Eigen::Vector3f& towards, double inset) const
{
  std::vector<Point> contour;
  const Points& points = this->Samples;
  const SoAPoints& normals = this->Normals;
  const float least = static_cast<float>(SeenLast), most = static_cast<float>(SeenFirst);
  thread_local std::vector<float> cosineRoom; // there are hundreds of directions
  cosineRoom.resize(points.size());
  float* cosines = cosineRoom.data();
  findCosines(this->Normals, towards, cosines);
  thread_local std::vector<int> turning; // bends across which the surface may turn away
  turning.resize(this->Bends.size());
  int count = 0;
  for (int b = 0; b < static_cast<int>(this->Bends.size()); ++b)
  {
    // Without a branch, which would be predicted wrongly.
    const float cosine = cosines[this->Bends[b].sample];
    turning[count] = b;
    count += (cosine >= 0.0f) & (cosine <= this->Bends[b].mostCosine) ? 1 : 0;
  }
  for (int t = 0; t < count; ++t)
  {
    const auto& [i, mostCosine, begin, end] = this->Bends[turning[t]];
    // Of the crossings from this sample on the nearest: to the neighbour that turns away most.
    int across = this->Neighbours[begin];
    for (int n = begin + 1; n < end; ++n)
    {
      const int k = this->Neighbours[n];
      across = cosines[k] < cosines[across] ? k : across;
    }
    if (cosines[across] < 0.0f)
    {
      const float nearest = cosines[i] / (cosines[i] - cosines[across]);
      const Eigen::Vector3f normal = ((1.0f - nearest) * normals[i] + nearest * normals[across]).normalized();
      const Eigen::Vector3f crossing = (1.0f - nearest) * points[i] + nearest * points[across];
      // On the circle that the surface bends in between both, by the cosine at which it is measured last.
      const Eigen::Vector3f bend = normals[across] - normals[i];
      const float radius = bend.dot(points[across] - points[i]) / bend.squaredNorm();
      const float off = std::min(static_cast<float>(inset) / radius, 1.0f);
      const float cosine = std::clamp(std::sqrt(off * (2.0f - off)), least, most);
      const float inward = 1.0f - std::sqrt(1.0f - cosine * cosine);
      contour.push_back(
        { crossing + radius * (cosine * towards - inward * normal), normal, normal.cross(towards).normalized() });
    }
  }
  return contour;
}

std::vector<bool> OccludingContours::areContours(
  const Points& edges, const std::vector<std::uint32_t>& views, const Points& viewDirections) const
{
  const float smooth = cosineOf(Smooth);
  const double near = Neighbour * this->Spacing;
  const PointGrid grid(this->Samples, near);
  std::vector<bool> result(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    std::vector<int> about;
    grid.forEachWithin(edges[i], near, [&](int k, float) { about.push_back(k); });
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    for (const int k : about)
    {
      normal += this->Normals[k];
    }
    normal.normalize();
    bool isContour = !about.empty();
    for (const int k : about)
    {
      isContour = isContour && this->Normals[k].dot(normal) > smooth;
    }
    for (std::size_t v = 0; v < viewDirections.size(); ++v)
    {
      const bool isSeen = views[i] >> v & 1u;
      isContour = isContour && !(isSeen && std::abs(viewDirections[v].dot(normal)) > Grazing);
    }
    result[i] = isContour;
  }
  return result;
}
}
