// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
/// Which set of parameters every step starts from.
enum class Preset
{
  Paper,      ///< Liu et al., Sensors 2018, Section 6
  Recommended ///< what measures better
};

/// Which points of a part make pairs.
enum class Features
{
  Edges,   ///< edge points with tangents (B2B-TL): flat, thin and ribbed parts
  Surface, ///< surface points with normals (Drost et al., the paper's [12]): smooth, round and thick parts
  Both
};
constexpr const char* nameOf(Features features)
{
  return features == Features::Edges ? "Edges" : features == Features::Surface ? "Surface" : "Both";
}
constexpr bool hasEdges(Features features) { return features != Features::Surface; }
constexpr bool hasSurface(Features features) { return features != Features::Edges; }
}
