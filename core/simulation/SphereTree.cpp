// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/SphereTree.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr int MostPoints = 8; // in a ball without balls inside
}

SphereTree::SphereTree(Points points)
  : Sorted(std::move(points))
{
  if (!this->Sorted.empty())
  {
    this->add(0, static_cast<int>(this->Sorted.size()));
  }
}

void SphereTree::add(int begin, int end)
{
  const auto first = this->Sorted.begin() + begin;
  const auto last = this->Sorted.begin() + end;
  Eigen::AlignedBox3f box;
  std::for_each(first, last, [&](const Eigen::Vector3f& point) { box.extend(point); });
  float squaredRadius = 0.0f;
  std::for_each(first, last,
    [&](const Eigen::Vector3f& point)
    { squaredRadius = std::max(squaredRadius, (point - box.center()).squaredNorm()); });
  const std::size_t ball = this->Balls.size();
  this->Balls.push_back({ box.center(), std::sqrt(squaredRadius), 0, begin, end });
  if (end - begin > MostPoints)
  {
    this->Balls[ball].end = begin;
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const int middle = begin + (end - begin) / 2;
    std::nth_element(first, this->Sorted.begin() + middle, last,
      [axis](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a[axis] < b[axis]; });
    this->add(begin, middle);
    this->add(middle, end);
  }
  this->Balls[ball].next = this->Balls.size();
}
}
