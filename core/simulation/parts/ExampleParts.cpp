// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/parts/ExampleParts.h"

#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshPreparation.h"
#include "simulation/parts/ColumnMesh.h"
#include "simulation/parts/CurvedParts.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
using Vector = Eigen::Vector2d;
using Features = std::vector<Feature>;

constexpr auto Solid = Feature::Solid;
constexpr auto Empty = Feature::Empty;

Vector polar(double radius, double degrees)
{
  return radius * Vector(std::cos(degrees * M_PI / 180.0), std::sin(degrees * M_PI / 180.0));
}

/// An arc around `centre` from one angle to another one, in steps of at most `step` degrees.
Polyline arc(const Vector& centre, double radius, double from, double to, double step)
{
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / step - 1e-9)));
  Polyline line;
  for (int i = 0; i <= steps; ++i)
  {
    line.push_back(centre + polar(radius, from + (to - from) * i / steps));
  }
  return line;
}

Polyline circle(const Vector& centre, double radius, double step = 12.0)
{
  Polyline line = arc(centre, radius, 0.0, 360.0, step);
  line.pop_back();
  return line;
}

/// The part of a ring between two angles (degrees).
Polyline sector(double inside, double outside, double from, double to)
{
  Polyline line = arc({ 0, 0 }, outside, from, to, 6.0);
  const Polyline back = arc({ 0, 0 }, inside, to, from, 6.0);
  line.insert(line.end(), back.begin(), back.end());
  return line;
}

/// A rectangle around the line between two points.
Polyline bar(const Vector& from, const Vector& to, double width)
{
  const Vector along = (to - from).normalized();
  const Vector across = 0.5 * width * Vector(-along.y(), along.x());
  return { from - across, to - across, to + across, from + across };
}

/// A bar along a ray from the origin.
Polyline spoke(double from, double to, double degrees, double width)
{
  return bar(polar(from, degrees), polar(to, degrees), width);
}

/// A rectangle with round corners.
Polyline plate(const Vector& low, const Vector& high, double radius)
{
  Polyline line;
  for (int i = 0; i < 4; ++i)
  {
    const Vector corner(
      i == 0 || i == 3 ? high.x() - radius : low.x() + radius, i < 2 ? high.y() - radius : low.y() + radius);
    const Polyline round = arc(corner, radius, 90.0 * i, 90.0 * (i + 1), 15.0);
    line.insert(line.end(), round.begin(), round.end());
  }
  return line;
}

Features ridgedDisc()
{
  Features features{ { Solid, circle({ 0, 0 }, 46, 6), 3, 6 } };
  // Above: five spokes at uneven angles, a rim with a gap, a part of a ring.
  features.push_back({ Solid, sector(42, 44, 12, 338), 6, 10 });
  features.push_back({ Solid, sector(26, 28, -5, 243), 6, 10 });
  for (const double angle : { 21.0, 81.0, 141.0, 201.0, 261.0 })
  {
    features.push_back({ Solid, spoke(9, 43, angle, 2), 6, 10 });
  }
  // Below: six even spokes and a whole rim.
  features.push_back({ Solid, circle({ 0, 0 }, 44, 6), 0, 3 });
  features.push_back({ Empty, circle({ 0, 0 }, 42, 6), 0, 3 });
  for (int i = 0; i < 6; ++i)
  {
    features.push_back({ Solid, spoke(9, 43, 60.0 * i, 2), 0, 3 });
  }
  features.push_back({ Solid, circle({ 0, 0 }, 11, 10), 0, 14 });
  features.push_back({ Empty, circle({ 0, 0 }, 6.5), 0, 14 });
  features.push_back({ Empty, bar({ 0, 5 }, { 0, 9 }, 4), 0, 14 });
  features.push_back({ Empty, circle(polar(35, 50), 3.5, 15), 0, 10 });
  features.push_back({ Empty, circle(polar(35, 170), 3.5, 15), 0, 10 });
  return features;
}

