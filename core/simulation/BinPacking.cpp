// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/BinPacking.h"

#include "mesh/ConvexHull.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr double CellsPerDiameter = 64.0;
constexpr int Starts = 3;
constexpr int PlacesPerStart = 16;
constexpr int Steps = 80;
constexpr double FirstTurn = 0.6; // radians, at most; every step Shrink of the one before
constexpr double Shrink = 0.95;

/// One cell of the grid below a turned part, and the part's lowest and highest point in it.
struct Cell
{
  int x;
  int y;
  float low;
  float high;
};

/// A part turned but not moved, on the grid.
struct Footprint
{
  std::vector<Cell> cells; ///< x and y from 0
  int x = 0;               ///< cell of the grid at which they start
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The cells that the part touches. Heights are bounds over the whole cell, so that two parts whose
/// heights do not cross in any cell do not cross at all.
Footprint footprintOf(const TriangleMesh& part, const Eigen::Matrix3d& rotation, double cellSize)
{
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(part.vertices.size());
  Eigen::AlignedBox3d box;
  for (const auto& vertex : part.vertices)
  {
    corners.push_back(rotation * vertex.cast<double>());
    corners.back().head<2>() /= cellSize;
    box.extend(corners.back());
  }
  Footprint result;
  // One cell more on every side: a vertex on a cell's border belongs to both.
  result.x = static_cast<int>(std::floor(box.min().x())) - 1;
  result.y = static_cast<int>(std::floor(box.min().y())) - 1;
  result.width = static_cast<int>(std::ceil(box.max().x())) + 1 - result.x;
  result.height = static_cast<int>(std::ceil(box.max().y())) + 1 - result.y;
  const float none = std::numeric_limits<float>::infinity();
  std::vector<std::pair<float, float>> heights(static_cast<std::size_t>(result.width) * result.height, { none, -none });

  constexpr double margin = 1e-6;
  const Eigen::Vector3d shift(result.x, result.y, 0.0);
  for (const auto& triangle : part.triangles)
  {
    const Eigen::Vector3d p[3] = { corners[triangle[0]] - shift, corners[triangle[1]] - shift,
      corners[triangle[2]] - shift };
    const Eigen::Vector3d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
    const Eigen::Vector3d high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const double sign = normal.z() < 0.0 ? -1.0 : 1.0;
    const bool upright = std::abs(normal.z()) < 1e-9;
    const double slopeX = upright ? 0.0 : -normal.x() / normal.z();
    const double slopeY = upright ? 0.0 : -normal.y() / normal.z();
    const double spread = upright ? none : 0.5 * (std::abs(slopeX) + std::abs(slopeY));
    Eigen::Vector2d edge[3];
    double reach[3];
    for (int k = 0; k < 3; ++k)
    {
      edge[k] = sign * (p[(k + 1) % 3] - p[k]).head<2>();
      reach[k] = -0.5 * (std::abs(edge[k].x()) + std::abs(edge[k].y())) - margin;
    }
    const int lastX = static_cast<int>(high.x() + margin);
    const int lastY = static_cast<int>(high.y() + margin);
    for (int y = static_cast<int>(low.y() - margin); y <= lastY; ++y)
    {
      for (int x = static_cast<int>(low.x() - margin); x <= lastX; ++x)
      {
        // The cell is left out only if it is wholly on the outer side of one edge.
        const Eigen::Vector2d middle(x + 0.5, y + 0.5);
        bool outside = false;
        for (int k = 0; k < 3; ++k)
        {
          const Eigen::Vector2d from = middle - p[k].head<2>();
          outside |= edge[k].x() * from.y() - edge[k].y() * from.x() < reach[k];
        }
        if (outside)
        {
          continue;
        }
        const double z = p[0].z() + slopeX * (middle.x() - p[0].x()) + slopeY * (middle.y() - p[0].y());
        auto& cell = heights[static_cast<std::size_t>(y) * result.width + x];
        cell.first = std::min(cell.first, static_cast<float>(std::max(z - spread, low.z())));
        cell.second = std::max(cell.second, static_cast<float>(std::min(z + spread, high.z())));
      }
    }
  }
  for (int y = 0; y < result.height; ++y)
  {
    for (int x = 0; x < result.width; ++x)
    {
      const auto& [bottom, top] = heights[static_cast<std::size_t>(y) * result.width + x];
      if (bottom <= top)
      {
        result.cells.push_back({ x, y, bottom, top });
      }
    }
  }
  return result;
}

/// The height of what lies in the bin, cell by cell.
struct Pile
{
  explicit Pile(int size)
    : size(size)
    , heights(static_cast<std::size_t>(size) * size, 0.0f)
  {
  }
  /// How high a part has to be lifted to lie with its footprint's corner at cell x, y.
  float liftAt(const Footprint& part, int x, int y) const
  {
    float lift = -std::numeric_limits<float>::infinity();
    for (const Cell& cell : part.cells)
    {
      lift = std::max(lift, this->heights[static_cast<std::size_t>(y + cell.y) * this->size + x + cell.x] - cell.low);
    }
    return lift;
  }
  void add(const Footprint& part, int x, int y, float lift)
  {
    for (const Cell& cell : part.cells)
    {
      float& height = this->heights[static_cast<std::size_t>(y + cell.y) * this->size + x + cell.x];
      height = std::max(height, cell.high + lift);
    }
  }

