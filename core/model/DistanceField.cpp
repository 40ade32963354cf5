// SPDX-License-Identifier: BSD-3-Clause
#include "model/DistanceField.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double MostCells = 2.0e7; // larger cells are taken for more
}

template <typename Metric>
DistanceField::DistanceField(const Points& points, double spacing, double reach, double cellSize, Metric&& metric)
  : Reach(static_cast<float>(reach))
  , Step(static_cast<float>(reach) / Farthest)
{
  const Eigen::AlignedBox3f box = bounds(points);
  if (box.isEmpty())
  {
    return;
  }
  this->Middle = box.center();
  for (const auto& point : points)
  {
    this->Radius = std::max(this->Radius, (point - this->Middle).norm());
  }
  const Eigen::Array3d size = box.sizes().cast<double>().array() + 2.0 * reach;
  const double cell = std::max(cellSize, std::cbrt(size.prod() / MostCells));
  this->Origin = box.min().array() - static_cast<float>(reach);
  this->InverseCell = static_cast<float>(1.0 / cell);
  this->Size = (size / cell).floor().cast<int>() + 1;
  this->Extent = this->Size.cast<float>();
  this->Distances.assign(static_cast<std::size_t>(this->Size.prod()), Farthest);
  const float around = static_cast<float>(reach + spacing);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Array3f place = (points[i] - this->Origin).array();
    const Eigen::Array3i low = ((place - around) * this->InverseCell).max(0.0f).cast<int>();
    const Eigen::Array3i high = ((place + around) * this->InverseCell).cast<int>().min(this->Size - 1);
    for (int z = low.z(); z <= high.z(); ++z)
    {
      for (int y = low.y(); y <= high.y(); ++y)
      {
        std::uint8_t* row = &this->Distances[(static_cast<std::size_t>(z) * this->Size.y() + y) * this->Size.x()];
        for (int x = low.x(); x <= high.x(); ++x)
        {
          const Eigen::Vector3f centre(
            (x + 0.5f) * static_cast<float>(cell), (y + 0.5f) * static_cast<float>(cell), (z + 0.5f) * static_cast<float>(cell));
          const float stored = metric(i, centre - place.matrix()) / this->Step;
          row[x] = stored < row[x] ? static_cast<std::uint8_t>(stored) : row[x];
        }
      }
    }
  }
}

DistanceField DistanceField::ofSurface(const PointCloud& samples, double spacing, double reach, double cellSize)
{
  const float gap = static_cast<float>(spacing);
  return DistanceField(samples.points, spacing, reach, cellSize,
    [&](std::size_t i, const Eigen::Vector3f& offset)
    {
      const float across = samples.normals[i].dot(offset);
      const float along = std::sqrt(std::max(0.0f, offset.squaredNorm() - across * across));
      return std::hypot(across, std::max(0.0f, along - gap));
    });
}

DistanceField DistanceField::ofEdges(const PointCloud& edges, double spacing, double reach, double cellSize)
{
  const float gap = static_cast<float>(spacing);
  return DistanceField(edges.points, spacing, reach, cellSize,
    [&](std::size_t i, const Eigen::Vector3f& offset)
    {
      const float along = std::abs(edges.tangents[i].dot(offset));
      const float across = std::sqrt(std::max(0.0f, offset.squaredNorm() - along * along));
      return std::hypot(across, std::max(0.0f, along - gap));
    });
}
}
