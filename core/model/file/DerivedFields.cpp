// SPDX-License-Identifier: BSD-3-Clause
#include "model/file/DerivedFields.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "io/parsing/NamedArrays.h"
#include "model/body/BodyInterior.h"
#include "model/body/SurroundingPatches.h"
#include "model/TrainedModel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace meam
{
namespace
{
// Of what is derived, not of the file: one more whenever any of it is made in another way. Files that hold another
// version are read as if they held none.
constexpr std::int32_t Version = 1;

constexpr float UnitLength = 1e-3f; // rounding of a direction's length, off 1
constexpr std::size_t Plane = 2;    // vectors: a point on it and its normal
constexpr std::size_t Matrix = 16;  // numbers, row-major

[[noreturn]] void refuse(const char* what) { throw Error("is damaged: its " + std::string(what)); }

void setField(NamedArrays& arrays, const std::string& name, const DistanceField& field)
{
  const DistanceField::Stored stored = field.stored();
  arrays.set(name + "Frame", stored.frame);
  arrays.set(name + "Size", stored.size);
  arrays.set(name + "Cells", stored.distances);
}

DistanceField fieldOf(const NamedArrays& arrays, const std::string& name)
{
  std::optional<DistanceField> field = DistanceField::of({ arrays.get<float>(name + "Frame"),
    arrays.get<std::int32_t>(name + "Size"), arrays.get<std::uint8_t>(name + "Cells") });
  if (!field)
  {
    refuse("distance field has another size than its cells");
  }
  return *std::move(field);
}

std::vector<Eigen::Isometry3d> motionsOf(const NamedArrays& arrays, const std::string& name)
{
  const std::vector<double> numbers = arrays.get<double>(name);
  if (numbers.size() % Matrix != 0)
  {
    refuse("turns end within one");
  }
  std::vector<Eigen::Isometry3d> motions;
  for (std::size_t at = 0; at < numbers.size(); at += Matrix)
  {
    motions.push_back(transformOf(numbers.data() + at));
    if (!isRigid(motions.back().matrix()))
    {
      refuse("turns are not rigid motions");
    }
  }
  return motions;
}

void requireUnit(const Eigen::Vector3f& direction)
{
  if (!(std::abs(direction.norm() - 1.0f) < UnitLength))
  {
    refuse("directions are not unit vectors");
  }
}

void setMirroring(NamedArrays& arrays, const Mirroring& mirroring)
{
  std::vector<double> turns;
  for (const Eigen::Isometry3d& turn : mirroring.turns)
  {
    appendNumbersOf(turn, turns);
  }
  arrays.set("MirrorPlane", Points{ mirroring.at, mirroring.normal });
  arrays.set("MirrorTurns", turns);
}

Mirroring mirroringOf(const NamedArrays& arrays)
{
  const Points plane = arrays.points("MirrorPlane");
  if (plane.size() != Plane || !plane[0].allFinite())
  {
    refuse("mirror plane is none");
  }
  requireUnit(plane[1]);
  return { plane[0], plane[1], motionsOf(arrays, "MirrorTurns") };
}

void setSides(NamedArrays& arrays, const std::vector<SideSymmetry>& sides)
{
  Points directions;
  std::vector<std::int32_t> counts;
  std::vector<double> turns;
  for (const SideSymmetry& side : sides)
  {
    directions.push_back(side.towards);
    counts.push_back(static_cast<std::int32_t>(side.turns.size()));
    for (const Eigen::Isometry3d& turn : side.turns)
    {
      appendNumbersOf(turn, turns);
    }
  }
  arrays.set("SideDirections", directions);
  arrays.set("SideTurnCounts", counts);
  arrays.set("SideTurns", turns);
}

std::vector<SideSymmetry> sidesOf(const NamedArrays& arrays)
{
  const Points directions = arrays.points("SideDirections");
  const std::vector<std::int32_t> counts = arrays.get<std::int32_t>("SideTurnCounts");
  const std::vector<Eigen::Isometry3d> turns = motionsOf(arrays, "SideTurns");
  std::vector<SideSymmetry> sides;
  auto begin = turns.begin();
  for (std::size_t k = 0; k < std::min(directions.size(), counts.size()); ++k)
  {
    requireUnit(directions[k]);
    if (counts[k] < 0 || counts[k] > turns.end() - begin)
    {
      refuse("sides have other numbers of turns");
    }
    sides.push_back({ directions[k], { begin, begin + counts[k] } });
    begin += counts[k];
  }
  if (directions.size() != counts.size() || begin != turns.end())
  {
    refuse("sides are not as many as their turns say");
  }
  return sides;
}
}

void setDerived(NamedArrays& arrays, const TrainedModel& model)
{
  arrays.set("DerivedVersion", std::vector<std::int32_t>{ Version });
  setField(arrays, "SurfaceField", model.surfaceDistance);
  setField(arrays, "EdgeField", model.edgeDistance);
  arrays.set("InteriorCells", model.interior->cells());
  setMirroring(arrays, model.mirrorImage->mirroring(model));
  setSides(arrays, model.sides->of(model));
  arrays.set("StepsBeside", model.surroundings->steps(model));
}

std::optional<DerivedFields> derivedOf(const NamedArrays& arrays)
{
  if (arrays.get<std::int32_t>("DerivedVersion") != std::vector<std::int32_t>{ Version })
  {
    return std::nullopt;
  }
  return DerivedFields{ fieldOf(arrays, "SurfaceField"), fieldOf(arrays, "EdgeField"),
    arrays.get<std::uint8_t>("InteriorCells"), mirroringOf(arrays), sidesOf(arrays),
    arrays.get<std::uint8_t>("StepsBeside") };
}
}
