// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/GridSurface.h"

#include "base/AllVectors.h"
#include "base/Parallel.h"
#include "base/sequences/Quantiles.h"
#include "scene/ScanQuality.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr int Samples = 100000;            // pairs of neighbours that the scale is told from, about
constexpr double LargestSlopeError = 0.05; // mm per mm, a window's: a larger one is used where noise makes more,
constexpr int SmallestWindow = 2;          // grid steps from the middle,
constexpr int LargestWindow = 6;           // and no more than these

/// Half the sides of the box around a window.
struct HalfBox
{
  explicit HalfBox(const GridWindow& window)
  {
    const Eigen::Vector2f d = window.direction.cwiseAbs();
    this->columns = static_cast<int>(d.x() * window.along + d.y() * window.across + 0.5f);
    this->rows = static_cast<int>(d.y() * window.along + d.x() * window.across + 0.5f);
  }

  int columns, rows;
};

/// For the least squares of P = middle + u alongColumn + v alongRow: sums over the points of a window, each as x, y, z
/// from the window's middle, and 1.
struct PlaneSums
{
  float points[4]{};
  float columns[4]{}; ///< each times u
  float rows[4]{};    ///< each times v
  float squares[4]{}; ///< uu, uv and vv
};

GridPlane planeOf(const Eigen::Vector3f& centre, const PlaneSums& of)
{
  GridPlane plane;
  const float count = of.points[3], u1 = of.columns[3], v1 = of.rows[3];
  Eigen::Matrix3f moments;
  moments << count, u1, v1, u1, of.squares[0], of.squares[1], v1, of.squares[1], of.squares[2];
  Eigen::Matrix3f inverse;
  bool solvable = false;
  moments.computeInverseWithCheck(inverse, solvable, 0.5f); // a determinant of whole numbers
  if (count < static_cast<float>(FewestPoints) || !solvable)
  {
    return plane;
  }
  Eigen::Matrix3f sums;
  sums << Eigen::Vector3f(of.points), Eigen::Vector3f(of.columns), Eigen::Vector3f(of.rows);
  const Eigen::Matrix3f fit = sums * inverse;
  plane.middle = centre + fit.col(0);
  plane.alongColumn = fit.col(1);
  plane.alongRow = fit.col(2);
  return plane;
}

constexpr float Rim = 0.01f; // grid steps, points on the border of a window belong to it

/// Two windows side by side in a vector, four numbers each.
using Floats = float __attribute__((vector_size(32)));
using Bits = int __attribute__((vector_size(32)));

/// Sums up two windows that lie inside the grid. Their middles are at `first` and `second`, `stride` numbers from row
/// to row; `box` holds both.
MEAM_ALL_VECTORS
void sumUpTwo(const float* first, const float* second, std::ptrdiff_t stride, const GridWindow& a, const GridWindow& b,
  const HalfBox& box, float jump, PlaneSums* sums)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Bits magnitude = Bits{} + 0x7fffffff;
  const Floats middle{ first[0], first[1], first[2], -1.0f, second[0], second[1], second[2], -1.0f };
  const Floats farthest{ infinity, infinity, jump, infinity, infinity, infinity, jump, infinity };
  const Floats byColumn{ a.direction.x(), -a.direction.y(), 0, 0, b.direction.x(), -b.direction.y(), 0, 0 };
  const Floats byRow{ a.direction.y(), a.direction.x(), 0, 0, b.direction.y(), b.direction.x(), 0, 0 };
  const Floats sides{ a.along + Rim, a.across + Rim, 0, 0, b.along + Rim, b.across + Rim, 0, 0 };
  const Floats ofColumn{ 1, 0, 0, 0, 1, 0, 0, 0 }, ofRow{ 0, 1, 0, 0, 0, 1, 0, 0 }, ofRows{ 0, 0, 1, 0, 0, 0, 1, 0 };
  Floats points{}, columns{}, rows{}, squares{};
  for (int r = -box.rows; r <= box.rows; ++r)
  {
    const float* p = first + r * stride - 3 * box.columns;
    const float* q = second + r * stride - 3 * box.columns;
    const float v = static_cast<float>(r);
    const Floats row = v * byRow, rowSquares = v * v * ofRows;
    float u = static_cast<float>(-box.columns);
    for (int c = -box.columns; c <= box.columns; ++c, u += 1.0f, p += 3, q += 3)
    {
      const Floats offset = Floats{ p[0], p[1], p[2], 0.0f, q[0], q[1], q[2], 0.0f } - middle;
      const Floats place = u * byColumn + row; // along and across the direction
      // Of another surface, or not a number; or outside the rectangle.
      Bits in = ((Floats)((Bits)offset & magnitude) < farthest) & ((Floats)((Bits)place & magnitude) <= sides);
      in &= __builtin_shufflevector(in, in, 2, 3, 0, 1, 6, 7, 4, 5);
      in &= __builtin_shufflevector(in, in, 1, 0, 3, 2, 5, 4, 7, 6);
      const Floats point = (Floats)((Bits)offset & in);
      points += point;
      columns += u * point;
      rows += v * point;
      squares += (Floats)((Bits)(u * (u * ofColumn + v * ofRow) + rowSquares) & in);
    }
  }
  for (int k = 0; k < 8; ++k)
  {
    sums[k / 4].points[k % 4] = points[k];
    sums[k / 4].columns[k % 4] = columns[k];
    sums[k / 4].rows[k % 4] = rows[k];
    sums[k / 4].squares[k % 4] = squares[k];
  }
}
}

