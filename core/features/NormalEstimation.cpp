// SPDX-License-Identifier: BSD-3-Clause
#include "features/NormalEstimation.h"

#include "features/PCLConversion.h"
#include "base/Parallel.h"

#include <pcl/features/normal_3d.h>

namespace meam
{
namespace
{
constexpr double NormalRadius = 0.06; // of the neighbourhood, share of the part's diameter
constexpr int FewestNeighbours = 6;   // with fewer there is no normal
}

Points estimateNormals(const Points& points, const PointGrid& surface, const std::vector<int>& indices,
  const Sensor& sensor, double partDiameter, int threads)
{
  const PCLCloud::Ptr cloud = toPCL(points);
  const double radius = NormalRadius * partDiameter;
  const int count = static_cast<int>(indices.size());
  Points normals(count, Eigen::Vector3f::Zero());
  parallelFor(count, threads, {},
    [&](int begin, int end, int)
    {
      pcl::Indices neighbours;
      for (int k = begin; k < end; ++k)
      {
        const Eigen::Vector3f& point = points[indices[k]];
        neighbours.clear();
        surface.forEachWithin(point, radius, [&](int index, float) { neighbours.push_back(index); });
        Eigen::Vector4f plane;
        float curvature = 0.0f;
        if (static_cast<int>(neighbours.size()) >= FewestNeighbours &&
            pcl::computePointNormal(*cloud, neighbours, plane, curvature))
        {
          const Eigen::Vector3f normal = plane.head<3>();
          const bool isAway = sensor.towards(point.cast<double>()).cast<float>().dot(normal) < 0.0f;
          normals[k] = isAway ? Eigen::Vector3f(-normal) : normal;
        }
      }
    });
  return normals;
}
}
