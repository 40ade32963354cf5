// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/parts/SamplePart.h"

#include "simulation/parts/ColumnMesh.h"

#include <array>
#include <cmath>

namespace meam
{
namespace
{
using Vector = Eigen::Vector2d;

/// A circle drawn as a regular polygon with a corner at angle 0.
struct Circle
{
  Vector centre;
  double radius;
  int corners;

  Vector corner(int i) const
  {
    const double angle = 2.0 * M_PI * i / this->corners;
    return this->centre + this->radius * Vector(std::cos(angle), std::sin(angle));
  }
  bool contains(const Vector& point) const
  {
    const Vector d = point - this->centre;
    const double side = 2.0 * M_PI / this->corners;
    const double angle = std::atan2(d.y(), d.x()) / side;
    return d.norm() * std::cos((angle - std::floor(angle) - 0.5) * side) < this->radius * std::cos(0.5 * side);
  }
};

Vector corner(double radius, double degrees)
{
  return radius * Vector(std::cos(degrees * M_PI / 180.0), std::sin(degrees * M_PI / 180.0));
}

constexpr int Layers = 5;
const std::vector<double> Levels{ 0.0, 3.0, 6.0, 10.0, 12.0, 22.0 };
enum Layer
{
  SpigotLayer,
  FlangeLayer,
  RibLayer,
  RimLayer,
  HubLayer
};
using Column = std::array<bool, Layers>; ///< solid or empty, layer by layer

const Circle Flange{ { 0, 0 }, 35, 72 };
const Circle RimInside{ { 0, 0 }, 32, 72 };
const Circle Hub{ { 0, 0 }, 12, 36 };
const Circle Bore{ { 0, 0 }, 8, 32 };
const Circle SpigotOutside{ { 0, 0 }, 17, 48 };
const Circle SpigotInside{ { 0, 0 }, 14, 40 };
const Circle Lug{ { 38.5, 0 }, 6.5, 32 };
const Circle LugBoss{ { 38.5, 0 }, 5.2, 28 };
const Circle LugHole{ { 38.5, 0 }, 3, 20 };
const std::array<Circle, 3> Holes{ Circle{ corner(24, 67.5), 4.5, 24 }, Circle{ corner(24, 112.5), 4.5, 24 },
  Circle{ corner(24, 247.5), 4.5, 24 } };
constexpr double LugRoot = 30.0; // x; the lug's sides start inside the rim, which has a gap as wide as the lug
constexpr double RibStart = 10.5;
constexpr double RibEnd = 33.5;
constexpr double HalfRib = 1.5;
constexpr int RibPlaces = 8; // rib 0, towards the lug, is missing

Column columnAt(const Vector& point)
{
  const bool lugStrip = point.x() > LugRoot && std::abs(point.y()) < Lug.radius;
  const bool lug = Lug.contains(point) || (lugStrip && point.x() < Lug.centre.x());
  const bool plate = Flange.contains(point) || lug;
  bool hole = Bore.contains(point) || LugHole.contains(point);
  for (const Circle& circle : Holes)
  {
    hole = hole || circle.contains(point);
  }
  Column solid{};
  if (!plate || hole)
  {
    return solid;
  }
  const bool hub = Hub.contains(point);
  const bool rim = Flange.contains(point) && !RimInside.contains(point) && !lugStrip;
  bool rib = false;
  for (int i = 1; i < RibPlaces; ++i)
  {
    const Vector along = corner(1.0, 360.0 * i / RibPlaces);
    const double across = along.x() * point.y() - along.y() * point.x();
    rib = rib || (std::abs(across) < HalfRib && along.dot(point) > RibStart && along.dot(point) < RibEnd);
  }
  solid[SpigotLayer] = SpigotOutside.contains(point) && !SpigotInside.contains(point);
  solid[FlangeLayer] = true;
  solid[RibLayer] = hub || rim || rib || LugBoss.contains(point);
  solid[RimLayer] = hub || rim;
  solid[HubLayer] = hub;
  return solid;
}

std::vector<Polyline> drawOutlines()
{
  std::vector<Polyline> lines;
  const auto line = [&](const Vector& a, const Vector& b) { lines.push_back({ a, b }); };
  const auto outline = [&](const Circle& circle)
  {
    for (int i = 0; i < circle.corners; ++i)
    {
      line(circle.corner(i), circle.corner((i + 1) % circle.corners));
    }
  };
  for (const Circle& circle : { Hub, Bore, SpigotOutside, SpigotInside, LugBoss, LugHole })
  {
    outline(circle);
  }
  // Of the rim, what is not within the lug.
  for (const Circle& circle : { Flange, RimInside })
  {
    for (int i = 2; i < circle.corners - 2; ++i)
    {
      line(circle.corner(i), circle.corner(i + 1));
    }
  }
  for (const Circle& circle : Holes)
  {
    outline(circle);
  }
  // Of the lug, the outer half and the sides.
  for (int i = 0; i < Lug.corners / 2; ++i)
  {
    line(Lug.corner(i - Lug.corners / 4), Lug.corner(i + 1 - Lug.corners / 4));
  }
  for (const double y : { -Lug.radius, Lug.radius })
  {
    line({ LugRoot, y }, { Lug.centre.x(), y });
  }
  for (int i = 1; i < RibPlaces; ++i)
  {
    const Vector along = corner(1.0, 360.0 * i / RibPlaces);
    const Vector across(-along.y() * HalfRib, along.x() * HalfRib);
    line(RibStart * along + across, RibEnd * along + across);
    line(RibStart * along - across, RibEnd * along - across);
  }
  return lines;
}
}

TriangleMesh makeSamplePart()
{
  return columnMesh(Levels, drawOutlines(), [](const Vector& point, int layer) { return columnAt(point)[layer]; });
}
}
