// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// The first four are of the kinds that the paper was tested with, made of resin for car air-conditioning: thin ridges,
/// arcs, tops and bottoms that look alike. The others are round all over: their outlines move with the view.
enum class ExamplePart
{
  RidgedDisc, ///< 92 mm across: a round plate whose turn only ridges of 2 mm and two holes tell
  ArcLever,   ///< 113 mm: a flat arc with an eye at each end, ridges on both sides
  Flap,       ///< 154 mm: a large thin plate on a shaft, with nearly the same ribs above and below
  HolePlate,  ///< 85 mm: a flat plate with holes, near to half a turn's symmetry and to that of its two sides
  PipeElbow,  ///< 108 mm: a hollow bend of 90 degrees with a socket at each end, one of them 6 mm longer
  Cap,        ///< 70 mm: a shallow cap with ten flutes; a tab at its rim alone tells its turn
  Knob,       ///< 50 mm: waisted, with a round head; a flat on it alone tells its turn
  Handle      ///< 117 mm: a bowed tube on two round feet, one of them larger
};
constexpr int ExampleParts = 8;

/// A closed mesh in mm that faces outwards.
TriangleMesh makeExamplePart(ExamplePart part);
}
