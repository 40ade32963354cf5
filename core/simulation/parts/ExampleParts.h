// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// Parts of the kinds that the paper was tested with, made of resin for car air-conditioning: thin ridges, arcs,
/// tops and bottoms that look alike.
enum class ExamplePart
{
  RidgedDisc, ///< 92 mm across: a round plate whose turn only ridges of 2 mm and two holes tell
  ArcLever,   ///< 113 mm: a flat arc with an eye at each end, ridges on both sides
  Flap,       ///< 154 mm: a large thin plate on a shaft, with nearly the same ribs above and below
  HolePlate   ///< 85 mm: a flat plate with holes, near to half a turn's symmetry and to that of its two sides
};
constexpr int ExampleParts = 4;

/// A closed mesh in mm that faces outwards.
TriangleMesh makeExamplePart(ExamplePart part);
}