  int size;
  std::vector<float> heights;
};

/// A way for a part to lie.
struct Rest
{
  Eigen::Matrix3d rotation;
  Footprint footprint;
  int x = 0;
  int y = 0;
  float lift = 0.0f;
  double gravity = std::numeric_limits<double>::infinity(); ///< height of the centre of gravity
};

/// The centre of the surface, which is near enough to the centre of gravity of a thin-walled part
/// and is there for open meshes too.
Eigen::Vector3d centreOf(const TriangleMesh& part)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (const auto& t : part.triangles)
  {
    const Eigen::Vector3d a = part.vertices[t[0]].cast<double>();
    const Eigen::Vector3d b = part.vertices[t[1]].cast<double>();
    const Eigen::Vector3d c = part.vertices[t[2]].cast<double>();
    const double weight = (b - a).cross(c - a).norm();
    sum += weight / 3.0 * (a + b + c);
    area += weight;
  }
  return area > 0.0 ? Eigen::Vector3d(sum / area) : bounds(part.vertices).center().cast<double>().eval();
}

Eigen::Vector3d randomDirection(Random& random)
{
  const double z = random.uniform(-1.0, 1.0);
  const double angle = random.uniform(0.0, 2.0 * M_PI);
  const double radius = std::sqrt(1.0 - z * z);
  return { radius * std::cos(angle), radius * std::sin(angle), z };
}
}

std::vector<Eigen::Isometry3d> packBin(
  const TriangleMesh& part, double binSize, int copies, Random& random, const Progress& progress)
{
  const double cellSize = diameter(part.vertices) / CellsPerDiameter;
  const Eigen::Vector3d centre = centreOf(part);
  Pile pile(static_cast<int>(binSize / cellSize));
  const auto fits = [&](const Footprint& footprint)
  { return footprint.width <= pile.size && footprint.height <= pile.size; };
  const auto drop = [&](Rest& rest)
  {
    rest.lift = pile.liftAt(rest.footprint, rest.x, rest.y);
    rest.gravity = rest.lift + (rest.rotation * centre).z();
  };

  std::vector<Eigen::Isometry3d> poses;
  for (int copy = 0; copy < copies; ++copy)
  {
    report(progress, static_cast<double>(copy) / copies);
    Rest best;
    for (int start = 0; start < Starts; ++start)
    {
      Rest rest;
      rest.rotation = Eigen::AngleAxisd(random.uniform(0.0, M_PI), randomDirection(random)).matrix();
      rest.footprint = footprintOf(part, rest.rotation, cellSize);
      for (int place = 0; place < PlacesPerStart && fits(rest.footprint); ++place)
      {
        rest.x = static_cast<int>(random.index(pile.size - rest.footprint.width + 1));
        rest.y = static_cast<int>(random.index(pile.size - rest.footprint.height + 1));
        drop(rest);
        if (rest.gravity < best.gravity)
        {
          best = rest;
        }
      }
    }
    if (best.footprint.cells.empty())
    {
      throw Error("The part does not fit into the bin: make the bin larger.");
    }
    double turn = FirstTurn;
    for (int step = 0; step < Steps; ++step, turn *= Shrink)
    {
      Rest rest;
      rest.rotation = Eigen::AngleAxisd(turn * random.uniform(), randomDirection(random)).matrix() * best.rotation;
      rest.footprint = footprintOf(part, rest.rotation, cellSize);
      // Turned about its middle and pushed about as far as the turn moves its ends.
      const double push = 0.5 * turn * CellsPerDiameter;
      const auto place = [&](int corner, int before, int now, double by)
      { return corner + (before - now) / 2 + static_cast<int>(std::lround(by)); };
      rest.x = place(best.x, best.footprint.width, rest.footprint.width, random.uniform(-push, push));
      rest.y = place(best.y, best.footprint.height, rest.footprint.height, random.uniform(-push, push));
      if (fits(rest.footprint))
      {
        rest.x = std::clamp(rest.x, 0, pile.size - rest.footprint.width);
        rest.y = std::clamp(rest.y, 0, pile.size - rest.footprint.height);
        drop(rest);
        if (rest.gravity < best.gravity)
        {
          best = std::move(rest);
        }
      }
    }
    pile.add(best.footprint, best.x, best.y, best.lift);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = best.rotation;
    pose.translation() << (best.x - best.footprint.x - 0.5 * pile.size) * cellSize,
      (best.y - best.footprint.y - 0.5 * pile.size) * cellSize, best.lift;
    poses.push_back(pose);
  }
  report(progress, 1.0);
  return poses;
}
}
