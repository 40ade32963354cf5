// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
/// Which method: the parameters that every step starts from.
enum class Preset
{
  Paper,       ///< PPF-MEAM as Liu et al. have it (Sensors 2018, Section 6)
  Recommended, ///< what measures better
  WithoutMEAM, ///< the paper's B2B-TL with one model of the whole part (Section 6.2.4)
  OriginalPPF, ///< pairs of surface points with normals (Drost et al., CVPR 2010, the paper's [12])
  B2B          ///< pairs of points on line segments (Choi et al., ICRA 2012, the paper's [23])
};
constexpr int Presets = 5; // their number
constexpr const char* nameOf(Preset preset)
{
  constexpr const char* names[Presets] = { "Paper", "Recommended", "WithoutMEAM", "OriginalPPF", "B2B" };
  return names[static_cast<int>(preset)];
}
/// Whether a preset leaves the choice of the features to the user; the others have their own.
constexpr bool takesFeatures(Preset preset) { return preset == Preset::Recommended; }

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