Features arcLever()
{
  Features features{ { Solid, sector(38, 54, -100, 100), 3, 7 } };
  // The eyes at the ends, and one outside.
  const Vector first = polar(46, 100);
  const Vector second = polar(46, -100);
  const Vector third = polar(60, 16);
  features.push_back({ Solid, circle(first, 11, 10), 3, 7 });
  features.push_back({ Solid, circle(second, 11, 10), 3, 7 });
  features.push_back({ Solid, circle(third, 8), 3, 7 });
  // Ridges above and below.
  features.push_back({ Solid, sector(39.2, 41.2, -80, 78), 7, 11 });
  features.push_back({ Solid, sector(50.8, 52.8, -80, 78), 7, 11 });
  features.push_back({ Solid, sector(39.2, 41.2, -80, 62), 0, 3 });
  features.push_back({ Solid, sector(50.8, 52.8, -62, 78), 0, 3 });
  for (const double angle : { -79.0, -43.0, 2.0, 53.0, 77.0 })
  {
    features.push_back({ Solid, spoke(40.2, 51.8, angle, 2), 7, 11 });
  }
  for (const double angle : { -43.0, 2.0, 43.0 })
  {
    features.push_back({ Solid, spoke(40.2, 51.8, angle, 2), 0, 3 });
  }
  features.push_back({ Solid, circle(first, 7.5), 7, 12 });
  features.push_back({ Solid, circle(second, 7.5), 7, 9 });
  features.push_back({ Empty, circle(first, 4, 15), 0, 12 });
  features.push_back({ Empty, circle(second, 5, 15), 0, 12 });
  features.push_back({ Empty, circle(third, 3.5, 15), 0, 12 });
  return features;
}

Features flap()
{
  Features features{ { Solid, plate({ -70, -26 }, { 70, 28 }, 6), 3, 5.5 } };
  // Ribs across and along, above and below.
  for (const double x : { -51.0, -19.0, 13.0, 45.0 })
  {
    features.push_back({ Solid, bar({ x, -24 }, { x, 24 }, 2), 5.5, 9 });
  }
  for (const double x : { -45.0, -15.0, 15.0, 45.0 })
  {
    features.push_back({ Solid, bar({ x, -24 }, { x, 24 }, 2), 0, 3 });
  }
  features.push_back({ Solid, bar({ -64, 22 }, { 64, 22 }, 2), 5.5, 9 });
  features.push_back({ Solid, bar({ -64, 22 }, { 47, 22 }, 2), 0, 3 });
  // The shaft, with a thicker end and a flat one.
  features.push_back({ Solid, bar({ -76, -22 }, { 76, -22 }, 7), 0, 9 });
  features.push_back({ Solid, plate({ 71, -28 }, { 75, -8 }, 1), 0, 9 });
  features.push_back({ Empty, bar({ -77, -22 }, { -71.5, -22 }, 8), 6, 9 });
  // A window and a corner that is missing.
  features.push_back({ Empty, plate({ 20, -6 }, { 38, 6 }, 2), 3, 5.5 });
  features.push_back({ Empty, bar({ 58, 34 }, { 76, 16 }, 8), 0, 9 });
  return features;
}

Features holePlate()
{
  Features features{ { Solid, plate({ -37, -24 }, { 37, 24 }, 5), 2.5, 6.5 } };
  // A collar on both sides.
  for (const auto& [bottom, top] : { std::pair(0.0, 2.5), std::pair(6.5, 9.0) })
  {
    features.push_back({ Solid, circle({ 0, 0 }, 14, 9), bottom, top });
    features.push_back({ Empty, circle({ 0, 0 }, 11.8, 9), bottom, top });
  }
  features.push_back({ Empty, circle({ 0, 0 }, 8.5), 2.5, 6.5 });
  // One of the four holes is larger, one of the slots shorter, a small hole is near a corner.
  features.push_back({ Empty, circle({ 28, 15 }, 4, 15), 2.5, 6.5 });
  features.push_back({ Empty, circle({ -28, 15 }, 4, 15), 2.5, 6.5 });
  features.push_back({ Empty, circle({ 28, -15 }, 4, 15), 2.5, 6.5 });
  features.push_back({ Empty, circle({ -28, -15 }, 5.2, 15), 2.5, 6.5 });
  features.push_back({ Empty, plate({ 19, -5 }, { 33, 2 }, 3), 2.5, 6.5 });
  features.push_back({ Empty, plate({ -33, -2 }, { -22, 5 }, 3), 2.5, 6.5 });
  features.push_back({ Empty, circle({ 12, -19 }, 2, 20), 2.5, 6.5 });
  return features;
}
}

TriangleMesh makeExamplePart(ExamplePart part)
{
  const auto withFeatures = [](const Features& features)
  {
    // The outlines of one layer cut the faces of the others: without these cuts.
    MeshPreparationSettings settings;
    settings.maximumError = 0.01;
    return prepareMesh(featureMesh(features), settings).mesh;
  };
  switch (part)
  {
    case ExamplePart::RidgedDisc:
      return withFeatures(ridgedDisc());
    case ExamplePart::ArcLever:
      return withFeatures(arcLever());
    case ExamplePart::Flap:
      return withFeatures(flap());
    case ExamplePart::HolePlate:
      return withFeatures(holePlate());
    case ExamplePart::PipeElbow:
      return pipeElbow();
    case ExamplePart::Cap:
      return cap();
    case ExamplePart::Knob:
      return knob();
    default:
      return handle();
  }
}
}
