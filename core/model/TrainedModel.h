// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/PointCloud.h"
#include "features/PairKeys.h"
#include "mesh/Symmetries.h"
#include "model/DistanceField.h"
#include "model/PredictedVisibility.h"

#include <memory>

namespace meam
{
/// How the edge appearance models come into one table.
enum class ViewMerging
{
  Points,     ///< one edge point for all views that show it
  VoxelCodes, ///< one for each view; a pair that several views show is stored once, by voxel code (Equation (2))
  None        ///< one for each view, and all pairs of each view: as many tables as views, one after the other
};

struct MEAMHashingSettings
{
  PairFeatureKind feature = PairFeatureKind::Oriented;
  double distanceStep = 0.07; ///< tau_d: d_dist as a share of d_max
  double angleStep = 7.2;     ///< d_angle, degrees; also the step of the votes' turn about the tangent
  ViewMerging merging = ViewMerging::Points;
  double voxelSize = 0.0; ///< L_voxel in mm; 0: 1.5 % of the diameter
  /// ViewMerging::Points: of the edge points in a cube of this side (mm) one makes pairs, in the model as in a scene;
  /// the others are there to judge and refine poses; 0: 4 % of the diameter. Otherwise all make pairs.
  double leafSize = 0.0;
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

  // As voting reads it, made by deriveFields():
  std::vector<std::uint32_t> votes; ///< voteEntry of each; VoteBlock zeros follow the last
  int mostOfOne = 1;                ///< entries of one reference point in a bucket

  std::size_t size() const { return this->references.size(); }
  std::size_t bytes() const { return (this->offsets.size() + 4 * this->size()) * sizeof(std::uint32_t); }
};

/// All that detection needs to know of a part: the result of the offline phase.
struct TrainedModel
{
  static constexpr int FormatVersion = 3;
  static constexpr int MaximumViews = 32; ///< views and directions are bits of a word
  static constexpr std::int64_t MostKeys = 50000000;
  static constexpr std::size_t MostEdges = std::size_t{ 1 }
                                           << (SheetBits - 1); ///< edge points; two sheets of votes each

  double diameter = 0.0; ///< d_max, mm
  std::string digest;    ///< of the surface, the edges and the settings
  MEAMHashingSettings settings;

  Points viewDirections;                  ///< unit, from the part to each viewpoint
  PointCloud edges;                       ///< edge points with tangents, those that make pairs before the others
  std::vector<std::uint32_t> edgeViews;   ///< bit v: on the edge seen in view v
  std::vector<std::uint32_t> edgeVisible; ///< bit c: visible from co-visibility direction c

  PointCloud surface; ///< thinned surface samples with normals
  Symmetries symmetries;

  PairTable table;

  // What deriveFields() makes of the above.
  int votingEdges = 0;                 ///< so many of the edge points make pairs
  std::vector<int> verificationPoints; ///< indices of the surface points that poses are verified on
  DistanceField surfaceDistance;       ///< up to TruncationDistance times the diameter
  DistanceField edgeDistance;
  std::shared_ptr<const PredictedVisibility> visibility; ///< what should be seen of the part from where
  static constexpr double TruncationDistance = 0.03;

  /// Makes what voting and verification look up and what files do not hold: to be called when all else is there.
  void deriveFields();

  /// The quantizer of the table's keys.
  PairFeatureQuantizer quantizer() const;
  /// The edge appearance model of a view.
  PointCloud edgesOfView(int view) const;
  /// Side of the cubes of which one edge point makes pairs, mm; 0: all do.
  double votingLeaf() const;
  /// Of the part's surface for which one verification point stands, mm^2, on average.
  double verificationArea() const;
};
}
