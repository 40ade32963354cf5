// SPDX-License-Identifier: BSD-3-Clause
#include "base/PointCloud.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"

#include <algorithm>

namespace meam
{
PointCloud PointCloud::subset(const std::vector<int>& indices) const
{
  PointCloud result;
  const auto take = [&](const auto& from, auto& to)
  {
    if (!from.empty())
    {
      to.reserve(indices.size());
      for (const int index : indices)
      {
        to.push_back(from[index]);
      }
    }
  };
  take(this->points, result.points);
  take(this->normals, result.normals);
  take(this->tangents, result.tangents);
  take(this->pointIds, result.pointIds);
  take(this->edgeTypes, result.edgeTypes);
  take(this->weights, result.weights);
  return result;
}

void requirePoints(std::size_t count, std::size_t finite, const std::string& what)
{
  if (count == 0)
  {
    throw Error(what + " has no points: check the file and the step before this one.");
  }
  if (finite == 0)
  {
    throw Error(what + " has only invalid points (NaN, infinite or beyond single precision): the sensor returned no "
                       "depth, or the file's fields are not x, y and z.");
  }
}

void requirePoints(const Points& points, const std::string& what)
{
  const bool isAnyFinite = std::any_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); });
  requirePoints(points.size(), isAnyFinite ? 1 : 0, what);
}

PointCloud finitePoints(PointCloud cloud)
{
  std::vector<int> finite;
  finite.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (cloud.points[i].allFinite() && (cloud.tangents.empty() || cloud.tangents[i].allFinite()))
    {
      finite.push_back(static_cast<int>(i));
    }
  }
  return finite.size() == cloud.size() ? cloud : cloud.subset(finite);
}

Points moved(const Points& points, const Eigen::Isometry3d& motion)
{
  return mapped<Eigen::Vector3f>(points,
    [&](const Eigen::Vector3f& point) -> Eigen::Vector3f { return (motion * point.cast<double>()).cast<float>(); });
}
}
