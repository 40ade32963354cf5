// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/PixelMap.h"

#include "base/Parallel.h"
#include "base/sequences/Quantiles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace meam
{
namespace
{
constexpr int SmallHole = 4;        // grid steps: so wide a hole in a surface is taken as closed,
constexpr double WidestHole = 1.0;  // and one between two depths that is no wider than so many times the difference
constexpr double BeyondImage = 1.1; // of the image's widest ray: the lens model is not asked for more
constexpr int Stride = 7; // of the grid points one of so many tells of the distance to its neighbour in the image

constexpr std::uint32_t Unknown = 0xffffffffu; // a mark instead of a point, for what hides all behind it

/// Where the camera sees a grid point, in pixels, and how far away; NaN when it does not.
struct Seen
{
  Eigen::Vector2f pixel = Eigen::Vector2f::Constant(std::numeric_limits<float>::quiet_NaN());
  float depth = 0.0f;
  bool measured = false; ///< false: between measured points

  bool valid() const { return this->pixel.allFinite(); }
};

/// For every pixel the point with the least of some number, found by many threads in any order.
class LeastBuffer
{
public:
  LeastBuffer(int width, int height)
    : Width(width)
    , Height(height)
    , Cells(static_cast<std::size_t>(width) * height)
  {
    for (auto& cell : this->Cells)
    {
      cell.store(std::numeric_limits<std::uint64_t>::max(), std::memory_order_relaxed);
    }
  }

  void add(int row, int column, float number, std::uint32_t point)
  {
    // Bits of numbers that are not negative are ordered as the numbers are; of equal ones the first point stays.
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    const std::uint64_t value = (static_cast<std::uint64_t>(bits) << 32) | point;
    auto& cell = this->Cells[static_cast<std::size_t>(row) * this->Width + column];
    std::uint64_t now = cell.load(std::memory_order_relaxed);
    while (value < now && !cell.compare_exchange_weak(now, value, std::memory_order_relaxed))
    {
    }
  }

  /// The pixels whose middle is in a triangle: its depth there, and the corner that is nearest in the image.
  void addTriangle(const std::array<Seen, 3>& corners, const std::array<std::uint32_t, 3>& points)
  {
    const auto cross = [](const Eigen::Vector2f& a, const Eigen::Vector2f& b) { return a.x() * b.y() - a.y() * b.x(); };
    const Eigen::Vector2f low = corners[0].pixel.cwiseMin(corners[1].pixel).cwiseMin(corners[2].pixel);
    const Eigen::Vector2f high = corners[0].pixel.cwiseMax(corners[1].pixel).cwiseMax(corners[2].pixel);
    const float left = std::ceil(std::max(low.x(), 0.0f));
    const float right = std::floor(std::min(high.x(), static_cast<float>(this->Width - 1)));
    const float top = std::ceil(std::max(low.y(), 0.0f));
    const float bottom = std::floor(std::min(high.y(), static_cast<float>(this->Height - 1)));
    const float area = cross(corners[1].pixel - corners[0].pixel, corners[2].pixel - corners[0].pixel);
    if (!(left <= right) || !(top <= bottom) || area == 0.0f)
    {
      return;
    }
    for (int row = static_cast<int>(top); row <= static_cast<int>(bottom); ++row)
    {
      for (int column = static_cast<int>(left); column <= static_cast<int>(right); ++column)
      {
        const Eigen::Vector2f at(column, row);
        float depth = 0.0f;
        bool inside = true;
        int nearest = 0;
        for (int k = 0; k < 3; ++k)
        {
          const Seen& a = corners[(k + 1) % 3];
          const Seen& b = corners[(k + 2) % 3];
          const float weight = cross(b.pixel - a.pixel, at - a.pixel) / area;
          inside = inside && weight >= 0.0f;
          depth += weight * corners[k].depth;
          nearest = (corners[k].pixel - at).squaredNorm() < (corners[nearest].pixel - at).squaredNorm() ? k : nearest;
        }
        if (inside)
        {
          this->add(row, column, depth, points[nearest]);
        }
      }
    }
  }

  /// NaN where nothing was added.
  float number(std::size_t pixel) const
  {
    const auto bits = static_cast<std::uint32_t>(this->Cells[pixel].load(std::memory_order_relaxed) >> 32);
    float result = 0.0f;
    std::memcpy(&result, &bits, sizeof(result));
    return result;
  }
  /// Unknown where nothing was added.
  std::uint32_t point(std::size_t pixel) const
  {
    return static_cast<std::uint32_t>(this->Cells[pixel].load(std::memory_order_relaxed));
  }

private:
  int Width;
  int Height;
  std::vector<std::atomic<std::uint64_t>> Cells;
};

/// The tangent of the angle between the camera's axis and the farthest ray that its image has. A lens model
/// holds there; far outside it may fold points back into the image.
double widestRay(const Camera& camera)
{
  double widest = 0.0;
  for (int k = 0; k < 8; ++k)
  {
    constexpr std::array<std::pair<double, double>, 8> border{ { { 0, 0 }, { 0.5, 0 }, { 1, 0 }, { 0, 0.5 }, { 1, 0.5 },
      { 0, 1 }, { 0.5, 1 }, { 1, 1 } } };
    const Eigen::Vector2d pixel(border[k].first * camera.width, border[k].second * camera.height);
    const Eigen::Vector3d ray = camera.T_camera_scene * unproject(camera, pixel, 1.0);
    widest = ray.allFinite() ? std::max(widest, ray.head<2>().norm()) : widest;
  }
  return widest > 0.0 ? BeyondImage * widest : std::numeric_limits<double>::infinity();
}

/// Holes in the rows of the grid that are small, or narrow for their depth, get points on the line between their
/// borders; those are not measured.
std::vector<Eigen::Vector3f> withoutHoles(const OrganizedCloud& cloud, int row)
{
  const auto begin = cloud.points.begin() + static_cast<std::ptrdiff_t>(row) * cloud.width;
  std::vector<Eigen::Vector3f> points(begin, begin + cloud.width);
  int last = -1;
  for (int column = 0; column < cloud.width; ++column)
  {
    if (!points[column].allFinite())
    {
      continue;
    }
    const int steps = column - last;
    if (last >= 0 && steps > 1)
    {
      const Eigen::Vector3f across = points[column] - points[last];
      if (steps <= SmallHole || across.head<2>().norm() <= WidestHole * std::abs(across.z()))
      {
        for (int k = 1; k < steps; ++k)
        {
          points[last + k] = points[last] + across * (static_cast<float>(k) / static_cast<float>(steps));
        }
      }
    }
    last = column;
  }
  return points;
}

std::vector<Seen> seenBy(const Camera& camera, const OrganizedCloud& cloud, int threads, const Progress& progress)
{
  const double widest = widestRay(camera);
  std::vector<Seen> all(cloud.size());
  parallelForEach(cloud.height, threads, progress,
    [&](int row)
    {
      const std::vector<Eigen::Vector3f> points = withoutHoles(cloud, row);
      for (int column = 0; column < cloud.width; ++column)
      {
        const std::size_t index = static_cast<std::size_t>(row) * cloud.width + column;
        const Eigen::Vector3d inCamera = camera.T_camera_scene * points[column].cast<double>();
        if (inCamera.head<2>().norm() <= widest * inCamera.z()) // false for NaN
        {
          all[index].pixel = project(camera, points[column].cast<double>()).cast<float>();
          all[index].depth = static_cast<float>(inCamera.z());
          all[index].measured = cloud.points[index].allFinite();
        }
      }
    });
  return all;
}

/// The pixel of a measured point; none outside the image.
std::optional<Eigen::Vector2i> pixelOf(const Seen& seen, const Camera& camera)
{
  const Eigen::Vector2f pixel(std::round(seen.pixel.x()), std::round(seen.pixel.y()));
  const bool inside = pixel.x() >= 0.0f && pixel.y() >= 0.0f && pixel.x() < static_cast<float>(camera.width) &&
                      pixel.y() < static_cast<float>(camera.height); // false for NaN
  return seen.measured && inside ? std::optional<Eigen::Vector2i>(pixel.cast<int>()) : std::nullopt;
}

std::size_t placeOf(const Eigen::Vector2i& pixel, const Camera& camera)
{
  return static_cast<std::size_t>(pixel.y()) * camera.width + pixel.x();
}

/// Median distance in the image of neighbours in a row; at least one pixel.
double pixelsPerPoint(const std::vector<Seen>& seen, int width)
{
  std::vector<float> distances;
  for (std::size_t i = 1; i < seen.size(); i += Stride)
  {
    const float distance = (seen[i].pixel - seen[i - 1].pixel).norm();
    if (i % width != 0 && distance >= 0.0f)
    {
      distances.push_back(distance);
    }
  }
  return std::max(static_cast<double>(medianOf(distances)), 1.0);
}

/// seen(pixel) is the point that a pixel shows, or -1, and its depth; pixels are numbered row by row.
template <typename Seen>
int nearestAround(int width, int height, int row, int column, int radius, double jump, const Seen& seen)
{
  const int top = std::max(row - radius, 0);
  const int bottom = std::min(row + radius, height - 1);
  const int left = std::max(column - radius, 0);
  const int right = std::min(column + radius, width - 1);
  const auto forEach = [&](const auto& visit)
  {
    for (int r = top; r <= bottom; ++r)
    {
      for (int c = left; c <= right; ++c)
      {
        const auto [point, depth] = seen(static_cast<std::size_t>(r) * width + c);
        if (point >= 0)
        {
          visit(point, depth, (r - row) * (r - row) + (c - column) * (c - column));
        }
      }
    }
  };
  float nearest = std::numeric_limits<float>::infinity();
  forEach([&](int, float depth, int) { nearest = std::min(nearest, depth); });
  const auto [own, ownDepth] = seen(static_cast<std::size_t>(row) * width + column);
  if (own >= 0 && ownDepth <= nearest + static_cast<float>(jump))
  {
    return own; // none is closer
  }
  int best = -1;
  int bestPixels = 0;
  float bestDepth = 0.0f;
  forEach(
    [&](int point, float depth, int pixels)
    {
      if (depth <= nearest + static_cast<float>(jump) &&
          (best < 0 || pixels < bestPixels || (pixels == bestPixels && depth < bestDepth)))
      {
        best = point;
        bestPixels = pixels;
        bestDepth = depth;
      }
    });
  return best;
}
}

PixelMap projectedPixels(
  const OrganizedCloud& cloud, const Camera& camera, double jump, int threads, const Progress& progress)
{
  requireCamera(camera);
  if (camera.width < 1 || camera.height < 1)
  {
    throw Error("The size of the camera's image is not known: give its width and height in pixels.");
  }
  const std::vector<Seen> seen = seenBy(camera, cloud, threads, subProgress(progress, 0.0, 0.4));
  LeastBuffer front(camera.width, camera.height); // the least depth
  parallelForEach(cloud.height, threads, subProgress(progress, 0.4, 0.8),
    [&](int row)
    {
      for (int column = 0; column < cloud.width; ++column)
      {
        const std::uint32_t first = static_cast<std::uint32_t>(row) * cloud.width + column;
        if (const auto pixel = pixelOf(seen[first], camera))
        {
          front.add(pixel->y(), pixel->x(), seen[first].depth, first);
        }
        if (row + 1 == cloud.height || column + 1 == cloud.width)
        {
          continue;
        }
        const std::uint32_t below = first + cloud.width;
        for (const std::array<std::uint32_t, 3>& ids :
          { std::array<std::uint32_t, 3>{ first, first + 1, below }, { first + 1, below + 1, below } })
        {
          const std::array<Seen, 3> corners{ seen[ids[0]], seen[ids[1]], seen[ids[2]] };
          if (!corners[0].valid() || !corners[1].valid() || !corners[2].valid())
          {
            continue;
          }
          const auto [low, high] = std::minmax({ corners[0].depth, corners[1].depth, corners[2].depth });
          const bool surface = corners[0].measured && corners[1].measured && corners[2].measured && high - low <= jump;
          front.addTriangle(corners, surface ? ids : std::array<std::uint32_t, 3>{ Unknown, Unknown, Unknown });
        }
      }
    });
  LeastBuffer closest(camera.width, camera.height); // of the points in front, the least distance to the pixel's middle
  parallelFor(cloud.height, threads, subProgress(progress, 0.8, 1.0),
    [&](int begin, int end, int)
    {
      for (int i = begin * cloud.width; i < end * cloud.width; ++i)
      {
        const auto pixel = pixelOf(seen[i], camera);
        if (pixel && seen[i].depth <= front.number(placeOf(*pixel, camera)) + static_cast<float>(jump))
        {
          const float distance = (seen[i].pixel - pixel->cast<float>()).squaredNorm();
          closest.add(pixel->y(), pixel->x(), distance, static_cast<std::uint32_t>(i));
        }
      }
    });
  PixelMap map{ camera.width, camera.height, {}, {} };
  for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(camera.width) * camera.height; ++pixel)
  {
    const std::uint32_t point = closest.point(pixel) != Unknown ? closest.point(pixel) : front.point(pixel);
    map.points.push_back(point == Unknown ? -1 : static_cast<int>(point));
    map.depths.push_back(front.number(pixel));
  }
  if (std::all_of(map.points.begin(), map.points.end(), [](int point) { return point < 0; }))
  {
    throw Error("The camera does not see the scene: check its position (the transform takes points of the scan to the "
                "camera, in mm) and its focal lengths.");
  }
  map.pixelsPerPoint = pixelsPerPoint(seen, cloud.width);
  return map;
}

int pointOfPixel(const PixelMap& map, int row, int column, int radius, double jump)
{
  return nearestAround(map.width, map.height, row, column, radius, jump,
    [&](std::size_t pixel) { return std::make_pair(map.points[pixel], map.depths[pixel]); });
}

int pointOfPixel(const OrganizedCloud& cloud, int row, int column, int radius, double jump)
{
  return nearestAround(cloud.width, cloud.height, row, column, radius, jump,
    [&](std::size_t pixel)
    {
      const Eigen::Vector3f& point = cloud.points[pixel];
      return std::make_pair(point.allFinite() ? static_cast<int>(pixel) : -1, point.z());
    });
}
}
