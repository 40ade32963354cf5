// SPDX-License-Identifier: BSD-3-Clause
#include "model/TrainedModel.h"

#include "base/Bounds.h"
#include "base/PointGrid.h"
#include "base/sequences/Sequences.h"
#include "model/body/BodyInterior.h"
#include "model/file/DerivedFields.h"
#include "model/MirrorImage.h"
#include "model/SideSymmetries.h"
#include "model/body/SurroundingPatches.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <utility>

namespace meam
{
namespace
{
// Shares of the diameter.
constexpr double VotingLeaf = 0.04; // of the edge points in a cube of this side one makes pairs, in model and scene
constexpr double VerificationLeaf = 0.03; // of the surface points in such a cube one verifies poses
constexpr float SheetWidth = 3.0f;        // thicknesses: what is narrower is a rod
constexpr double FlatThickness = 0.075;   // PoseEvidence tells such parts from what they lie on by their thickness

/// Along the axes of the CAD file, the least first.
Eigen::Vector3f sizesOf(const PointCloud& surface)
{
  Eigen::Vector3f sizes = Eigen::Vector3f::Zero();
  if (!surface.empty())
  {
    sizes = bounds(surface.points).sizes();
    std::sort(sizes.data(), sizes.data() + sizes.size());
  }
  return sizes;
}
}

std::vector<int> thinSamples(const PointCloud& surface, double leafSize, double diameter)
{
  return sizesOf(surface)[0] <= FlatThickness * diameter ? thinSurface(surface, leafSize)
                                                         : thinPoints(surface.points, leafSize);
}

double TrainedModel::sheetThickness() const
{
  return this->width >= SheetWidth * this->thickness ? this->thickness / this->diameter : 1.0;
}

double TrainedModel::votingLeaf() const
{
  if (this->settings.merging != ViewMerging::Points)
  {
    return 0.0;
  }
  return this->settings.leafSize > 0.0 ? this->settings.leafSize : VotingLeaf * this->diameter;
}

double TrainedModel::verificationArea() const
{
  constexpr double cubesOfSquare = 1.5; // that a plane of any direction meets, on average
  const double leaf = VerificationLeaf * this->diameter;
  return leaf * leaf / cubesOfSquare;
}

PointCloud TrainedModel::edgesOfView(int view) const
{
  const std::vector<int> members =
    indicesWhere(this->edges.size(), [&](int i) { return this->edgeViews[i] >> view & 1u; });
  return this->edges.subset(members);
}

PairFeatureQuantizer TrainedModel::quantizer() const
{
  return PairFeatureQuantizer(this->settings.feature, this->settings.distanceStep * this->diameter,
    this->settings.angleStep * M_PI / 180.0, this->diameter);
}

PairFeatureQuantizer TrainedModel::surfaceQuantizer() const
{
  return PairFeatureQuantizer(PairFeatureKind::Surface, this->settings.surface.distanceStep * this->diameter,
    this->settings.surface.angleStep * M_PI / 180.0, this->diameter);
}

void TrainedModel::deriveFields()
{
  const double reach = FieldReach * this->diameter;
  const double cell = FieldCell * this->diameter;
  // Threads of their own, not OpenMP's, which a forked process cannot start: models are loaded there, too.
  auto ofSurface = std::async(std::launch::async,
    [&] { return DistanceField::ofSurface(this->surface, SurfacePointSpacing * this->diameter, reach, cell); });
  auto ofEdges = std::async(std::launch::async,
    [&] { return DistanceField::ofEdges(this->edges, EdgePointSpacing * this->diameter, reach, cell); });
  this->deriveOthers({});
  this->surfaceDistance = ofSurface.get();
  this->edgeDistance = ofEdges.get();
  this->mirrorImage = std::make_shared<const MirrorImage>();
  this->sides = std::make_shared<const SideSymmetries>();
  this->surroundings = std::make_shared<const SurroundingPatches>();
}

void TrainedModel::deriveFields(DerivedFields known)
{
  this->deriveOthers(std::move(known.interior));
  this->surfaceDistance = std::move(known.surfaceDistance);
  this->edgeDistance = std::move(known.edgeDistance);
  this->mirrorImage = std::make_shared<const MirrorImage>(std::move(known.mirroring));
  this->sides = std::make_shared<const SideSymmetries>(std::move(known.sides));
  this->surroundings = std::make_shared<const SurroundingPatches>(std::move(known.stepsBeside));
}

void TrainedModel::deriveOthers(std::vector<std::uint8_t> interiorCells)
{
  const Eigen::Vector3f sizes = sizesOf(this->surface);
  this->thickness = sizes[0];
  this->width = sizes[1];
  this->verificationPoints = thinSamples(this->surface, VerificationLeaf * this->diameter, this->diameter);
  auto ofViews = std::async(std::launch::async, [&] { return std::make_shared<const PredictedVisibility>(*this); });
  this->table.deriveVotes(this->edges.points, this->edges.tangents, this->settings.feature);
  this->surfaceTable.deriveVotes(
    this->surfacePairPoints.points, this->surfacePairPoints.normals, PairFeatureKind::Surface);
  this->interior = std::make_shared<const BodyInterior>(
    this->surface, this->diameter, FieldReach * this->diameter, std::move(interiorCells));
  this->visibility = ofViews.get();
}
}
