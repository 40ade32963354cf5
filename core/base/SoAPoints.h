// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
constexpr int SoABlock = 256; ///< points that loops look at together, so that what they hold stays in the cache

/// Points coordinate by coordinate, for loops over many at a time.
struct SoAPoints
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
  void reserve(std::size_t size)
  {
    this->x.reserve(size);
    this->y.reserve(size);
    this->z.reserve(size);
  }
  void set(std::size_t k, const Eigen::Vector3f& point)
  {
    this->x[k] = point.x();
    this->y[k] = point.y();
    this->z[k] = point.z();
  }
  Eigen::Vector3f operator[](std::size_t k) const { return { this->x[k], this->y[k], this->z[k] }; }
};

/// Points with a unit direction each: the normal of a surface, the tangent of an edge.
struct SoAOrientedPoints
{
  SoAPoints points;
  SoAPoints directions;

  std::size_t size() const { return this->points.size(); }
  void add(const Eigen::Vector3f& point, const Eigen::Vector3f& direction)
  {
    this->points.add(point);
    this->directions.add(direction);
  }
  void set(std::size_t k, const Eigen::Vector3f& point, const Eigen::Vector3f& direction)
  {
    this->points.set(k, point);
    this->directions.set(k, direction);
  }
  void resize(std::size_t size)
  {
    this->points.resize(size);
    this->directions.resize(size);
  }
  void reserve(std::size_t size)
  {
    this->points.reserve(size);
    this->directions.reserve(size);
  }
};

/// The points after a motion, with their directions turned.
SoAOrientedPoints moved(const SoAOrientedPoints& columns, const Eigen::Isometry3f& motion);
}
