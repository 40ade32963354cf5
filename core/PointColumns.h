// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry.h"

namespace meam
{
/// Points coordinate by coordinate, for loops over many at a time.
struct PointColumns
{
  std::vector<float> x, y, z;

  std::size_t size() const { return this->x.size(); }
  void add(const Eigen::Vector3f& point)
  {
    this->x.push_back(point.x());
    this->y.push_back(point.y());
    this->z.push_back(point.z());
  }
  void resize(std::size_t size)
  {
    this->x.resize(size);
    this->y.resize(size);
    this->z.resize(size);
  }
  void set(std::size_t k, const Eigen::Vector3f& point)
  {
    this->x[k] = point.x();
    this->y[k] = point.y();
    this->z[k] = point.z();
  }
  Eigen::Vector3f operator[](std::size_t k) const { return { this->x[k], this->y[k], this->z[k] }; }
};
}
