// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/CoarseGrid.h"

#include "base/Parallel.h"

#include <algorithm>
#include <limits>

namespace meam
{
namespace
{
/// Places of the four points of the grid that one of the halved grid stands for.
struct Four
{
  Four(const OrganizedCloud& cloud, int row, int column)
  {
    const int first = 2 * row * cloud.width + 2 * column;
    this->places[0] = first;
    this->places[1] = first + 1;
    this->places[2] = first + cloud.width;
    this->places[3] = first + cloud.width + 1;
  }

  int places[4];
};
}

OrganizedCloud halved(const OrganizedCloud& cloud, double jump, int threads)
{
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  OrganizedCloud half;
  half.width = cloud.width / 2;
  half.height = cloud.height / 2;
  half.points.assign(static_cast<std::size_t>(half.width) * half.height, Eigen::Vector3f::Constant(none));
  const float limit = static_cast<float>(jump);
  parallelForEach(half.height, threads, {},
    [&](int row)
    {
      for (int column = 0; column < half.width; ++column)
      {
        const Four four(cloud, row, column);
        float nearest = std::numeric_limits<float>::infinity();
        for (const int place : four.places)
        {
          const Eigen::Vector3f& point = cloud.points[place];
          nearest = point.allFinite() ? std::min(nearest, point.z()) : nearest;
        }
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        float count = 0.0f;
        for (const int place : four.places)
        {
          const Eigen::Vector3f& point = cloud.points[place];
          if (point.allFinite() && point.z() - nearest <= limit)
          {
            sum += point;
            ++count;
          }
        }
        if (count > 0.0f)
        {
          half.points[static_cast<std::size_t>(row) * half.width + column] = sum / count;
        }
      }
    });
  return half;
}

int placeInHalf(int point, const OrganizedCloud& halved, const OrganizedCloud& cloud)
{
  const int row = std::min(point / cloud.width / 2, halved.height - 1);
  const int column = std::min(point % cloud.width / 2, halved.width - 1);
  return row * halved.width + column;
}

std::vector<GridEdge> onFullGrid(
  const std::vector<GridEdge>& edges, const OrganizedCloud& halved, const OrganizedCloud& cloud)
{
  std::vector<GridEdge> full = edges;
  for (GridEdge& edge : full)
  {
    const Eigen::Vector3f& mean = halved.points[edge.point];
    const Four four(cloud, edge.point / halved.width, edge.point % halved.width);
    float least = std::numeric_limits<float>::infinity();
    for (const int place : four.places)
    {
      const float off = (cloud.points[place] - mean).squaredNorm(); // not less where nothing was measured
      if (off < least)
      {
        least = off;
        edge.point = place;
      }
    }
  }
  return full;
}
}
