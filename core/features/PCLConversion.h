// SPDX-License-Identifier: BSD-3-Clause
// Included by the few files that use PCL, which is slow to compile.
#pragma once

#include "base/PointCloud.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace meam
{
using PCLCloud = pcl::PointCloud<pcl::PointXYZ>;

inline PCLCloud::Ptr toPCL(const Points& points)
{
  auto cloud = pcl::make_shared<PCLCloud>();
  cloud->reserve(points.size());
  for (const auto& point : points)
  {
    cloud->emplace_back(point.x(), point.y(), point.z());
  }
  return cloud;
}
}