double GridScale::depthJump() const { return JumpSlopes * this->pointDistance + JumpNoises * this->noise; }

int GridScale::windowRadius() const
{
  int radius = SmallestWindow;
  while (this->slopeError(radius) > LargestSlopeError && radius < LargestWindow)
  {
    ++radius;
  }
  return radius;
}

double GridScale::slopeError(int radius) const
{
  // Noise over the root of the sum of the squared distances from the middle.
  return this->noise / (this->pointDistance * (2.0 * radius + 1.0) * std::sqrt(radius * (radius + 1.0) / 3.0));
}

GridScale gridScale(const OrganizedCloud& cloud, int threads)
{
  std::vector<float> distances;
  std::vector<float> bends;
  distances.reserve(2 * static_cast<std::size_t>(Samples));
  bends.reserve(2 * static_cast<std::size_t>(Samples));
  const int stride = std::max(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(cloud.size()) / Samples))), 1);
  for (int first = 0; first < stride && bends.empty(); ++first) // just these rows may be without measured neighbours
  {
    for (int row = first; row < cloud.height; row += stride)
    {
      const Eigen::Vector3f* points = cloud.points.data() + static_cast<std::size_t>(row) * cloud.width;
      for (int column = 1; column < cloud.width; column += stride)
      {
        const Eigen::Vector3f step = points[column] - points[column - 1];
        if (!step.allFinite())
        {
          continue;
        }
        distances.push_back(step.head<2>().norm());
        if (column + 1 < cloud.width && points[column + 1].allFinite())
        {
          bends.push_back(std::abs(points[column + 1].z() - points[column].z() - step.z()));
        }
      }
    }
  }
  GridScale scale;
  // Of a normal distribution half is within 0.6745 deviations; the second difference has the root of 6 of them.
  inParallel(threads, { [&] { scale.pointDistance = medianOf(distances); },
                        [&] { scale.noise = medianOf(bends) / (0.6745 * std::sqrt(6.0)); } });
  return scale;
}

GridPlane fitPlane(const OrganizedCloud& cloud, int row, int column, const GridWindow& window, double jump)
{
  const Eigen::Vector3f& centre = cloud.points[static_cast<std::size_t>(row) * cloud.width + column];
  if (!centre.allFinite())
  {
    return {};
  }
  const HalfBox box(window);
  const float limit = static_cast<float>(jump);
  const float along = window.along + Rim;
  const float across = window.across + Rim;
  Eigen::Vector4f points = Eigen::Vector4f::Zero(), columns = points, rows = points, squares = points;
  for (int r = std::max(row - box.rows, 0); r <= std::min(row + box.rows, cloud.height - 1); ++r)
  {
    const Eigen::Vector3f* from = cloud.points.data() + static_cast<std::size_t>(r) * cloud.width;
    const float v = static_cast<float>(r - row);
    for (int c = std::max(column - box.columns, 0); c <= std::min(column + box.columns, cloud.width - 1); ++c)
    {
      const float u = static_cast<float>(c - column);
      const Eigen::Vector3f offset = from[c] - centre;
      const bool inside = std::abs(u * window.direction.x() + v * window.direction.y()) <= along &&
                          std::abs(v * window.direction.x() - u * window.direction.y()) <= across;
      if (!inside || !(std::abs(offset.z()) < limit) || !std::isfinite(offset.x() + offset.y()))
      {
        continue;
      }
      const Eigen::Vector4f point = offset.homogeneous();
      points += point;
      columns += u * point;
      rows += v * point;
      squares += Eigen::Vector4f(u * u, u * v, v * v, 0.0f);
    }
  }
  PlaneSums sums;
  Eigen::Vector4f::Map(sums.points) = points;
  Eigen::Vector4f::Map(sums.columns) = columns;
  Eigen::Vector4f::Map(sums.rows) = rows;
  Eigen::Vector4f::Map(sums.squares) = squares;
  return planeOf(centre, sums);
}

void fitPlanes(
  const OrganizedCloud& cloud, const int* points, const GridWindow* windows, int count, double jump, GridPlane* planes)
{
  const auto isInside = [&](int row, int column, const HalfBox& box)
  {
    return row >= box.rows && column >= box.columns && row + box.rows < cloud.height &&
           column + box.columns < cloud.width;
  };
  const auto fitOne = [&](int i)
  { planes[i] = fitPlane(cloud, points[i] / cloud.width, points[i] % cloud.width, windows[i], jump); };
  int i = 0;
  for (; i + 1 < count; i += 2)
  {
    const Eigen::Vector3f &first = cloud.points[points[i]], &second = cloud.points[points[i + 1]];
    HalfBox box(windows[i]);
    const HalfBox other(windows[i + 1]);
    box.columns = std::max(box.columns, other.columns);
    box.rows = std::max(box.rows, other.rows);
    if (!first.allFinite() || !second.allFinite() || !isInside(points[i] / cloud.width, points[i] % cloud.width, box) ||
        !isInside(points[i + 1] / cloud.width, points[i + 1] % cloud.width, box))
    {
      fitOne(i);
      fitOne(i + 1);
      continue;
    }
    PlaneSums sums[2];
    sumUpTwo(first.data(), second.data(), 3 * static_cast<std::ptrdiff_t>(cloud.width), windows[i], windows[i + 1], box,
      static_cast<float>(jump), sums);
    planes[i] = planeOf(first, sums[0]);
    planes[i + 1] = planeOf(second, sums[1]);
  }
  if (i < count)
  {
    fitOne(i);
  }
}
}
