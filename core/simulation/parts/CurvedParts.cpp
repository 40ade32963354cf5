// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/parts/CurvedParts.h"

#include "base/sequences/Sequences.h"
#include "simulation/parts/RingMesh.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;
/// Where on a path or an axis a ring is, and its radius; mm.
using Station = Vector2d;
using Stations = std::vector<Station>;

constexpr double Degree = M_PI / 180.0;

/// A piece of a path in the xy plane: a straight one, or an arc to the left.
struct Piece
{
  double length;
  double degrees; ///< of the turn; 0: straight
};

/// A path from the origin along x.
class Path
{
public:
  explicit Path(std::vector<Piece> pieces)
    : Pieces(std::move(pieces))
  {
  }

  double length() const
  {
    return sumOf(this->Pieces, [](const Piece& piece) { return piece.length; });
  }

  /// A ring of `corners` points around the path.
  PrecisePoints ring(const Station& station, int corners) const
  {
    Vector2d place(0, 0);
    double direction = 0.0;
    double left = station.x();
    for (const Piece& piece : this->Pieces)
    {
      const double along = &piece == &this->Pieces.back() ? left : std::min(left, piece.length);
      const double turn = piece.degrees * Degree * along / piece.length;
      // The chord of an arc.
      const double chord = turn > 0.0 ? along * std::sin(0.5 * turn) / (0.5 * turn) : along;
      place += chord * Vector2d(std::cos(direction + 0.5 * turn), std::sin(direction + 0.5 * turn));
      direction += turn;
      left -= along;
    }
    const Vector3d middle(place.x(), place.y(), 0.0);
    const Vector3d across(-std::sin(direction), std::cos(direction), 0.0);
    PrecisePoints points;
    for (int i = 0; i < corners; ++i)
    {
      const double angle = 2.0 * M_PI * i / corners;
      points.push_back(middle + station.y() * (std::cos(angle) * across + std::sin(angle) * Vector3d::UnitZ()));
    }
    return points;
  }

private:
  std::vector<Piece> Pieces;
};

/// A curve from one station to another one in `steps`, without its first station.
template <typename Curve>
void append(Stations& stations, int steps, Curve&& curve)
{
  for (int i = 1; i <= steps; ++i)
  {
    stations.push_back(curve(static_cast<double>(i) / steps));
  }
}

/// From one radius to another one without an edge, as half a wave.
auto wave(const Station& from, const Station& to)
{
  return [from, to](double t)
  {
    return Station(
      from.x() + t * (to.x() - from.x()), from.y() + 0.5 * (1.0 - std::cos(M_PI * t)) * (to.y() - from.y()));
  };
}

/// A quarter of an ellipse from `from`, where it runs along the axis, to `to`, where it runs across; or the other way.
auto quarter(const Station& from, const Station& to, bool startsAlong)
{
  return [from, to, startsAlong](double t)
  {
    const double sine = std::sin(0.5 * M_PI * t);
    const double rest = 1.0 - std::cos(0.5 * M_PI * t);
    return Station(from.x() + (startsAlong ? sine : rest) * (to.x() - from.x()),
      from.y() + (startsAlong ? rest : sine) * (to.y() - from.y()));
  };
}

PrecisePoints pole(double height) { return { Vector3d(0, 0, height) }; }
}

TriangleMesh pipeElbow()
{
  constexpr int Corners = 40;
  constexpr double Pipe = 14.0; // radii
  constexpr double Socket = 18.0;
  constexpr double Bore = 11.0;
  constexpr double Seat = 15.0;  // of the pipe that is put into a socket
  constexpr double First = 18.0; // lengths of the sockets
  constexpr double Second = 24.0;
  constexpr double SeatDepth = 14.0;
  constexpr double Bend = 30.0; // radius of the middle line
  const Path path({ { First + 8.0, 0.0 }, { 0.5 * M_PI * Bend, 90.0 }, { Second + 8.0, 0.0 } });
  const double start = First + 8.0;
  const double end = start + 0.5 * M_PI * Bend;
  const double whole = path.length();
  const auto bend = [&](double radius) { return [=](double t) { return Station(start + t * (end - start), radius); }; };

  Stations outside{ { 0.0, Socket - 0.8 }, { 0.8, Socket }, { First - 2.0, Socket }, { First, Pipe }, { start, Pipe } };
  append(outside, 14, bend(Pipe));
  outside.insert(outside.end(),
    { { whole - Second, Pipe }, { whole - Second + 2.0, Socket }, { whole - 0.8, Socket }, { whole, Socket - 0.8 } });
  Stations inside{ { 0.0, Seat }, { SeatDepth, Seat }, { SeatDepth, Bore }, { start, Bore } };
  append(inside, 12, bend(Bore));
  inside.insert(inside.end(), { { whole - SeatDepth, Bore }, { whole - SeatDepth, Seat }, { whole, Seat } });
  auto rings = mapped<PrecisePoints>(outside, [&](const Station& station) { return path.ring(station, Corners); });
  for (auto station = inside.rbegin(); station != inside.rend(); ++station)
  {
    rings.push_back(path.ring(*station, Corners));
  }
  return ringMesh(rings, true);
}

