// SPDX-License-Identifier: BSD-3-Clause
#include "base/PointGrid.h"

#include "base/Bounds.h"
#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace meam
{
namespace
{
constexpr double MostCells = 4e6;
constexpr double SameDistance = 1e-4; // of a cube's side
constexpr float OtherSide = -0.5f;    // cosine of two normals, less and the points are of two sides of a sheet
constexpr double MostCubes = 1 << 21; // along an axis, so that 64 bits number all
constexpr double StrayShare = 0.001;  // of the points, at each end of each axis
constexpr double MiddleShare = 0.49;  // as that leaves next to the medians

/// A point and the number of the cube it lies in.
struct Member
{
  std::uint64_t cube;
  int point;
  float weight; ///< less next to the cube's border
};

/// Sorts by cube numbers of so many bits; members of one cube stay in their order.
void sortByCube(std::vector<Member>& members, int bits)
{
  constexpr int digit = 11;
  constexpr std::size_t values = std::size_t(1) << digit;
  std::vector<Member> sorted(members.size());
  std::vector<std::size_t> places(values);
  for (int shift = 0; shift < bits; shift += digit)
  {
    std::fill(places.begin(), places.end(), 0);
    for (const Member& member : members)
    {
      ++places[member.cube >> shift & (values - 1)];
    }
    std::exclusive_scan(places.begin(), places.end(), places.begin(), std::size_t(0));
    for (const Member& member : members)
    {
      sorted[places[member.cube >> shift & (values - 1)]++] = member;
    }
    members.swap(sorted);
  }
}
}

PointGrid::PointGrid(const Points& points, double cellSize)
{
  Eigen::AlignedBox3f box = bounds(points);
  if (box.isEmpty())
  {
    return;
  }
  double cell = cellSize;
  if (!(cell > 0.0) || !std::isfinite(cell) || !box.sizes().allFinite())
  {
    throw Error("Points cannot be sorted into cells of " + std::to_string(cellSize) +
                " mm: the points coincide, a length is zero, or coordinates are far beyond any part's size.");
  }
  // Stray points far away must cost neither memory nor speed: they go to the cells of the border. Then
  // cells grow until their number is reasonable.
  const auto cells = [&]() -> Eigen::Array3d { return (box.sizes().cast<double>() / cell).array().floor() + 1.0; };
  if (cells().prod() > MostCells)
  {
    box = innerBounds(points, StrayShare);
  }
  while (cells().prod() > MostCells)
  {
    cell *= 1.25;
  }
  this->Origin = box.min();
  this->InverseCell = static_cast<float>(1.0 / cell);
  this->Size = cells().cast<int>();
  std::vector<int> cellAt(points.size(), -1);
  // There are many more cells than points. Starts count each cell's points first, then are where they end, and at last
  // where they begin.
  this->Starts.assign(static_cast<std::size_t>(this->Size.x()) * this->Size.y() * this->Size.z() + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (points[i].allFinite())
    {
      const Eigen::Vector3i at = this->cellOf(points[i]);
      cellAt[i] = (at.z() * this->Size.y() + at.y()) * this->Size.x() + at.x();
      ++this->Starts[cellAt[i]];
    }
  }
  std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
  this->Order.resize(this->Starts.back());
  this->Sorted.resize(this->Starts.back());
  for (std::size_t i = points.size(); i-- > 0;)
  {
    if (cellAt[i] >= 0)
    {
      const int place = --this->Starts[cellAt[i]];
      this->Order[place] = static_cast<int>(i);
      this->Sorted.set(place, points[i]);
    }
  }
}

namespace
{
/// Points count less next to the borders of their cubes when they fade there, and the origin is the middle of a cube,
/// not a corner. With `normals`, points that face away from the one that is kept are of another side, of which one is
/// kept, too.
ThinnedPoints thin(const Points& points, double leafSize, bool fade, const Points* normals = nullptr)
{
  const double corner = fade ? 0.5 : 0.0;
  ThinnedPoints kept;
  if (!(leafSize > 0.0))
  {
    kept.indices.resize(points.size());
    std::iota(kept.indices.begin(), kept.indices.end(), 0);
    kept.weights.assign(points.size(), 1.0f);
    return kept;
  }
  constexpr double farthest = 9e18; // what 64 bits count
  const auto placeOf = [&](const Eigen::Vector3f& point) -> Eigen::Array3d
  { return point.cast<double>().array() / leafSize - corner; };
  const auto cubeOf = [&](const Eigen::Vector3f& point) -> Eigen::Array3d
  { return placeOf(point).floor().max(-farthest).min(farthest); };
  Eigen::AlignedBox3f box = bounds(points);
  if (box.isEmpty())
  {
    return kept;
  }
  // Cubes are numbered along z, then y, then x. Stray points far away go to the border of what 64 bits can number about
  // most of the points.
  Eigen::Array3d low = cubeOf(box.min());
  Eigen::Array3d most = cubeOf(box.max()) - low;
  if (most.maxCoeff() >= MostCubes)
  {
    low = low.max(cubeOf(innerBounds(points, MiddleShare).center()) - 0.5 * MostCubes);
    most = most.min(MostCubes - 1.0);
  }
  const auto bitsOf = [](double count) { return static_cast<int>(std::ceil(std::log2(count + 1.0))); };
  const int bitsX = bitsOf(most.x()), bitsY = bitsOf(most.y()), bitsZ = bitsOf(most.z());
  std::vector<Member> members;
  members.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (points[i].allFinite())
    {
      const Eigen::Array3d place = (placeOf(points[i]) - low).max(0.0).min(most + 1.0);
      const Eigen::Array<std::int64_t, 3, 1> cube = place.min(most).cast<std::int64_t>();
      const std::int64_t number = (cube.z() << bitsY | cube.y()) << bitsX | cube.x();
      const double weight = fade ? weightInCell<Eigen::Array3d>(place - cube.cast<double>()) : 1.0;
      members.push_back({ static_cast<std::uint64_t>(number), static_cast<int>(i), static_cast<float>(weight) });
    }
  }
  sortByCube(members, bitsX + bitsY + bitsZ);

  const double same = SameDistance * leafSize;
  using Members = std::vector<Member>::iterator;
  const auto keep = [&](Members begin, Members end)
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (auto member = begin; member != end; ++member)
    {
      sum += static_cast<double>(member->weight) * points[member->point].cast<double>();
      weights += member->weight;
    }
    const Eigen::Vector3d mean = sum / weights;
    // Of two points both are equally near to their mean: the one nearer to the cube's middle.
    const auto offCentre = [&](const Eigen::Vector3f& point)
    { return (placeOf(point) - cubeOf(point) - 0.5).matrix().squaredNorm(); };
    int nearest = begin->point;
    double distance = (points[nearest].cast<double>() - mean).norm();
    for (auto member = begin + 1; member < end; ++member)
    {
      const Eigen::Vector3f& point = points[member->point];
      const double other = (point.cast<double>() - mean).norm();
      const double nearer = distance - other;
      if (nearer > same || (nearer > -same && offCentre(point) < offCentre(points[nearest])))
      {
        nearest = member->point;
        distance = other;
      }
    }
    kept.indices.push_back(nearest);
    kept.weights.push_back(static_cast<float>(std::min(1.0, weights)));
  };
  for (auto begin = members.begin(); begin != members.end();)
  {
    const auto end = std::find_if(begin, members.end(), [&](const Member& other) { return other.cube != begin->cube; });
    keep(begin, end);
    if (normals)
    {
      const Eigen::Vector3f& normal = (*normals)[kept.indices.back()];
      const auto isOfSide = [&](const Member& member) { return !((*normals)[member.point].dot(normal) < OtherSide); };
      const auto other = std::stable_partition(begin, end, isOfSide);
      if (other != end)
      {
        kept.indices.pop_back();
        kept.weights.pop_back();
        keep(begin, other);
        keep(other, end);
      }
    }
    begin = end;
  }
  return kept;
}
}

std::vector<int> thinPoints(const Points& points, double leafSize) { return thin(points, leafSize, false).indices; }

std::vector<int> thinSurface(const PointCloud& surface, double leafSize)
{
  return thin(surface.points, leafSize, false, &surface.normals).indices;
}

ThinnedPoints thinWithWeights(const Points& points, double leafSize) { return thin(points, leafSize, true); }
}
