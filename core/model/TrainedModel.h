// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry.h"
#include "model/PairFeature.h"

namespace meam
{
struct MEAMHashingSettings
{
  PairFeatureKind feature = PairFeatureKind::Oriented;
  double distanceStep = 0.07; ///< tau_d: d_dist as a share of d_max
  double angleStep = 7.2;     ///< d_angle, degrees; also the step of the votes' turn about the tangent
  /// One edge point for all views that show it, or one for each view with pairs told apart by voxel
  /// code (paper, Equation (2)).
  bool mergeViews = true;
  double voxelSize = 0.0;     ///< L_voxel in mm; 0: 1.5 % of the diameter
  /// Directions from which two points must be visible together to make a pair; 0: only the views
  /// themselves (paper).
  int coVisibilityDirections = 26;
};

/// The paper's settings (Section 6) in place of the recommended ones.
MEAMHashingSettings paperHashingSettings();

/// All pairs of edge points, sorted by the key of their feature. Bucket k is the entries
/// [offsets[k], offsets[k + 1]).
struct PairTable
{
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> references; ///< index of the reference edge point
  std::vector<std::uint32_t> referreds;  ///< index of the referred edge point
  std::vector<float> angles;             ///< of the referred point about the reference's tangent, radians
  std::vector<std::uint32_t> viewBits;   ///< bit v: both points are on the edge seen in view v

  std::size_t size() const { return this->references.size(); }
};

/// All that detection needs to know of a part: the result of the offline phase.
struct TrainedModel
{
  static constexpr int FormatVersion = 1;
  static constexpr int MaximumViews = 32; ///< views and directions are bits of a word
  static constexpr std::int64_t MostKeys = 50000000;

  double diameter = 0.0; ///< d_max, mm
  std::string digest;    ///< of the surface, the edges and the settings
  MEAMHashingSettings settings;

  Points viewDirections;                  ///< unit, from the part to each viewpoint
  PointCloud edges;                       ///< edge points with tangents
  std::vector<std::uint32_t> edgeViews;   ///< bit v: on the edge seen in view v
  std::vector<std::uint32_t> edgeVisible; ///< bit c: visible from co-visibility direction c

  PointCloud surface; ///< thinned surface samples with normals

  PairTable table;

  /// The quantizer of the table's keys.
  PairFeatureQuantizer quantizer() const;
};
}