TriangleMesh cap()
{
  constexpr int Corners = 120;
  constexpr int Flutes = 10;
  constexpr double FluteDepth = 1.2;
  constexpr double Tab = 6.0;      // over the wall
  constexpr double HalfTab = 26.0; // degrees
  constexpr double TabHeight = 4.0;
  const auto ring = [&](const Station& station, double flutes, double tab)
  {
    PrecisePoints points;
    for (int i = 0; i < Corners; ++i)
    {
      const double degrees = 360.0 * i / Corners;
      const double fromTab = std::min(degrees, 360.0 - degrees);
      const double bump = fromTab < HalfTab ? std::pow(std::cos(0.5 * M_PI * fromTab / HalfTab), 2) : 0.0;
      const double radius =
        station.y() - 0.5 * flutes * FluteDepth * (1.0 - std::cos(Flutes * degrees * Degree)) + tab * Tab * bump;
      points.emplace_back(radius * std::cos(degrees * Degree), radius * std::sin(degrees * Degree), station.x());
    }
    return points;
  };
  // From the middle of the ceiling down the inside, up the outside and over the crown.
  Stations stations{ { 17.0, 24.5 } };
  append(stations, 4, quarter({ 17.0, 24.5 }, { 14.0, 27.5 }, false));
  stations.emplace_back(0.0, 27.5);
  std::vector<PrecisePoints> rings{ pole(17.0) };
  for (const Station& station : stations)
  {
    rings.push_back(ring(station, 0.0, 0.0));
  }
  rings.push_back(ring({ 0.0, 31.0 }, 1.0, 1.0));
  rings.push_back(ring({ TabHeight, 31.0 }, 1.0, 1.0));
  rings.push_back(ring({ TabHeight + 1.5, 31.0 }, 1.0, 0.0));
  rings.push_back(ring({ 14.0, 31.0 }, 1.0, 0.0));
  stations.clear();
  append(stations, 5, quarter({ 14.0, 31.0 }, { 20.0, 25.0 }, true));
  for (const Station& station : stations)
  {
    rings.push_back(ring(station, (station.y() - 25.0) / 6.0, 0.0)); // the flutes run out
  }
  rings.push_back(ring({ 21.13, 12.5 }, 0.0, 0.0));
  rings.push_back(pole(21.5));
  return ringMesh(rings, false);
}

TriangleMesh knob()
{
  constexpr double Flat = 17.0;       // mm from the axis
  constexpr double LeastAngle = 12.0; // degrees; of the corners that lie on the flat where there is one
  constexpr int OnFlat = 4;           // pieces of a ring
  constexpr int Around = 40;
  // Corners are where the flat begins and ends, so that its outline is made of edges.
  const auto ring = [&](const Station& station)
  {
    const double half = std::max(LeastAngle, station.y() > Flat ? std::acos(Flat / station.y()) / Degree : 0.0);
    PrecisePoints points;
    for (int i = 0; i < OnFlat + Around; ++i)
    {
      const double degrees =
        i < OnFlat ? half * (2.0 * i / OnFlat - 1.0) : half + (360.0 - 2.0 * half) * (i - OnFlat) / Around;
      const double cosine = std::cos(degrees * Degree);
      const double radius = cosine > 0.0 ? std::min(station.y(), Flat / cosine) : station.y();
      points.emplace_back(radius * cosine, radius * std::sin(degrees * Degree), station.x());
    }
    return points;
  };
  // From the end of the bore down to the base, up the waist and over the head.
  Stations stations{ { 16.0, 4.0 }, { 0.0, 4.0 }, { 0.0, 16.0 }, { 3.0, 16.0 } };
  append(stations, 8, wave({ 3.0, 16.0 }, { 14.0, 10.0 }));
  append(stations, 10, wave({ 14.0, 10.0 }, { 28.0, 23.0 }));
  append(stations, 11, quarter({ 28.0, 23.0 }, { 41.0, 0.0 }, true));
  stations.pop_back();
  std::vector<PrecisePoints> rings{ pole(16.0) };
  for (const Station& station : stations)
  {
    rings.push_back(ring(station));
  }
  rings.push_back(pole(41.0));
  return ringMesh(rings, false);
}

TriangleMesh handle()
{
  constexpr int Corners = 32;
  constexpr double Leg = 14.0;
  constexpr double Tight = 24.0 * 80.0 * Degree; // lengths of the arcs
  constexpr double Wide = 150.0 * 20.0 * Degree;
  constexpr double Tube = 7.0; // radii
  constexpr double Grip = 8.5;
  constexpr double FirstFoot = 14.0;
  constexpr double SecondFoot = 11.0;
  constexpr double FootHeight = 3.0;
  const Path path({ { Leg, 0.0 }, { Tight, 80.0 }, { Wide, 20.0 }, { Tight, 80.0 }, { Leg, 0.0 } });
  const double whole = path.length();
  // A tube that is thicker in the middle, with a round foot at both ends.
  const auto tube = [&](double from, double to)
  {
    return [=](double t)
    {
      const double along = from + t * (to - from);
      return Station(along, Tube + (Grip - Tube) * std::pow(std::sin(M_PI * (along - Leg) / (whole - 2 * Leg)), 2));
    };
  };
  Stations stations{ { 0.0, FirstFoot }, { FootHeight, FirstFoot } };
  append(stations, 9, wave({ FootHeight, FirstFoot }, { Leg, Tube }));
  append(stations, 10, tube(Leg, Leg + Tight));
  append(stations, 6, tube(Leg + Tight, Leg + Tight + Wide));
  append(stations, 10, tube(Leg + Tight + Wide, whole - Leg));
  append(stations, 9, wave({ whole - Leg, Tube }, { whole - FootHeight, SecondFoot }));
  stations.emplace_back(whole, SecondFoot);
  std::vector<PrecisePoints> rings{ path.ring({ 0.0, 0.0 }, 1) };
  for (const Station& station : stations)
  {
    rings.push_back(path.ring(station, Corners));
  }
  rings.push_back(path.ring({ whole, 0.0 }, 1));
  return ringMesh(rings, false);
}
}
