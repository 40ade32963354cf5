// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/PointCloud.h"
#include "calibration/ModelCalibration.h"
#include "features/PairTable.h"
#include "features/Preset.h"
#include "mesh/Symmetries.h"
#include "model/DistanceField.h"
#include "model/PredictedVisibility.h"

#include <memory>

namespace meam
{
class BodyInterior;
class MirrorImage;
class SideSymmetries;
class SurroundingPatches;
struct DerivedFields;

/// How the edge appearance models come into one table.
enum class ViewMerging
{
  Points,     ///< one edge point for all views that show it
  VoxelCodes, ///< one for each view; a pair that several views show is stored once, by voxel code (Equation (2))
  None        ///< one for each view, and all pairs of each view: as many tables as views, one after the other
};

/// Pairs of surface points; lengths are shares of d_max.
struct SurfacePairSettings
{
  double distanceStep = 0.05; ///< d_dist
  double angleStep = 12.0;    ///< d_angle, degrees; also the step of the votes' turn about the normal
  double leafSize = 0.05;     ///< of the points in a cube of this side one makes pairs, in the model as in a scene
};

// Shares of the diameter: so far along its tangent an edge point stands for the edge, and along its plane a surface
// point for the surface, a little over the spacing of these points.
constexpr double EdgePointSpacing = 0.03;
constexpr double SurfacePointSpacing = 0.018;
constexpr double FieldReach = 0.03;  // of the distance fields, and of what is deep: tolerances are less
constexpr double FieldCell = 0.0075; // side of their cells; distances are up to half of it off

struct MEAMHashingSettings
{
  Features features = Features::Both;
  SurfacePairSettings surface{};
  PairFeatureKind feature = PairFeatureKind::Oriented; ///< of edge points
  double distanceStep = 0.07;                          ///< tau_d: d_dist as a share of d_max
  double angleStep = 7.2; ///< d_angle, degrees; also the step of the votes' turn about the tangent
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

/// Of surface samples of a part one for each cube of side `leafSize` (mm): of a part that is flat, no thicker than
/// 7.5 % of its diameter along an axis of the CAD file, one of each face. Both are seen; of the walls of hollow parts
/// the outer face is.
std::vector<int> thinSamples(const PointCloud& surface, double leafSize, double diameter);

/// All that detection needs to know of a part: the result of the offline phase.
struct TrainedModel
{
  static constexpr int FormatVersion = 4;            ///< a mark
  static constexpr int MaximumViews = 32;            ///< views and directions are bits of a word
  static constexpr std::int64_t MostKeys = 50000000; ///< 200 MB of offsets
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

  PairTable table; ///< of edge points; empty when surface points alone make pairs

  PointCloud surfacePairPoints; ///< those that make pairs, with normals
  PairTable surfaceTable;       ///< of these

  ModelCalibration calibration; ///< what a user's own scans have taught

  // What deriveFields() makes of the above.
  float thickness = 0.0f;              ///< mm, the least of its sizes along the axes of the CAD file,
  float width = 0.0f;                  ///< and the next larger one
  std::vector<int> verificationPoints; ///< indices of the surface points that poses are verified on
  DistanceField surfaceDistance;       ///< up to 3 % of the diameter
  DistanceField edgeDistance;
  std::shared_ptr<const PredictedVisibility> visibility;  ///< what should be seen of the part from where
  std::shared_ptr<const BodyInterior> interior;           ///< what lies deep in the part
  std::shared_ptr<const MirrorImage> mirrorImage;         ///< the part as a mirror shows it
  std::shared_ptr<const SideSymmetries> sides;            ///< what looks the same of it from some direction
  std::shared_ptr<const SurroundingPatches> surroundings; ///< patches of its surface and beside it

  /// Makes what voting and verification look up: to be called when all else is there.
  void deriveFields();
  /// The same with what is known of it from a file.
  void deriveFields(DerivedFields known);

  /// The quantizer of the table's keys, and of the surface table's.
  PairFeatureQuantizer quantizer() const;
  PairFeatureQuantizer surfaceQuantizer() const;
  /// The edge appearance model of a view.
  PointCloud edgesOfView(int view) const;
  /// Its thickness in diameters; 1 of a rod, which is thin along two of the CAD file's axes. Of what lies askew in its
  /// CAD file it is too much.
  double sheetThickness() const;
  /// Side of the cubes of which one edge point makes pairs, mm; 0: all do.
  double votingLeaf() const;
  /// Of the part's surface for which one verification point stands, mm^2, on average.
  double verificationArea() const;

private:
  /// All but the distance fields, the mirror image, the sides and the patches.
  void deriveOthers(std::vector<std::uint8_t> interiorCells);
};
}
