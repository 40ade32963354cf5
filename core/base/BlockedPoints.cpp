// SPDX-License-Identifier: BSD-3-Clause
#include "base/BlockedPoints.h"

#include "base/AllVectors.h"
#include "base/Parallel.h"

#include <algorithm>

namespace meam
{
namespace
{
using Iterator = std::vector<int>::iterator;

constexpr float Wider = 1.0001f; // more than rounding may take from a radius

/// Halves points across their longest side; full blocks come first.
Iterator halve(const Points& points, Iterator begin, Iterator end)
{
  Eigen::AlignedBox3f box;
  for (Iterator i = begin; i != end; ++i)
  {
    box.extend(points[*i]);
  }
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const Iterator middle =
    begin + ((end - begin) / 2 + BlockedPoints::Size - 1) / BlockedPoints::Size * BlockedPoints::Size;
  std::nth_element(begin, middle, end,
    [&](int a, int b) { return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b; });
  return middle;
}

/// Halves points until a block has them all. All blocks are full but the last.
void split(const Points& points, Iterator begin, Iterator end)
{
  if (end - begin > BlockedPoints::Size)
  {
    const Iterator middle = halve(points, begin, end);
    split(points, begin, middle);
    split(points, middle, end);
  }
}

/// Squared distances from a place to `count` boxes.
MEAM_ALL_VECTORS
void squaredDistances(
  const Eigen::Vector3f& place, const SoAPoints& low, const SoAPoints& high, int begin, int count, float* result)
{
  const float x = place.x(), y = place.y(), z = place.z();
  const float *lowX = low.x.data() + begin, *lowY = low.y.data() + begin, *lowZ = low.z.data() + begin;
  const float *highX = high.x.data() + begin, *highY = high.y.data() + begin, *highZ = high.z.data() + begin;
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float dx = std::max(std::max(lowX[k] - x, x - highX[k]), 0.0f);
    const float dy = std::max(std::max(lowY[k] - y, y - highY[k]), 0.0f);
    const float dz = std::max(std::max(lowZ[k] - z, z - highZ[k]), 0.0f);
    result[k] = dx * dx + dy * dy + dz * dz;
  }
}
}

BlockedPoints::BlockedPoints(const Points& points, int threads)
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (points[i].allFinite())
    {
      this->Order.push_back(static_cast<int>(i));
    }
  }
  const Iterator first = this->Order.begin(), end = this->Order.end();
  if (end - first > Size)
  {
    const Iterator middle = halve(points, first, end);
    inParallel(threads, { [&] { split(points, first, middle); }, [&] { split(points, middle, end); } });
  }
  for (std::size_t begin = 0; begin < this->Order.size(); begin += Size)
  {
    Eigen::AlignedBox3f box;
    for (std::size_t k = begin; k < std::min(begin + Size, this->Order.size()); ++k)
    {
      box.extend(points[this->Order[k]]);
    }
    this->Low.add(box.min());
    this->High.add(box.max());
  }
}

std::vector<int> BlockedPoints::within(const Eigen::Vector3f& centre, double radius) const
{
  const float reach = static_cast<float>(radius) * Wider;
  const int blocks = static_cast<int>(this->Low.size());
  std::vector<int> found(blocks);
  int number = 0;
  float distances[SoABlock];
  for (int begin = 0; begin < blocks; begin += SoABlock)
  {
    const int count = std::min(SoABlock, blocks - begin);
    squaredDistances(centre, this->Low, this->High, begin, count, distances);
    for (int k = 0; k < count; ++k)
    {
      found[number] = begin + k;
      number += distances[k] <= reach * reach ? 1 : 0;
    }
  }
  found.resize(number);
  return found;
}
}
